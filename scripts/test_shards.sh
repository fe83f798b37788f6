#!/usr/bin/env bash
# test_shards.sh BUILD_DIR SHARDS [FILTER]: runs the test programs of a build, each as SHARDS processes,
# where ctest starts one for every test: with sanitizers a start takes 0.1 to 0.2 s. FILTER is that of
# GoogleTest. What a process prints stays in BUILD_DIR/tests/logs; of those that fail it is shown.
set -euo pipefail
cd "$(dirname "$0")/.."
build_dir=$1 shards=$2
export GTEST_TOTAL_SHARDS=$shards GTEST_FILTER=${3:-*} GTEST_COLOR=no
export logs=$build_dir/tests/logs
rm -rf "$logs"
mkdir -p "$logs"

run_shard() {
  local program=$1 shard=$2 start=$SECONDS status=0 log
  log=$logs/$(basename "$program").$shard
  GTEST_SHARD_INDEX=$shard timeout 1200 "$program" >"$log" 2>&1 || status=$?
  if [ "$status" = 0 ]; then
    printf '%5d s  %-20s %s\n' $((SECONDS - start)) "$(basename "$log")" "$(grep ' ran\. ' "$log")"
    return
  fi
  # One write, so that programs that end at the same time do not mix.
  printf '%s\n' "$(grep -v '^\[       OK \]' "$log")" "FAILED with status $status: $program" \
    "  as GTEST_TOTAL_SHARDS=$GTEST_TOTAL_SHARDS GTEST_SHARD_INDEX=$shard GTEST_FILTER='$GTEST_FILTER'"
  return 1
}
export -f run_shard

# Large programs have the long tests, and start first.
programs=$(find "$build_dir/tests" -name '*_test' -type f -executable -printf '%s %p\n' | sort -rn | cut -d ' ' -f 2)
[ -n "$programs" ] || { echo "test_shards: no test program in $build_dir" >&2; exit 1; }
for program in $programs; do
  for ((shard = 0; shard < shards; ++shard)); do echo "$program $shard"; done
done | xargs -P "${JOBS:-$(nproc)}" -L 1 bash -c 'run_shard "$0" "$1"' || { echo "test_shards: failed" >&2; exit 1; }
passed=$(sed -n 's/^\[  PASSED  \] \([0-9]*\) test.*/\1/p' "$logs"/* | paste -sd +)
echo "test_shards: $((passed)) tests passed"
