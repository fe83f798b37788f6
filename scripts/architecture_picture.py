#!/usr/bin/env python3
"""Draws docs/architecture.svg from the rooms that tools/check_includes holds; --check: fails if
that would change it."""
import importlib.machinery
import importlib.util
import pathlib
import sys
import textwrap
from xml.sax.saxutils import escape

sys.dont_write_bytecode = True  # no cache beside the tool

ROOT = pathlib.Path(__file__).resolve().parent.parent
PICTURE = ROOT / "docs" / "architecture.svg"

# What goes in -> what comes out, or what the room holds.
ROOMS = {
    "simd": "instruction set choice, lanes, gathers; includes only Highway",
    "base": "loops over fixed blocks, sorting, rounding, exact numbers, tolerances",
    "shapes": "shapes as rows of numbers, and which bodies are valid",
    "results": "public headers alone: pairs, contacts, events, impacts, tiers",
    "trees": "boxes -> a tree of eight children a node, and searches in it",
    "bounds": "bodies -> world bounds, k-DOPs",
    "geometries": "meshes and compounds -> geometries with trees; their parts",
    "broadphase": "bounds -> candidate pairs",
    "narrowphase": "pairs of simple shapes -> decisions, contacts, manifolds",
    "midphase": "pairs of any bodies -> pairs of parts -> results; the entry collide()",
    "impacts": "pairs of moving bodies -> times of impact",
    "queries": "rays, shapes, points -> hits among many bodies",
    "world": "bodies kept from step to step -> pairs, contacts, events",
}
NARROWPHASE = {
    "scalar": "vectors and shapes of the scalar forms",
    "batch": "loads, the loop over lanes, stores",
    "features": "segments, triangles, boxes: nearest points, axes",
    "doubles": "any convex shapes, in double precision",
    "hulls": "GJK in lanes, depths of solids",
    "manifolds": "clipped faces, up to four points",
    "pairs": "one kernel a pair of kinds, and its scalar form",
    "proof": "decisions proven, or computed exactly",
    "blocks": "1,024 pairs -> batches by kind -> passes",
}
AROUND = {
    "reference": "all of it again in plain scalar C++",
    "hulls": "points -> convex hulls, simpler ones",
    "ladders": "shapes -> simpler models within proved distances",
    "io": "files of scenes, pairs and results; generators",
    "oracle": "exact answers by brute force",
    "accuracy": "measures what accuracy costs",
    "cli": "the program carom",
    "tests": "mirrors the folders",
    "bench": "benchmarks, other libraries beside Carom",
    "fuzz": "libFuzzer targets",
    "examples": "programs that use the public headers",
}

FONT = "font-family='DejaVu Sans, Verdana, sans-serif'"
LEFT, GAP, LINE, PAD = 20, 10, 15, 8
FLOW_WIDTH, SIDE_LEFT, SIDE_WIDTH = 520, 580, 400
WIDTH = SIDE_LEFT + SIDE_WIDTH + LEFT
CHARACTER = 7.4  # at 12 px, of wide fonts


def rules():
    loader = importlib.machinery.SourceFileLoader(
        "check_includes", str(ROOT / "tools" / "check_includes"))
    module = importlib.util.module_from_spec(
        importlib.util.spec_from_loader("check_includes", loader))
    loader.exec_module(module)
    return module


class Picture:
    def __init__(self):
        self.shapes = []

    def text(self, x, y, words, size=12, weight="normal", colour="#222"):
        self.shapes.append(f"<text x='{x}' y='{y}' font-size='{size}' font-weight='{weight}' "
                           f"fill='{colour}'>{escape(words)}</text>")

    # A room; returns the height of its box.
    def room(self, x, y, width, name, description, height=None, fill="#eef3f8"):
        lines = textwrap.wrap(description, int((width - 2 * PAD) / CHARACTER))
        height = height or room_height(width, description)
        self.shapes.append(f"<rect x='{x}' y='{y}' width='{width}' height='{height}' rx='4' "
                           f"fill='{fill}' stroke='#5b7083'/>")
        self.text(x + PAD, y + PAD + 11, name, size=13, weight="bold")
        for i, line in enumerate(lines):
            self.text(x + PAD, y + PAD + 11 + LINE * (i + 1), line)
        return height

    def line(self, x1, y1, x2, y2, dashed=False):
        dashes = " stroke-dasharray='4 4'" if dashed else ""
        self.shapes.append(f"<line x1='{x1}' y1='{y1}' x2='{x2}' y2='{y2}' "
                           f"stroke='#5b7083'{dashes}/>")

    def svg(self, height):
        head = (f"<svg xmlns='http://www.w3.org/2000/svg' width='{WIDTH}' height='{height}' "
                f"viewBox='0 0 {WIDTH} {height}' {FONT}>")
        ground = f"<rect width='{WIDTH}' height='{height}' fill='white'/>"
        return "\n".join([head, ground, *self.shapes, "</svg>"]) + "\n"


