#!/usr/bin/env python3
"""Writes docs/pair_kinds.md from narrowphase/pairs/pair_list.inc and the files that it names; --check:
fails if that would change it."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
DOCUMENT = ROOT / "docs" / "pair_kinds.md"

HEAD = """# Pair kinds

Every pair of kinds that has a kernel of its own; meshes and compounds are tested part by part. Written by `scripts/pair_table.py` from
`narrowphase/pairs/pair_list.inc` and the files that it names; a test says if it is out of date.

- **direction**: of pairs that are apart the direction is kept and tried first in the next frame.
- **manifold**: up to four points where faces or edges meet; otherwise there is one, the contact's.

| A | B | direction | manifold | method |
|---|---|---|---|---|
"""

TAIL = """
All other pairs of cylinders, cones and ellipsoids with convex kinds and each other go one way, in lanes of doubles
and, for depths, a pair at a time: [round shapes](design/round_shapes.md#the-general-way-in-lanes). They have manifolds.

Boxes and hulls with a rounding (`rounded_box`, `rounded_hull`) meet the same kinds, and each other, by the tests of their
cores: [rounded boxes and hulls](design/round_shapes.md#rounded-boxes-and-hulls).
"""


def first_sentence(path):
    """Of the comment at the head of a file."""
    lines = []
    for line in path.read_text().splitlines():
        if not line.startswith("// "):
            break
        lines.append(line[3:])
    return re.split(r"\.(?: |$)", " ".join(lines))[0].rstrip(".")


def tested_as(name):
    """k-DOPs are tested as hulls (narrowphase/pairs/dop/dop_pairs.cc)."""
    return "hull_hull" if name in ("dop_dop", "dop_hull") else name.replace("dop", "hull")


def row(name, a, b, passes):
    tested = tested_as(name)
    marks = [
        passes in ("clearance", "recall_and_clearance"),
        passes != "none",
    ]
    cells = [a, b] + ["yes" if mark else "" for mark in marks]
    form = ROOT / "narrowphase" / "pairs" / name.split("_")[0] / f"{name}_scalar.h"
    cells.append(f"As {tested}" if tested != name else first_sentence(form))
    return "| " + " | ".join(cells) + " |\n"


def main():
    pairs = re.findall(
        r"^CAROM_PAIR\((\w+), (\w+), (\w+), (\w+)\)",
        (ROOT / "narrowphase" / "pairs" / "pair_list.inc").read_text(),
        re.MULTILINE,
    )
    text = HEAD + "".join(row(*pair) for pair in pairs) + TAIL
    if sys.argv[1:] != ["--check"]:
        DOCUMENT.write_text(text)
    elif DOCUMENT.read_text() != text:
        sys.exit("docs/pair_kinds.md is out of date: run scripts/pair_table.py")


main()
