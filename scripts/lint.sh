#!/usr/bin/env bash
# lint.sh: format, include directions, clang-tidy. Configures build/clang for its compile commands.
set -euo pipefail
cd "$(dirname "$0")/.."

echo "lint: include directions"
tools/check_includes
echo "lint: clang-format"
scripts/format.sh --dry-run -Werror
echo "lint: clang-tidy"
scripts/build.sh clang carom_build_info_header >/dev/null
# Files compiled once for every instruction set (foreach_target.h) are left out: clang-tidy sees
# five copies of each and takes minutes.
scripts/sources.sh |
  grep -E '^(simd|base|shapes|trees|bounds|geometries|broadphase|narrowphase|midphase|impacts|queries|world|reference|hulls|io|cli)/.*\.cc$' |
  xargs grep -L 'foreach_target.h' |
  xargs -P "${JOBS:-$(nproc)}" -n 4 clang-tidy --quiet -p build/clang \
    2> >(grep -v "warnings generated" >&2)
