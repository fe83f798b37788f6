#!/usr/bin/env bash
# build.sh PRESET [TARGET...]: configures build/PRESET if it is new, and builds. Where CI is set,
# warnings are errors.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift
[ -f "build/$preset/build.ninja" ] ||
  cmake --preset "$preset" ${CI:+-DCMAKE_COMPILE_WARNING_AS_ERROR=ON}
cmake --build --preset "$preset" -j "${JOBS:-$(nproc)}" ${1:+--target "$@"}
