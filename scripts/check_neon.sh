#!/usr/bin/env bash
# check_neon.sh: compiles every file of the library for AArch64 with the flags of cmake/CaromFlags.cmake
# that matter there, without linking. Files with code in lanes are compiled by g++, which is strict about
# the instruction sets of functions, in the groups that CMake writes; clang, which reads headers in half
# the time, compiles the others, each alone. g++ compiles those for this machine in other builds.
set -euo pipefail
cd "$(dirname "$0")/.."
rooms=(simd base shapes trees bounds geometries broadphase narrowphase midphase impacts queries world)
out=build/neon
mkdir -p $out/include
# Header-only or architecture-independent headers of the host, and nothing else of it.
ln -sfn /usr/include/hwy $out/include/hwy
ln -sfn /usr/include/eigen3/Eigen $out/include/Eigen
ln -sfn /usr/include/tbb $out/include/tbb
ln -sfn /usr/include/oneapi $out/include/oneapi

# The list of pair kinds as headers, and files with code in lanes, both of which CMake writes.
generated=build/release/generated
[ -d $generated/kernels ] || cmake --preset release >/dev/null

flags=(-std=c++20 -O0 -march=armv8-a+crypto -I . -I include -I $generated -isystem $out/include
       -ffp-contract=off -fno-tree-slp-vectorize -Wall -Wextra)
gcc=(aarch64-linux-gnu-g++ "${flags[@]}")
clang=(clang++ --target=aarch64-linux-gnu "${flags[@]}")

# Eigen, half of what a file reads, is compiled once for files with lanes, and for the others that
# include it anyway, so that one of these that forgets a header is still found.
echo '#include <Eigen/Core>' >$out/eigen.h
"${gcc[@]}" -x c++-header $out/eigen.h -o $out/eigen.h.gch &
"${clang[@]}" -x c++-header $out/eigen.h -o $out/eigen.h.pch
wait $!

# Headers that include Eigen, and those that include one of these, until there are no more.
includes='#include <Eigen/'
headers=
while next=$(grep -rlF "$includes" include "${rooms[@]}" --include='*.h' | sort) &&
  [ "$next" != "$headers" ]; do
  headers=$next
  includes=$'#include <Eigen/\n'$(sed 's#^include/##; s#.*#\#include "&"#' <<<"$headers")
done

# compile_each COMPILER...: compiles the files of the standard input.
compile_each() { xargs -r -P "${JOBS:-$(nproc)}" -n 1 "$@" -c -o /dev/null; }

sources=$(find "${rooms[@]}" -name '*.cc' | sort)
groups=$(find $generated/kernels -name '*.cc' | sort)
[ -n "$groups" ] || { echo "check_neon: no groups of files with code in lanes" >&2; exit 1; }
in_groups=$(xargs sed -n 's/^#include "\(.*\.cc\)"$/\1/p' <<<"$groups" | sort)
lanes=$(comm -23 <(xargs grep -l foreach_target.h <<<"$sources") <(echo "$in_groups"))
compile_each "${gcc[@]}" -include $out/eigen.h <<<"$lanes"$'\n'"$groups"
others=$(xargs grep -L foreach_target.h <<<"$sources")
plain=$(xargs grep -LF "$includes" <<<"$others")
eigen=$(comm -23 <(echo "$others") <(echo "$plain"))
compile_each "${clang[@]}" <<<"$plain"
compile_each "${clang[@]}" -include-pch $out/eigen.h.pch <<<"$eigen"
echo "neon: the library compiles for AArch64"
