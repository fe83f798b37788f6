#!/usr/bin/env python3
"""Turns the JSON of carom_peers into pages.

  peers_report.py [JSON] [--out DIR]    the newest file of build/peers, into docs, by default

Broadphase: peers.md, and a plot, peers.svg. Narrow phase: narrowphase_peers.md. A comparison that
was not made leaves its page as it is.
"""

import argparse
import html
import json
import math
import pathlib
import sys

sys.dont_write_bytecode = True
from narrowphase_page import build, machine, number, row, streams_page, target

ROOT = pathlib.Path(__file__).parents[1]
YARDSTICK = "cgal"

# How many times faster than CGAL Carom has to be, and wants to be, on one thread.
TARGETS = {
    "brownian_1k": (6, 12),
    "static_1k": (8, 20),
    "brownian_10k": (15, 25),
    "varied_10k": (14, 22),
    "freefall_10k": (15, 30),
    "gravity_10k": (15, 30),
    "static_10k": (23, 50),
    "still_10k": (280, 1000),
    "brownian_100k": (21, 45),
    "varied_100k": (14, 30),
    "freefall_100k": (21, 50),
    "gravity_100k": (22, 45),
    "static_100k": (23, 60),
    "brownian_1M": (26, 70),
    "varied_1M": (14, 35),
    "static_1M": (20, 80),
}

# Names for readers, and colour and dashes of the lines.
PEERS = {
    ("carom", 1): ("Carom", "#d1495b", "none"),
    ("carom", 2): ("Carom, 2 threads", "#d1495b", "6 3"),
    ("cgal", 1): ("CGAL", "#222222", "none"),
    ("bullet_dbvt", 1): ("Bullet btDbvt", "#1f77b4", "none"),
    ("bullet_dbvt_broadphase", 1): ("Bullet btDbvtBroadphase", "#1f77b4", "6 3"),
    ("bullet_dbvt_deferred", 1): ("Bullet btDbvtBroadphase, deferred", "#1f77b4", "2 3"),
    ("bullet_axis_sweep", 1): ("Bullet btAxisSweep3", "#56b4e9", "none"),
    ("fcl_tree", 1): ("FCL DynamicAABBTree", "#2e8b57", "none"),
    ("ode_hash", 1): ("ODE dHashSpace", "#a06cd5", "none"),
    ("ode_quadtree", 1): ("ODE dQuadTreeSpace", "#a06cd5", "6 3"),
    ("ode_sweep", 1): ("ODE dSweepAndPruneSpace", "#a06cd5", "2 3"),
}


def newest():
    files = sorted((ROOT / "build/peers").glob("*.json"))
    if not files:
        sys.exit("peers_report: no JSON in build/peers: run make peers first")
    return files[-1]


def key(result):
    return result["peer"], result["threads"]


def timed(scene):
    """The results that are times, by peer and threads."""
    return {key(result): result for result in scene["peers"] if result["outcome"] == "timed"}


def summary_row(scene):
    times = timed(scene)
    carom, cgal = times.get(("carom", 1)), times.get((YARDSTICK, 1))
    name = f"{scene['scene']} | {scene['pairs']}"
    if not carom or not cgal:
        wrong = scene["brute_force_difference"]
        why = f"Carom differs from brute force: {wrong}" if wrong else "not timed"
        return row([name, why] + [""] * 7)
    others = [result for (peer, _), result in times.items() if peer not in ("carom", YARDSTICK)]
    fastest = min(others, key=lambda result: result["ms"], default=cgal)
    must, aim = TARGETS.get(scene["scene"].removesuffix(".aabb"), ("", ""))
    ratio = carom["times_cgal"]
    two = times.get(("carom", 2))
    return row([
        name, number(cgal["ms"]), f"{number(fastest['ms'])} ({PEERS[key(fastest)][0]})",
        number(carom["ms"]), f"{ratio:.3g}",
        target(must, must and ratio >= must), target(aim, aim and ratio >= aim),
        f"{fastest['ms'] / carom['ms']:.3g}",
        f"{number(two['ms'])} ({carom['ms'] / two['ms']:.2f}x)" if two else "",
    ])


