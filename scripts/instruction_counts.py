#!/usr/bin/env python3
"""Counts the instructions of whole steps of a world, and compares them with those of the table
bench/instructions.txt: times swing on shared machines, counts do not.

  instruction_counts.py CAROM_RUN            compares; fails if a row has 5 % more than the table
  instruction_counts.py CAROM_RUN --write    writes the table

Counts are those of World::step() in six frames on one thread, with AVX2, by valgrind, which knows
no AVX-512. They change with the compiler: with another one than the table's they are printed, not
judged.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

TABLE = pathlib.Path(__file__).parents[1] / "bench/instructions.txt"
FRAMES = 6
MOST = 1.05  # a row may have so many times the instructions of the table

# Every kind of work that a step may have.
ROWS = [
    ("cubes, pairs", "brownian:n=10000", "--detail pairs"),
    ("cubes, contacts", "brownian:n=10000", "--detail contact"),
    ("spheres, contacts", "brownian:n=10000,shape=sphere", "--detail contact"),
    ("boxes, manifolds", "brownian:n=4000,shape=box", "--detail manifold"),
    ("hulls, contacts", "brownian:n=1000,shape=hull", "--detail contact"),
    ("compounds, regions", "brownian:n=300,shape=compound", "--detail regions"),
    ("at rest, contacts", "still:n=20000", "--detail contact"),
    ("some at rest, pairs", "static:n=10000", "--detail pairs"),
    ("varied sizes, pairs", "varied:n=10000", "--detail pairs"),
    ("bullets, impacts", "bullets:n=300", "--detail contact --detection continuous"),
]

# The library of Highway measures its clock when it is loaded, by an instruction that valgrind does
# not know on machines that hide it. The counts need no clock.
NO_CLOCK = "unsigned long _ZN3hwy8platform15TimerResolutionEv(void) { return 1; }\n"


def build_no_clock(folder):
    source = pathlib.Path(folder, "no_clock.c")
    source.write_text(NO_CLOCK)
    library = source.with_suffix(".so")
    subprocess.run(["gcc", "-shared", "-fPIC", "-o", library, source], check=True)
    return library


def count(program, scene, options, no_clock):
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
               "--toggle-collect=carom::World::step()", program, "run", scene, *options.split(),
               "--frames", str(FRAMES), "--threads", "1", "--isa", "avx2"]
    run = subprocess.run(command, capture_output=True, text=True,
                         env={"LD_PRELOAD": str(no_clock), "PATH": "/usr/bin:/bin"})
    collected = re.search(r"Collected : (\d+)", run.stderr)
    if run.returncode != 0 or not collected or int(collected[1]) == 0:
        sys.exit(f"instruction_counts: {' '.join(map(str, command))}\n{run.stderr}")
    return int(collected[1])


def compiler():
    version = subprocess.run(["g++", "-dumpfullversion"], capture_output=True, text=True)
    return "g++ " + version.stdout.strip()


def read_table():
    first, *rows = TABLE.read_text().splitlines()
    return first.removeprefix("# "), {name.strip(): int(number)
                                      for name, number in (row.rsplit(None, 1) for row in rows)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("program", help="carom-run of a release build")
    parser.add_argument("--write", action="store_true", help="write the table")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        no_clock = build_no_clock(folder)
        found = pool.map(lambda row: count(options.program, row[1], row[2], no_clock), ROWS)
        counts = {name: number for (name, _, _), number in zip(ROWS, found)}
    if options.write:
        lines = [f"# {compiler()}"] + [f"{name:<22}{number:>12}" for name, number in counts.items()]
        TABLE.write_text("\n".join(lines) + "\n")
        print(TABLE.read_text(), end="")
        return 0
    of_compiler, before = read_table()
    is_judged = of_compiler == compiler()
    if not is_judged:
        print(f"The table is of {of_compiler}, this is {compiler()}: nothing is judged.")
    slower = []
    for name, number in counts.items():
        ratio = number / before[name]
        print(f"{name:<22}{before[name]:>12} -> {number:>12}  {ratio:6.3f}")
        if is_judged and ratio > MOST:
            slower.append(name)
    if slower:
        print(f"instruction_counts: more than {MOST} of the table: {'; '.join(slower)}")
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main())
