#!/usr/bin/env bash
# bench.sh CAROM_BENCH [FLAG...]: runs the benchmarks and keeps the results as JSON.
set -euo pipefail
cd "$(dirname "$0")/.."
program=$1
shift
mkdir -p build/bench
out=build/bench/$(date -u +%Y%m%dT%H%M%SZ).json
"$program" --benchmark_out="$out" --benchmark_out_format=json "$@"
echo "bench: results in $out"
