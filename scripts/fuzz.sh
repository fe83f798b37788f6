#!/usr/bin/env bash
# fuzz.sh BUILD_DIR: runs every fuzz target for SECONDS_EACH seconds (20), from the seeds in
# fuzz/corpus/NAME_fuzz; what it finds stays in BUILD_DIR/corpus/NAME.
set -euo pipefail
cd "$(dirname "$0")/.."
build_dir=$1
targets=$(find "$build_dir/fuzz" -maxdepth 1 -type f -executable -name '*_fuzz' | sort)
[ -n "$targets" ] || { echo "fuzz: no target in $build_dir" >&2; exit 1; }

for target in $targets; do
  name=$(basename "$target" _fuzz)
  corpus=$build_dir/corpus/$name
  mkdir -p "$corpus"
  seeds=()
  [ ! -d "fuzz/corpus/${name}_fuzz" ] || seeds=("fuzz/corpus/${name}_fuzz")
  echo "== $name"
  "$target" -max_total_time="${SECONDS_EACH:-20}" -timeout=10 -rss_limit_mb=4096 -verbosity=0 \
    -print_final_stats=1 -artifact_prefix="$build_dir/" "$corpus" "${seeds[@]}"
done
