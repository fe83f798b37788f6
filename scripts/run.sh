#!/usr/bin/env bash
# run.sh CAROM: verifies and replays a recorded scene and a generated one.
set -euo pipefail
cd "$(dirname "$0")/.."
carom=$1
recorded=tests/data/settling.npz
generated=brownian:n=100000,frames=3,seed=1

heading() { printf '\n== %s\n' "$*"; }

heading "carom verify: every instruction set and thread count against the scalar reference"
"$carom" verify "$recorded" "$generated"
for scene in "$recorded" "$generated"; do
  heading "carom run $scene"
  "$carom" run "$scene"
done
