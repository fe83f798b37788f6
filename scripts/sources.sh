#!/usr/bin/env bash
# sources.sh: the project's C++ files, one a line.
set -euo pipefail
cd "$(dirname "$0")/.."
folders=(include simd kernel broadphase narrowphase midphase sweep world reference io cli tests bench examples fuzz oracle accuracy)
find "${folders[@]}" -type f \( -name '*.h' -o -name '*.cc' \) | sort
