#!/usr/bin/env bash
# bench.sh CAROM_BENCH [FLAG...]: runs the benchmarks, prints them, and keeps them as JSON in
# build/bench. Flags: --smoke (does everything run?), --large (scenes of a million bodies), and
# Google Benchmark's, such as --benchmark_filter=REGEX.
set -euo pipefail
cd "$(dirname "$0")/.."
program=$1
shift
mkdir -p build/bench
out=build/bench/$(date -u +%Y%m%dT%H%M%SZ).json
"$program" --benchmark_min_time=0.2 --benchmark_out="$out" --benchmark_out_format=json "$@"
echo "bench: results in $out; as tables: scripts/bench_table.py $out"
