#!/usr/bin/env bash
# sources.sh: the project's C++ files, one a line.
set -euo pipefail
cd "$(dirname "$0")/.."
folders=(include simd base shapes trees bounds geometries broadphase narrowphase midphase impacts queries world
         reference hulls ladders io cli tests bench examples fuzz oracle accuracy)
find "${folders[@]}" -type f \( -name '*.h' -o -name '*.cc' \) | sort
