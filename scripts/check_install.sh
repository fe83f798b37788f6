#!/usr/bin/env bash
# check_install.sh BUILD_DIR COMPILER static|shared: installs a finished build to a scratch prefix,
# builds the examples against it through CMake and one of them through pkg-config, and runs them.
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
for source in examples/*.cc; do
  name=$(basename "$source" .cc)
  echo "== $name"
  "$scratch/examples/$name"
done

lib_dir=$(dirname "$(find "$prefix" -name 'libcarom.*' | head -n 1)")
export PKG_CONFIG_PATH=$lib_dir/pkgconfig
static_flag=()
[ "$linkage" = shared ] || static_flag=(--static)
read -ra cflags <<<"$(pkg-config "${static_flag[@]}" --cflags carom-reference)"
read -ra libs <<<"$(pkg-config "${static_flag[@]}" --libs carom-reference)"
source=$PWD/$source
(
  cd "$scratch"
  "${launcher[@]}" "$compiler" -std=c++20 -O1 "${cflags[@]}" -c "$source" -o pkg_config.o
  "$compiler" pkg_config.o "${libs[@]}" -Wl,-rpath,"$lib_dir" -o pkg_config
)
echo "== $name, built through pkg-config"
"$scratch/pkg_config"

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