def summary(scenes):
    yield row(["scene", "pairs", "CGAL ms", "fastest other peer ms", "Carom ms", "x CGAL", "must",
               "aim", "x fastest other", "2 threads ms"])
    yield "|---|" + "---:|" * 9
    yield from map(summary_row, scenes)


def all_times(scenes):
    yield row(["scene"] + [PEERS[peer][0] for peer in PEERS])
    yield "|---|" + "---:|" * len(PEERS)
    for scene in scenes:
        results = {key(result): result for result in scene["peers"]}
        cells = []
        for peer in PEERS:
            result = results.get(peer)
            cells.append("" if not result else number(result["ms"])
                         if result["outcome"] == "timed" else result["outcome"])
        yield row([scene["scene"]] + cells)


def scenes_page(report):
    context, scenes = report["context"], report["scenes"]
    libraries = context["libraries"]
    different = [f"- {scene['scene']}, {result['peer']}: {result['detail']}"
                 for scene in scenes for result in scene["peers"]
                 if result["outcome"] == "different pairs"]
    yield "# The broadphase against other libraries\n"
    yield "Made by one command, on any machine: `make peers` (see [benchmarks](benchmarks.md)).\n"
    yield (f"{machine(context)}, instruction set {context['isa']} chosen at run time; CGAL, "
           f"Bullet and ODE called from files compiled with `{context['peer_flags']}`; CGAL "
           f"{libraries['cgal']}, Bullet {libraries['bullet']}, FCL {libraries['fcl']}, ODE "
           f"{libraries['ode']}; {build(context)}.\n")
    yield ("Milliseconds from the boxes of a frame to all pairs of closed boxes that overlap, "
           "median of the frames; all in one run, in turns. One thread, except where two are "
           "named. `x CGAL`: how many times faster than CGAL's `box_self_intersection_d`, cutoff "
           "64. `must` and `aim` are targets for it, bold where reached.\n")
    yield from summary(scenes)
    yield "\n![Time a frame against the number of bodies](peers.svg)\n"
    yield "## All times (ms a frame)\n"
    yield from all_times(scenes)
    yield ("\nBefore anything is timed, every peer's pairs are compared with Carom's in two "
           "frames, and Carom's with brute force up to 10,000 bodies; the number of pairs is "
           "compared in every frame. "
           + ("These differed:\n" if different else "No peer's pairs differed.\n"))
    yield from different
    yield ("Generated scenes play eight frames forwards and backwards; a `.aabb` is a recording. "
           "Peers that keep state are told of changed boxes alone; those that yield too many pairs "
           "test them again, in their time. `too slow`: a frame took more than "
           f"{context['frame_limit_s']:g} s, or would have, or memory would not do.")


WIDTH, HEIGHT, GAP, LEFT, TOP = 300, 330, 62, 58, 34
LEGEND_COLUMNS, LEGEND_WIDTH, LEGEND_HEIGHT = 4, 300, 22


class Panel:
    """One plot, log-log: bodies against milliseconds."""

    def __init__(self, title, lines, left, decades):
        self.title, self.lines, self.left = title, lines, left
        self.x0, self.x1, self.y0, self.y1 = decades

    def x(self, bodies):
        return self.left + WIDTH * (math.log10(bodies) - self.x0) / (self.x1 - self.x0)

    def y(self, ms):
        return TOP + HEIGHT * (self.y1 - math.log10(ms)) / (self.y1 - self.y0)

    def grid(self):
        right, bottom = self.left + WIDTH, TOP + HEIGHT
        for decade in range(self.x0, self.x1 + 1):
            x = self.x(10**decade)
            label = {3: "1k", 4: "10k", 5: "100k", 6: "1M"}.get(decade, f"1e{decade}")
            yield f'<path class="grid" d="M{x:.1f} {TOP}V{bottom}"/>'
            yield f'<text x="{x:.1f}" y="{bottom + 18}" text-anchor="middle">{label}</text>'
        for decade in range(self.y0, self.y1 + 1):
            y = self.y(10.0**decade)
            yield f'<path class="grid" d="M{self.left} {y:.1f}H{right}"/>'
            yield (f'<text x="{self.left - 6}" y="{y + 4:.1f}" text-anchor="end">'
                   f'{10.0**decade:g}</text>')
        yield (f'<text class="title" x="{self.left}" y="{TOP - 12}">{html.escape(self.title)}: '
               'ms a frame</text>')

    def draw(self):
        yield from self.grid()
        for peer in reversed(PEERS):  # Carom on top
            points = [f"{self.x(n):.1f} {self.y(ms):.1f}" for n, ms in self.lines.get(peer, [])]
            if not points:
                continue
            _, colour, dashes = PEERS[peer]
            width = 3 if peer[0] == "carom" else 1.6
            yield (f'<path fill="none" stroke="{colour}" stroke-width="{width}" '
                   f'stroke-dasharray="{dashes}" d="M{"L".join(points)}"/>')
            for point in points:
                x, y = point.split()
                yield f'<circle cx="{x}" cy="{y}" r="{width}" fill="{colour}"/>'