def room_height(width, description):
    lines = textwrap.wrap(description, int((width - 2 * PAD) / CHARACTER))
    return 2 * PAD + LINE * (len(lines) + 1) - 2


# One level below the other, rooms that do not know each other side by side; returns where each room
# is, and the lower end.
def draw_levels(picture, x, y, width, levels, descriptions):
    places = {}
    for level in levels:
        share = (width - GAP * (len(level) - 1)) // len(level)
        height = max(room_height(share, descriptions[name]) for name in level)
        for i, name in enumerate(level):
            left = x + i * (share + GAP)
            picture.room(left, y, share, name, descriptions[name], height)
            places[name] = (left + share, y, height)
        y += height + GAP
    return places, y


# What a folder around the library may include, in words.
def includes_of(name, allowed, library):
    mine = allowed - {name}
    others = sorted(mine - library)
    if library <= mine:
        return ", ".join(["the library and reference", *others])
    return ", ".join([room for room in ROOMS if room in mine] + others)


def draw():
    tool = rules()
    library = set(tool.LIBRARY)
    for rooms, described in [(set(tool.CORE), ROOMS), (set(tool.ROOMS), NARROWPHASE),
                             (set(tool.ALLOWED) - set(tool.CORE), AROUND)]:
        for name in sorted(rooms ^ set(described)):
            sys.exit(f"{name}: known either here or to tools/check_includes, but not to both")

    picture = Picture()
    picture.text(LEFT, 32, "The rooms of Carom", size=18, weight="bold")
    picture.text(LEFT, 52, "A room may include itself and every room above it. "
                           "Rooms side by side do not include each other.")
    top = 70
    places, end = draw_levels(picture, LEFT, top, FLOW_WIDTH, tool.FLOW, ROOMS)

    right, y, height = places["narrowphase"]
    picture.text(SIDE_LEFT, top + 12, "The rooms of narrowphase/, by the same rule", weight="bold")
    _, side_end = draw_levels(picture, SIDE_LEFT, top + 24, SIDE_WIDTH, tool.NARROWPHASE,
                              NARROWPHASE)
    picture.line(right, y, SIDE_LEFT - GAP, top + 24, dashed=True)
    picture.line(right, y + height, SIDE_LEFT - GAP, side_end - GAP, dashed=True)
    picture.line(SIDE_LEFT - GAP, top + 24, SIDE_LEFT - GAP, side_end - GAP)

    y = max(end, side_end) + 20
    picture.text(LEFT, y, "Around the library", size=14, weight="bold")
    y += 12
    # Two columns.
    width = (WIDTH - 2 * LEFT - GAP) // 2
    names = list(AROUND)
    for i in range(0, len(names), 2):
        row = names[i:i + 2]
        words = [f"{AROUND[name]}. Includes: {includes_of(name, tool.ALLOWED[name], library)}"
                 for name in row]
        height = max(room_height(width, word) for word in words)
        for j, (name, word) in enumerate(zip(row, words)):
            picture.room(LEFT + j * (width + GAP), y, width, name, word, height, fill="#f6f1e7")
        y += height + GAP
    picture.text(LEFT, y + 12, "reference also shares scalar forms with the library "
                               "(SHARED_SCALAR in tools/check_includes).")
    return picture.svg(y + 28)


def main(arguments):
    drawn = draw()
    if arguments == ["--check"]:
        if not PICTURE.exists() or PICTURE.read_text() != drawn:
            print("docs/architecture.svg is out of date: run scripts/architecture_picture.py")
            return 1
        return 0
    PICTURE.write_text(drawn)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
