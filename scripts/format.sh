#!/usr/bin/env bash
# format.sh [CLANG_FORMAT_FLAG...]: formats all sources in place, or as the flags say.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- -i
scripts/sources.sh | xargs clang-format "$@"
