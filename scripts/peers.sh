#!/usr/bin/env bash
# peers.sh CAROM_PEERS [ARGUMENT...]: compares broadphase and narrow phase with other libraries,
# keeps the results as JSON in build/peers, and writes docs/peers.md, docs/peers.svg and
# docs/narrowphase_peers.md. Arguments are the program's: --large, recordings of bounds, ...
# PEERS_OUT names another folder for the pages.
set -euo pipefail
cd "$(dirname "$0")/.."
program=$1
shift
mkdir -p build/peers
out=build/peers/$(date -u +%Y%m%dT%H%M%SZ).json
status=0
"$program" --out "$out" "$@" || status=$?
[ -f "$out" ] && scripts/peers_report.py "$out" --out "${PEERS_OUT:-docs}"
exit "$status"  # 1 if pairs or decisions differed, which the pages tell
