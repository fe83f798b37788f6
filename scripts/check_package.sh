#!/usr/bin/env bash
# check_package.sh COMPILER static|shared: builds the libraries that way, and checks what they
# install.
set -euo pipefail
cd "$(dirname "$0")/.."
compiler=$1 linkage=$2
case $linkage in
  static) shared=OFF ;;
  shared) shared=ON ;;
  *) echo "usage: check_package.sh COMPILER static|shared" >&2; exit 2 ;;
esac

# What is installed does not depend on the targets or on optimisation, and this compiles in a
# fraction of the time.
build_dir=build/package-$compiler-$linkage
cmake -S . -B "$build_dir" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
  -DBUILD_SHARED_LIBS=$shared -DCAROM_BUILD_TESTS=OFF -DCAROM_BUILD_BENCH=OFF \
  -DCAROM_BUILD_PROGRAM=OFF \
  -DCAROM_SCALAR_ONLY=ON -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" >/dev/null
cmake --build "$build_dir" -j "${JOBS:-$(nproc)}"
scripts/check_install.sh "$build_dir" "$compiler" "$linkage"
