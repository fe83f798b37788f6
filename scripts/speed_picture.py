#!/usr/bin/env python3
"""Draws docs/speed.svg: how many times as fast as Bullet Carom is. Takes ten rows, slow kinds
included, from the first table of docs/narrowphase_peers.md, which `make peers` writes.

  scripts/speed_picture.py            writes docs/speed.svg
  scripts/speed_picture.py --check    fails if that would change it
"""
import pathlib
import re
import sys

from picture import head, text_at, write

DOCS = pathlib.Path(__file__).resolve().parent.parent / "docs"
TABLE = DOCS / "narrowphase_peers.md"
PICTURE = DOCS / "speed.svg"

# Pair and output as the table has them, and what the picture calls them.
ROWS = [
    ("sphere_box", "contact", "sphere - box, contact"),
    ("box_triangle", "contact", "box - triangle, contact"),
    ("hull_hull_16", "clearance", "hull - hull of 16 corners, distance if separate"),
    ("box_box", "overlap", "box - box, overlap"),
    ("sphere_sphere", "contact", "sphere - sphere, contact"),
    ("box_mesh", "contact", "box - mesh of 10,082 triangles, contact"),
    ("capsule_capsule", "contact", "capsule - capsule, contact"),
    ("hull_hull_16", "manifold", "hull - hull of 16 corners, manifold"),
    ("box_box", "manifold", "box - box, manifold"),
    ("hull_hull_16", "toi", "hull - hull of 16 corners, time of impact"),
]

WIDTH, LEFT, RIGHT = 860, 345, 175
TOP, STEP, BAR = 82, 30, 18


def read_table():
    """The cells of the table, by (pair, output); and the name of the column with the ratios."""
    lines = [line for line in TABLE.read_text().splitlines() if line.startswith("|")]
    head = [cell.strip() for cell in lines[0].strip("|").split("|")]
    ratio = next(name for name in head if name.endswith("x Bullet"))
    table = {}
    for line in lines[2:]:
        cells = dict(zip(head, (cell.strip() for cell in line.strip("|").split("|"))))
        if ratio not in cells or not re.fullmatch(r"[\d.]+", cells[ratio]):
            break
        table[cells["pair"], cells["output"]] = cells
    return table, ratio


def read_origin():
    """Machine, compiler, Bullet's version, commit and day, from the line above the table."""
    text = TABLE.read_text()
    line = next(line for line in text.splitlines() if "commit" in line)
    machine = re.sub(r"\(R\)| Processor", "", line.split(",")[0])
    compiler = re.search(r"GNU [\d.]+", line).group().replace("GNU", "g++")
    bullet = re.search(r"Bullet [\d.]+", line).group()
    commit, day = re.search(r"commit (\w+); ([\d-]+)T", line).groups()
    return machine, compiler, bullet, commit, day


def draw():
    table, ratio = read_table()
    machine, compiler, bullet, commit, day = read_origin()
    isa = ratio.split(":")[0]
    chosen = [(table[pair, output], label) for pair, output, label in ROWS]
    chosen.sort(key=lambda row: -float(row[0][ratio]))
    ratios = [float(row[ratio]) for row in table.values()]
    scale = (WIDTH - LEFT - RIGHT) / float(chosen[0][0][ratio])
    bottom = TOP + STEP * len(ROWS)
    height = bottom + 78

    parts = [
        *head(WIDTH, height, "How many times as fast as Bullet a pair is tested"),
        text_at(20, 32, "Times as fast as Bullet, one thread", 20, weight="bold"),
        text_at(20, 54, f"Ten of the {len(table)} rows of docs/narrowphase_peers.md; in all of"
                f" them: {min(ratios):.2g} to {max(ratios):.0f} times. Dashed: as fast as Bullet.",
                colour="#555"),
    ]
    for i, (row, label) in enumerate(chosen):
        y = TOP + STEP * i
        width = float(row[ratio]) * scale
        baseline = y + BAR - 4
        times = f"{float(row[ratio]):.3g}x"
        nanoseconds = f"{row['Bullet']} \u2192 {row[isa]} ns"
        parts += [
            text_at(LEFT - 10, baseline, label, anchor="end"),
            f'<rect x="{LEFT}" y="{y}" width="{width:.1f}" height="{BAR}" rx="2" fill="#2a6fbb"/>',
            text_at(f"{LEFT + width + 8:.1f}", baseline, times, weight="bold"),
            text_at(f"{LEFT + width + 60:.1f}", baseline, nanoseconds, 12, colour="#555"),
        ]
    one = LEFT + scale
    parts.append(f'<line x1="{one:.1f}" x2="{one:.1f}" y1="{TOP - 8}" y2="{bottom - 4}"'
                 ' stroke="#b33" stroke-dasharray="4 3"/>')
    notes = [
        f"{machine}, {isa.replace('avx', 'AVX-')}; {compiler} -O3; {bullet} as the distribution"
        " compiled it.",
        "100,000 random pairs a row, half of them overlapping; nanoseconds a pair on the right.",
        f"Commit {commit}, {day}. Made by: make peers, then scripts/speed_picture.py",
    ]
    for i, note in enumerate(notes):
        parts.append(text_at(20, bottom + 24 + 18 * i, note, 12, colour="#555"))
    parts.append("</svg>")
    return "\n".join(parts) + "\n"


write(PICTURE, draw(), check=sys.argv[1:] == ["--check"])
