#!/usr/bin/env python3
"""Draws docs/tolerance.svg: the time of a frame against the error, as shares of the time at
tolerance 0 and of the radius, with the points of other libraries (docs/narrowphase_peers.md).

  tolerance_picture.py --measure PROGRAM LABEL=SCENE...   asks `PROGRAM advise --front` about each
                                scene, writes docs/tolerance.json, and draws
  tolerance_picture.py          draws from docs/tolerance.json
  tolerance_picture.py --check  fails if that would change the picture
"""
import html
import json
import math
import pathlib
import subprocess
import sys

from picture import head, text_at, write

DOCS = pathlib.Path(__file__).resolve().parent.parent / "docs"
FRONTS, PICTURE, PEERS = DOCS / "tolerance.json", DOCS / "tolerance.svg", DOCS / "narrowphase_peers.md"

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 860, 560, 70, 200, 76, 70
ERRORS, TIMES = (-8, 0.5), (-2.3, 2)  # decades
COLOURS = ["#2a6fbb", "#2b8a3e", "#d9480f", "#862e9c", "#0b7285", "#5c4b00"]
PEER_COLOURS = {"Bullet": "#b33", "FCL": "#777", "ODE": "#c90"}
PAIRS = [("capsule_box", "contact"), ("box_box", "manifold"), ("hull_hull_16", "contact"),
         ("capsule_capsule", "contact")]


def measure(program, scenes):
    lines = []
    for text in scenes:
        label, scene = text.split("=", 1)
        out = subprocess.run([program, "advise", scene, "--tolerance", "0.001", "--front", "--json",
                              "-"], check=True, capture_output=True, text=True).stdout
        advice = json.loads(out)
        if not advice.get("front"):
            sys.exit(f"{scene}: too slow to measure a front")
        radius = advice["survey"]["radius"]["median"]
        slowest = advice["front"][0]["frame_ms"]
        points = [[point[key] / unit for key, unit in (("guaranteed_error", radius),
                                                       ("measured_error", radius),
                                                       ("frame_ms", slowest))]
                  for point in advice["front"]]
        lines.append({"label": label, "scene": pathlib.Path(scene).name if scene.endswith(".npz")
                      else scene, "points": [[float(f"{x:.4g}") for x in p] for p in points]})
    FRONTS.write_text(json.dumps(lines, indent=1) + "\n")


def tables(text):
    """Lists of rows, by the heading above."""
    found, heading, rows = [], "", []
    for line in text.splitlines() + [""]:
        if line.startswith("|"):
            rows.append([cell.strip() for cell in line.strip("|").split("|")])
            continue
        if rows:
            found.append((heading, [dict(zip(rows[0], row)) for row in rows[2:]]))
            rows = []
        if line.startswith("#"):
            heading = line.lstrip("# ")
    return found


def peer_points():
    """(library, pair, worst error, times as long as Carom)"""
    all_tables = tables(PEERS.read_text())
    ratio = next(key for key in all_tables[0][1][0] if key.endswith("x Bullet"))
    bullet_time = {(row["pair"], row["output"]): row[ratio] for row in all_tables[0][1]}
    for heading, rows in all_tables:
        library = "Bullet" if "Bullet decides otherwise" in rows[0] else heading
        for row in rows if library in PEER_COLOURS else []:
            key = row["pair"], row["output"]
            if key in PAIRS and "worst error" in row:
                yield library, key, float(row["worst error"]), float(row.get("x", bullet_time[key]))


def place(error, time):
    x = (math.log10(error) - ERRORS[0]) / (ERRORS[1] - ERRORS[0])
    y = (math.log10(time) - TIMES[0]) / (TIMES[1] - TIMES[0])
    return (round(LEFT + x * (WIDTH - LEFT - RIGHT), 1),
            round(HEIGHT - BOTTOM - y * (HEIGHT - TOP - BOTTOM), 1))


def square(x, y, colour, title=""):
    return (f'<rect x="{x - 4.5:.1f}" y="{y - 4.5:.1f}" width="9" height="9" fill="{colour}">'
            f"<title>{html.escape(title)}</title></rect>")


def axes():
    for decade in range(ERRORS[0], 1):
        x = place(10 ** decade, 1)[0]
        yield f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{TOP}" y2="{HEIGHT - BOTTOM}" stroke="#eee"/>'
        yield text_at(x, HEIGHT - BOTTOM + 18, f"1e{decade}", anchor="middle", colour="#555")
    for time in (0.01, 0.03, 0.1, 0.3, 1, 3, 10, 30, 100):
        y = place(1, time)[1]
        colour = "#888" if time == 1 else "#eee"
        yield f'<line x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y:.1f}" y2="{y:.1f}" stroke="{colour}"/>'
        yield text_at(LEFT - 8, y + 4, f"{time:g}", anchor="end", colour="#555")


def draw():
    parts = [
        *head(WIDTH, HEIGHT, "Time of a frame against its error"),
        text_at(20, 30, "What a tolerance buys", 20, weight="bold"),
        text_at(20, 52, "Time of a frame, of that at tolerance 0, against the guaranteed error, of the"
                " bounding radius. Dots: the worst error seen.", 13, colour="#555"),
        *axes(),
        text_at((LEFT + WIDTH - RIGHT) / 2, HEIGHT - BOTTOM + 38, "error / radius", anchor="middle"),
    ]
    y_label = TOP + 6
    for line, colour in zip(json.loads(FRONTS.read_text()), COLOURS):
        points = [place(max(error, 10 ** ERRORS[0]), time) for error, _, time in line["points"]]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
        for _, seen, time in line["points"]:
            if seen >= 10 ** ERRORS[0]:
                x, y = place(seen, time)
                parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.5" fill="{colour}"/>')
        parts.append(text_at(WIDTH - RIGHT + 14, y_label, line["label"], colour=colour, weight="bold"))
        y_label += 20
    y_label += 14
    parts.append(text_at(WIDTH - RIGHT + 14, y_label, "Pairs in other libraries,"))
    parts.append(text_at(WIDTH - RIGHT + 14, y_label + 16, "by their worst error:"))
    y_label += 38
    for library, colour in PEER_COLOURS.items():
        parts.append(square(WIDTH - RIGHT + 18.5, y_label - 4.5, colour))
        parts.append(text_at(WIDTH - RIGHT + 29, y_label, library))
        y_label += 18
    for library, pair, error, times in peer_points():
        x, y = place(max(error, 10 ** ERRORS[0]), times)
        parts.append(square(x, y, PEER_COLOURS[library], f"{library}, {pair[0]} {pair[1]}"))
    parts.append(text_at(20, HEIGHT - 12, "Scenes: docs/tolerance.json. Pairs: capsule - box, box - box,"
                         " hull - hull of 16 corners, two capsules; times of Carom's test of the same.",
                         12, colour="#555"))
    parts.append("</svg>")
    return "\n".join(parts) + "\n"


def main():
    if sys.argv[1:2] == ["--measure"]:
        measure(sys.argv[2], sys.argv[3:])
    write(PICTURE, draw(), check=sys.argv[1:] == ["--check"])


main()
