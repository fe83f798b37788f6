#!/usr/bin/env bash
# check_neon.sh: compiles the library for AArch64, with the flags of cmake/CaromFlags.cmake that
# matter there, without linking.
set -euo pipefail
cd "$(dirname "$0")/.."
compiler=aarch64-linux-gnu-g++
out=build/neon
mkdir -p $out/include
# Header-only or architecture-independent headers of the host, and nothing else of it.
ln -sfn /usr/include/hwy $out/include/hwy
ln -sfn /usr/include/eigen3/Eigen $out/include/Eigen
ln -sfn /usr/include/tbb $out/include/tbb
ln -sfn /usr/include/oneapi $out/include/oneapi

# The list of pair kinds as headers, which CMake writes.
generated=build/release/generated
[ -d $generated ] || cmake --preset release >/dev/null

find simd base shapes trees bounds geometries broadphase narrowphase midphase impacts queries world -name '*.cc' | sort |
  xargs -P "${JOBS:-$(nproc)}" -I{} $compiler -std=c++20 -O0 -c {} -o /dev/null \
    -march=armv8-a+crypto -I . -I include -I $generated -isystem $out/include \
    -ffp-contract=off -fno-tree-slp-vectorize -Wall -Wextra
echo "neon: the library compiles for AArch64"
