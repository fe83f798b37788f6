#!/usr/bin/env bash
# tidy.sh BUILD_DIR FILE...: clang-tidy of each file, unless it passed before with the same text, all
# that it includes, options and settings; BUILD_DIR/tidy remembers.
set -euo pipefail
build=$1
shift
mkdir -p "$build/tidy"
failed=0
for file in "$@"; do
  # With comments, in which NOLINT may be.
  key=$({
    clang-tidy --version
    cat .clang-tidy
    python3 scripts/preprocess.py "$build/compile_commands.json" "$file"
  } | sha256sum | cut -d ' ' -f 1)
  [ ! -e "$build/tidy/$key" ] || continue
  if clang-tidy --quiet -p "$build" "$file"; then
    touch "$build/tidy/$key"
  else
    failed=1
  fi
done
exit $failed
