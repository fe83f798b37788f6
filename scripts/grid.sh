#!/usr/bin/env bash
# grid.sh [--build-dir DIR]: whether the program gives the same bits however it is compiled and run.
# Builds it with g++ and clang++ at -O1, -O2 and -O3 in build/grid, runs each on every instruction set
# of this machine with one thread and with two, and compares what they give: see docs/determinism.md.
# --build-dir: looks at that build alone, and builds nothing.
set -euo pipefail
cd "$(dirname "$0")/.."
compilers=(g++ clang++)
levels=(-O1 -O2 -O3)
threads=(1 2)
out=build/grid/cells
steps=n=3000,frames=12,seed=1

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# What every cell runs, at detail manifold, but for the times of impact.
scenes=(
  mixed.npz
  "brownian:$steps,density=0.3,shape=sphere,positions=float64"
  "brownian:$steps,density=0.3,shape=box,positions=float64"
  "varied:$steps,density=0.3,shape=capsule"
  "static:$steps,density=0.5,motion=static"
  "$PWD/tests/data/settling.npz"
)
scripts/mixed_scene.py "$scratch/mixed.npz"
pairs=tests/data/pairs_sample.npz
moving=tests/data/toi_sample.npz

# The programs to run, "NAME PATH" each.
columns=()
if [ "${1:-}" = --build-dir ]; then
  columns=("$2 $(realpath "$2")/cli/carom")
else
  for compiler in "${compilers[@]}"; do
    if ! command -v "$compiler" >/dev/null; then
      echo "grid: skipped: $compiler is not there" >&2
      continue
    fi
    for level in "${levels[@]}"; do
      dir=build/grid/$compiler$level
      echo "grid: building $compiler $level"
      cmake -S . -B "$dir" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_CXX_FLAGS_RELEASE="$level -DNDEBUG" -DCAROM_BUILD_TESTS=OFF -DCAROM_BUILD_BENCH=OFF \
        >/dev/null
      cmake --build "$dir" -j "${JOBS:-$(nproc)}" --target carom_program >/dev/null
      columns+=("$compiler$level $PWD/$dir/cli/carom")
    done
  done
fi

hash_of() { sha256sum "$1" | cut -c1-16; }

# measure CAROM ISA THREADS: one line a source, its hash first.
measure() {
  local carom=$1 options=(--isa "$2" --threads "$3") scene json
  for scene in "${scenes[@]}"; do
    json=$(cd "$scratch" && "$carom" run "$scene" "${options[@]}" --detail manifold --json -)
    printf '%s %s\n' "$(sed -n 's/.*"state_hash": "\(.*\)".*/\1/p' <<<"$json")" "$scene"
  done
  "$carom" pairs "$pairs" -o "$scratch/results.npz" "${options[@]}" --detail manifold >/dev/null
  printf '%s %s\n' "$(hash_of "$scratch/results.npz")" "$pairs"
  "$carom" pairs "$moving" -o "$scratch/results.npz" "${options[@]}" --detail toi >/dev/null
  printf '%s %s\n' "$(hash_of "$scratch/results.npz")" "$moving"
}

rm -rf "$out"
mkdir -p "$out"

first=
different=()
printf '\n%-24s %-8s %-8s %s\n' build isa threads hash
for column in "${columns[@]}"; do
  read -r name carom <<<"$column"
  isas=$("$carom" info | sed -n 's/^ISAs usable here *//p' | tr -d ',')
  [ -n "$isas" ] || { echo "grid: $carom info names no instruction set" >&2; exit 1; }
  for isa in $isas; do
    for count in "${threads[@]}"; do
      cell=$out/${name//\//_}-$isa-$count.txt
      measure "$carom" "$isa" "$count" >"$cell"
      first=${first:-$cell}
      mark=
      cmp -s "$first" "$cell" || { mark='  DIFFERS' && different+=("$cell"); }
      printf '%-24s %-8s %-8s %s%s\n' "$name" "$isa" "$count" "$(hash_of "$cell")" "$mark"
    done
  done
done

if [ ${#different[@]} -gt 0 ]; then
  printf '\n%s and %s:\n' "$first" "${different[0]}"
  diff "$first" "${different[0]}" || true
  echo "grid: ${#different[@]} of the cells differ from the first" >&2
  exit 1
fi
printf '\ngrid: the same bits in all cells\n'
