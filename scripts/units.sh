#!/usr/bin/env bash
# units.sh BUILD ROOM...: what a build tree compiles of these rooms, one file a line: single files,
# and those with which CMake compiles several together.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
shift
rooms=$(IFS='|'; echo "$*")
grep -o '"file": "[^"]*"' "$build/compile_commands.json" | cut -d '"' -f 4 | sed "s#^$PWD/##" |
  grep -E "^($build/)?($rooms)/|^$build/generated/kernels/" | sort -u
