#!/usr/bin/env bash
# fuzz.sh BUILD_DIR: runs every fuzz target for SECONDS_EACH seconds (20), one on each core, from the
# seeds in fuzz/corpus/NAME_fuzz; what it finds stays in BUILD_DIR/corpus/NAME.
set -euo pipefail
cd "$(dirname "$0")/.."
export build_dir=$1
targets=$(find "$build_dir/fuzz" -maxdepth 1 -type f -executable -name '*_fuzz' | sort)
[ -n "$targets" ] || { echo "fuzz: no target in $build_dir" >&2; exit 1; }

fuzz_target() {
  local target=$1 name status=0
  name=$(basename "$target" _fuzz)
  local corpus=$build_dir/corpus/$name seeds=() log
  mkdir -p "$corpus"
  [ ! -d "fuzz/corpus/${name}_fuzz" ] || seeds=("fuzz/corpus/${name}_fuzz")
  log=$("$target" -max_total_time="${SECONDS_EACH:-20}" -timeout=10 -rss_limit_mb=4096 -verbosity=0 \
    -print_final_stats=1 -artifact_prefix="$build_dir/" "$corpus" "${seeds[@]}" 2>&1) || status=$?
  printf '== %s\n%s\n' "$name" "$log"
  return "$status"
}
export -f fuzz_target
# xargs stops at 255 alone; libFuzzer has other numbers.
xargs -P "${JOBS:-$(nproc)}" -n 1 bash -c 'fuzz_target "$0"' <<<"$targets"
