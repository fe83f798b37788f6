#!/usr/bin/env bash
# lint.sh: format, include directions, clang-tidy.
set -euo pipefail
cd "$(dirname "$0")/.."

echo "lint: include directions"
tools/check_includes
echo "lint: clang-format"
scripts/format.sh --dry-run -Werror
echo "lint: clang-tidy"
# Files that passed before are not looked at again (tidy.py). The files of a folder are looked at
# together, because headers take most of the time. The analyzer of clang-tidy looks into files that
# others include if their path has this name.
tree=build/lint-UnifiedSource
cmake --preset clang -B $tree -DCAROM_UNITY_BUILD=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=OFF \
  -DCAROM_BUILD_TESTS=OFF -DCAROM_BUILD_BENCH=OFF >/dev/null
cmake --build $tree --target carom_build_info_header carom_precompiled carom_precompiled_program >/dev/null
rooms='simd|base|shapes|trees|bounds|geometries|broadphase|narrowphase|midphase|impacts|queries|world|reference|hulls|ladders|io|cli'
# The analyzer follows each function through at most so many states, and does not look into the
# functions of the standard library, in which it would spend most of them and two fifths of the time.
analyzer=(max-nodes=100000 c++-stdlib-inlining=false)
options=$(printf -- '--extra-arg=-Xclang\n--extra-arg=-analyzer-config\n--extra-arg=-Xclang\n--extra-arg=%s\n' \
  "${analyzer[@]}")
# Files compiled once for every instruction set (foreach_target.h) are left out: clang-tidy sees
# five copies of each and takes minutes. The scalar kernels take longest, so they start first.
grep -o '"file": "[^"]*"' $tree/compile_commands.json | cut -d '"' -f 4 | sed "s#^$PWD/##" |
  grep -E "^($tree/)?($rooms)/" | sort -u | xargs grep -L 'foreach_target.h' |
  sed 's/.*carom_scalar_pairs/0 &/; t; s/^/1 /' | sort -s -k 1,1 | cut -d ' ' -f 2 |
  xargs -P "${JOBS:-$(nproc)}" -I '{}' scripts/tidy.py $tree '{}' $options 2> >(grep -v "warnings generated" >&2)
