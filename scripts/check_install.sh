#!/usr/bin/env bash
# check_install.sh BUILD_DIR COMPILER static|shared: installs a finished build to a scratch prefix,
# builds the examples against it through CMake and two of them through pkg-config, and runs them.
set -euo pipefail
cd "$(dirname "$0")/.."
build_dir=$1 compiler=$2 linkage=$3

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
prefix=$scratch/prefix

cmake --install "$build_dir" --prefix "$prefix" >/dev/null
[ ! -e "$prefix/bin/carom" ] || "$prefix/bin/carom" info >/dev/null

# The scratch folder has another name each time; ccache sees its paths relative to it.
export CCACHE_BASEDIR=$scratch
launcher=()
[ -z "$(command -v ccache)" ] || launcher=(ccache)

cmake -S examples -B "$scratch/examples" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$prefix" \
  ${launcher:+-DCMAKE_CXX_COMPILER_LAUNCHER=ccache} >/dev/null
cmake --build "$scratch/examples"
has_hulls=$(find "$prefix" -name carom-hulls.pc)
for source in examples/*.cc; do
  name=$(basename "$source" .cc)
  [[ $name != @(hull_from_points|tolerance) ]] || [ -n "$has_hulls" ] || continue
  echo "== $name"
  "$scratch/examples/$name"
done

lib_dir=$(dirname "$(find "$prefix" -name 'libcarom.*' | head -n 1)")
export PKG_CONFIG_PATH=$lib_dir/pkgconfig
static_flag=()
[ "$linkage" = shared ] || static_flag=(--static)

# run_through_pkg_config EXAMPLE PACKAGE: builds the example with the flags of pkg-config.
run_through_pkg_config() {
  local cflags libs source=$PWD/examples/$1.cc
  read -ra cflags <<<"$(pkg-config "${static_flag[@]}" --cflags "$2")"
  read -ra libs <<<"$(pkg-config "${static_flag[@]}" --libs "$2")"
  (
    cd "$scratch"
    "${launcher[@]}" "$compiler" -std=c++20 -O1 "${cflags[@]}" -c "$source" -o pkg_config.o
    "$compiler" pkg_config.o "${libs[@]}" -Wl,-rpath,"$lib_dir" -o pkg_config
  )
  echo "== $1, built through pkg-config with $2"
  "$scratch/pkg_config"
}
run_through_pkg_config first_program carom-reference
[ -z "$has_hulls" ] || run_through_pkg_config hull_from_points carom-hulls
[ -z "$has_hulls" ] || run_through_pkg_config tolerance carom-ladders

if [ "$linkage" = shared ]; then
  # Weak symbols are templates of the standard library; strong ones must be ours and public.
  foreign=$(nm -DC --defined-only "$lib_dir"/libcarom*.so | grep -E ' [TDBR] ' |
    grep -vE ' [TDBR] ((typeinfo|vtable|typeinfo name) for )?carom::' || true)
  if [ -n "$foreign" ]; then
    printf 'exported by mistake:\n%s\n' "$foreign" >&2
    exit 1
  fi
fi
echo "package of $build_dir: $linkage, $compiler: ok"
