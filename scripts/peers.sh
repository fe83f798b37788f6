#!/usr/bin/env bash
# peers.sh CAROM_PEERS [ARGUMENT...]: compares the broadphase with other libraries, keeps the
# results as JSON in build/peers, and writes docs/peers.md and docs/peers.svg. Arguments are the
# program's: --large, recordings of bounds, ... PEERS_OUT names another folder for the page.
set -euo pipefail
cd "$(dirname "$0")/.."
program=$1
shift
mkdir -p build/peers
out=build/peers/$(date -u +%Y%m%dT%H%M%SZ).json
status=0
"$program" --out "$out" "$@" || status=$?
[ -f "$out" ] && scripts/peers_report.py "$out" --out "${PEERS_OUT:-docs}"
exit "$status"  # 1 if pairs differed, which the page tells
