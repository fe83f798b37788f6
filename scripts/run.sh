#!/usr/bin/env bash
# run.sh CAROM: replays a recorded scene and a generated one, and verifies them.
set -euo pipefail
cd "$(dirname "$0")/.."
carom=$1
recorded=tests/data/settling.npz

heading() { printf '\n== %s\n' "$*"; }

for scene in "$recorded" brownian:n=100000,frames=3,seed=1; do
  heading "carom run $scene"
  "$carom" run "$scene"
done
heading "carom verify: every instruction set and thread count against the scalar reference"
"$carom" verify "$recorded" brownian:n=30000,frames=3,seed=1