def lines_by_generator(scenes):
    """{generator: {peer: [(bodies, ms)]}} of scenes that were generated in several sizes."""
    found = {}
    for scene in scenes:
        if scene["scene"].endswith(".aabb"):
            continue
        lines = found.setdefault(scene["scene"].rsplit("_", 1)[0], {})
        for peer, result in timed(scene).items():
            lines.setdefault(peer, []).append((scene["bodies"], result["ms"]))
    return {name: lines for name, lines in found.items()
            if any(len(points) > 1 for points in lines.values())}


def legend(bottom):
    for i, (name, colour, dashes) in enumerate(PEERS.values()):
        x = LEFT + i % LEGEND_COLUMNS * LEGEND_WIDTH
        y = bottom + i // LEGEND_COLUMNS * LEGEND_HEIGHT
        width = 3 if name.startswith("Carom") else 1.6
        yield (f'<path stroke="{colour}" stroke-width="{width}" stroke-dasharray="{dashes}" '
               f'd="M{x} {y}h34"/>')
        yield f'<text x="{x + 42}" y="{y + 4}">{html.escape(name)}</text>'


def plot(scenes):
    generators = lines_by_generator(scenes)
    points = [point for lines in generators.values() for line in lines.values() for point in line]
    if not points:
        return
    bodies, times = zip(*points)
    decades = (math.floor(math.log10(min(bodies))), math.ceil(math.log10(max(bodies))),
               math.floor(math.log10(min(times))), math.ceil(math.log10(max(times))))
    width = max(LEFT + len(generators) * (WIDTH + GAP), LEFT + LEGEND_COLUMNS * LEGEND_WIDTH)
    bottom = TOP + HEIGHT + 54
    height = bottom + LEGEND_HEIGHT * math.ceil(len(PEERS) / LEGEND_COLUMNS)
    yield (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
           'font-family="sans-serif" font-size="13">')
    yield ("<style>.grid{stroke:#ddd;stroke-width:1}.title{font-size:15px;font-weight:bold}"
           "text{fill:#222}</style>")
    yield f'<rect width="{width}" height="{height}" fill="white"/>'
    for i, (name, lines) in enumerate(generators.items()):
        yield from Panel(name, lines, LEFT + i * (WIDTH + GAP), decades).draw()
    yield (f'<text x="{LEFT + WIDTH / 2}" y="{TOP + HEIGHT + 36}" text-anchor="middle">bodies'
           '</text>')
    yield from legend(bottom)
    yield "</svg>"


def write(path, lines):
    path.write_text("\n".join(lines) + "\n")
    print(f"peers_report: {path}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("json", nargs="?", type=pathlib.Path, help="default: newest of build/peers")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "docs", help="default: docs")
    arguments = parser.parse_args()
    report = json.loads((arguments.json or newest()).read_text())
    arguments.out.mkdir(parents=True, exist_ok=True)
    if report["scenes"]:
        write(arguments.out / "peers.md", scenes_page(report))
        write(arguments.out / "peers.svg", plot(report["scenes"]))
    if report["streams"]:
        write(arguments.out / "narrowphase_peers.md", streams_page(report))


if __name__ == "__main__":
    main()
