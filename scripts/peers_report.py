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

# How many times faster than Bullet Carom has to be, and wants to be, on the strongest instruction
# set: the time of Bullet where the target was set, by those of the target.
STREAM_TARGETS = {
    ("sphere_sphere", "contact"): (25 / 2.7, 25 / 1.4),
    ("sphere_sphere", "toi"): (627 / 20, 627 / 5),
    ("capsule_capsule", "toi"): (2262 / 70, 2262 / 25),
    ("box_box", "toi"): (2001 / 200, 2001 / 80),
    ("sphere_box", "contact"): (754 / 8, 754 / 3.3),
    ("sphere_aabb", "contact"): (789 / 8, 789 / 2.5),
    ("sphere_capsule", "contact"): (47 / 8, 47 / 2.4),
    ("capsule_capsule", "contact"): (47 / 9, 47 / 3.5),
    ("capsule_box", "contact"): (1448 / 50, 1448 / 15),
    ("box_box", "overlap"): (177 / 9, 177 / 5),
    ("box_box", "manifold"): (229 / 18, 229 / 10),
    ("sphere_triangle", "contact"): (109 / 17, 109 / 5),
    ("capsule_triangle", "contact"): (981 / 40, 981 / 12),
    ("box_triangle", "contact"): (1643 / 60, 1643 / 20),
    ("hull_hull_8", "clearance"): (1937 / 95, 1937 / 60),
    ("hull_hull_16", "clearance"): (2523 / 125, 2523 / 80),
    ("hull_hull_32", "clearance"): (3298 / 180, 3298 / 105),
    ("hull_hull_64", "clearance"): (4946 / 300, 4946 / 160),
    ("hull_hull_8", "again"): (1937 / 60, 1937 / 25),
    ("hull_hull_16", "again"): (2523 / 75, 2523 / 35),
    ("hull_hull_32", "again"): (3298 / 100, 3298 / 45),
    ("hull_hull_8", "distance"): (1937 / 95, 1937 / 60),
    ("hull_hull_16", "distance"): (2523 / 125, 2523 / 80),
    ("hull_hull_32", "distance"): (3298 / 180, 3298 / 105),
    ("hull_hull_64", "distance"): (4946 / 300, 4946 / 160),
    ("hull_hull_8", "contact"): (2055 / 300, 2055 / 150),
    ("hull_hull_16", "contact"): (2729 / 400, 2729 / 200),
    ("hull_hull_32", "contact"): (3607 / 550, 3607 / 300),
    ("hull_hull_8", "manifold"): (2055 / 300, 2055 / 150),
    ("hull_hull_16", "manifold"): (2729 / 400, 2729 / 200),
    ("hull_hull_32", "manifold"): (3607 / 550, 3607 / 300),
    ("sphere_mesh", "contact"): (1354 / 400, 1354 / 200),
    ("capsule_mesh", "contact"): (6779 / 900, 6779 / 400),
    ("box_mesh", "contact"): (13799 / 1700, 13799 / 800),
    ("hull_mesh_16", "contact"): (15948 / 2700, 15948 / 1500),
    ("mesh_mesh", "contact"): (5, 20),
    ("hull_hull_16", "toi"): (10, 25),
    ("hull_hull_16", "turning"): (5, 10),
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


def number(value):
    """Three digits, without an exponent."""
    return f"{value:.0f}" if value >= 100 else f"{value:#.3g}"


def target(value, reached):
    return f"**{value}**" if reached else str(value)


def row(cells):
    return "| " + " | ".join(cells) + " |"


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


def machine(context):
    return (f"{context['cpu']}, {context['processors']} processors; {context['compiler']}, "
            f"`{context['flags']}`")


def build(context):
    return f"carom {context['carom_version']}, commit {context['commit']}; {context['date']}"


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


def stream_row(stream, isas):
    runners = {runner["runner"]: runner for runner in stream["runners"]}
    name = [stream["pair"], stream["detail"]]
    if not runners:
        return row(name + [stream["wrong"] or "too many decisions differ"] + [""] * (len(isas) + 4))
    must, aim = STREAM_TARGETS.get((stream["pair"], stream["detail"]), (None, None))
    ratio = runners[isas[-1]]["times_bullet"]
    times = [number(runners[runner]["ns"]) if runner in runners else "-"
             for runner in ["bullet", "reference"] + isas]
    targets = [target(f"{goal:.3g}", ratio >= goal) if goal else "" for goal in (must, aim)]
    return row(name + times + [f"{ratio:.3g}"] + targets)


def streams_table(streams, isas):
    strongest = isas[-1]
    yield row(["pair", "output", "Bullet", "reference"] + isas
              + [f"{strongest}: x Bullet", "must", "aim"])
    yield "|---|---|" + "---:|" * (len(isas) + 5)
    for stream in streams:
        yield stream_row(stream, isas)


def casts_table(streams):
    """Bullet's two casts."""
    casts = [stream for stream in streams if stream["detail"] == "toi" and stream["runners"]]
    if not casts:
        return
    yield "\n## Casts of Bullet\n"
    yield row(["pair", "`btContinuousConvexCollision`", "`btGjkConvexCast`"])
    yield "|---|---:|---:|"
    for stream in casts:
        times = {runner["runner"]: runner["ns"] for runner in stream["runners"]}
        yield row([stream["pair"], number(times["bullet"]), number(times["bullet_gjk"])])
    yield ""


# Other libraries than Bullet: a section each, with the runners in it, what they call, and what is
# known of their errors.
OTHERS = [
    ("FCL", {"fcl": ""},
     "`fcl::collide()` of two objects, and `fcl::distance()` for `distance`, `clearance` and "
     "`again`. It finds one contact, four for manifolds; for `overlap` none. `collide()` asks "
     "libccd's MPR about capsules and hulls, so that depths are too large (see libccd); of two boxes "
     "whose edges meet they are up to 5 % too large, since a face is preferred (see ODE)."),
    ("ODE", {"ode": ""},
     "`dCollide()` of two geoms, for one contact, four for manifolds. For two boxes it takes a face "
     "rather than a pair of edges unless these are better by 5 %, and its depth is then as much too "
     "large. For a capsule and a box it measures from the point of the capsule's axis that is nearest "
     "to the box: the depth is right while the axis is outside, and too small once it is inside."),
    ("libccd", {"ccd_gjk": "GJK, EPA", "ccd_mpr": "MPR"},
     "`ccdGJKPenetration()` and `ccdMPRPenetration()`, for `overlap` `ccdGJKIntersect()` and "
     "`ccdMPRIntersect()`, at the tolerance of 1e-6 that FCL sets. MPR finds the depth in the "
     "direction in which its portal leaves the shape, which is never less than the least and up to "
     "2.5 times as much. GJK and EPA find the least for polyhedra but for some pairs, whose depth is too "
     "small; for round shapes more often, and sometimes 0."),
    ("MuJoCo", {"mujoco": ""},
     "The collider of the two types in its public table `mjCOLLISIONFUNC`, without the rest of "
     "`mj_collision()`. Pose and size are written into the model in the time. Hulls have more "
     "than one contact for manifolds alone (`multiccd`). `dist` of the deepest contact is compared. "
     "For two boxes it is right where edges meet, and half the depth where the least depth is across "
     "a face. For a capsule and a box it is right while the axis is outside, and too small once it is "
     "inside; for a sphere whose centre is inside it is the radius. Hulls go to MPR, as with "
     "libccd."),
]


def agreement_cells(agreement):
    """The share of decisions that differ, and the errors of what was measured."""
    compared = max(agreement["pairs"] - agreement["excluded"], 1)
    errors = [f"{agreement[error]:.1e}" if agreement["measured"] else "-"
              for error in ("median_error", "worst_error")]
    return [f"{100 * agreement['different'] / compared:.3g} %"] + errors


def other_rows(streams, names, strongest):
    for stream in streams:
        runners = {runner["runner"]: runner for runner in stream["runners"]}
        for name, title in names.items():
            if name not in runners or stream["pair"] == "mesh_mesh":
                continue
            runner = runners[name]
            pair = f"{stream['pair']}, {title}" if title else stream["pair"]
            yield row([pair, stream["detail"], number(runner["ns"]),
                       f"{runner['ns'] / runners[strongest]['ns']:.3g}"]
                      + agreement_cells(runner["agreement"]))


def others_tables(streams, libraries, strongest):
    yield "\n## Other libraries\n"
    yield ("In the same run, on the first 20,000 pairs of a stream; all compute in double precision. "
           "`x`: how many times slower than Carom on its strongest instruction set. `otherwise`: the "
           "share of pairs that the library decides otherwise than Carom, apart from those too near "
           "touch. `error`: how far the separation or depth that it reports is from Carom's, as a "
           "share of the mean bounding radius, median and worst; of several contacts the deepest "
           "counts. Carom's own errors are in [accuracy](accuracy.md).\n")
    if not libraries["mujoco"]:
        yield "MuJoCo was not installed when this page was made.\n"
    for library, names, calls in OTHERS:
        rows = list(other_rows(streams, names, strongest))
        if not rows:
            continue
        yield f"### {library}\n"
        yield calls + "\n"
        yield row(["pair", "output", "ns", "x", "otherwise", "error", "worst error"])
        yield "|---|---|" + "---:|" * 5
        yield from rows
        yield ""


def meshes_table(streams, isas):
    """Two meshes."""
    stream = next((s for s in streams if s["pair"] == "mesh_mesh" and s["runners"]), None)
    if not stream:
        return
    runners = {runner["runner"]: runner for runner in stream["runners"]}
    yield "\n## Two meshes\n"
    yield (f"`mesh_mesh`: {stream['pairs']} pairs of bumpy balls of 10,092 triangles each; those that "
           "touch do so over some 35 triangles of each. Carom finds the deepest contact. Bullet: "
           "`btGImpactCollisionAlgorithm` without a margin. FCL: `collide()` of two "
           "`BVHModel<OBBRSS>` with contacts, all of them or the first that it finds. The "
           "reference, which tries all pairs of triangles, is left out: the instruction sets are "
           "compared with the scalar form.\n")
    yield row(["library", "ns", "x", "otherwise"])
    yield "|---|" + "---:|" * 3
    for name, title in (("bullet", "Bullet"), ("fcl", "FCL, all contacts"),
                        ("fcl_first", "FCL, first contact")):
        runner = runners[name]
        yield row([title, number(runner["ns"]), f"{runner['ns'] / runners[isas[-1]]['ns']:.3g}",
                   agreement_cells(runner["agreement"])[0]])
    yield ""


def decisions_table(streams):
    yield row(["pair", "output", "pairs", "overlap", "too near touch", "Bullet decides otherwise",
               "error", "worst error"])
    yield "|---|---|" + "---:|" * 6
    for stream in streams:
        bullet = stream["bullet"]
        yield row([stream["pair"], stream["detail"], str(stream["pairs"]),
                   f"{stream['hit_percent']:.1f} %", str(bullet["excluded"]),
                   str(bullet["different"])] + agreement_cells(bullet)[1:])


def streams_page(report):
    context, streams = report["context"], report["streams"]
    isas = context["isas"].split()
    yield "# The narrow phase against Bullet\n"
    yield "Made by one command, on any machine: `make peers` (see [benchmarks](benchmarks.md)).\n"
    yield (f"{machine(context)}; Bullet {context['libraries']['bullet']} as the distribution "
           f"compiled it, called from files compiled with `{context['peer_flags']}`; "
           f"{build(context)}.\n")
    yield ("Nanoseconds of processor time a pair, median of the passes over a stream; all in one "
           "run, in turns, on one thread. `reference`: Carom's scalar reference, which always "
           "finds everything; then Carom on every instruction set. `x Bullet`: how many times "
           "faster than Bullet the strongest is. `must` and `aim` are targets for it, bold where "
           "reached.\n")
    yield from streams_table(streams, isas)
    yield ("\nA stream holds random pairs, half of which overlap; the others are near misses: at "
           "most 1.3 times as far off as bounds that touch. Sizes are from 0.25 to 2 m, "
           "orientations random, positions float32. Carom is asked by `collide_rows()` and writes "
           "its results to memory. Bullet runs the algorithm that its dispatcher picks for the two "
           "shapes, made once, with the manifold emptied before every pair; the overlap of boxes "
           "is that algorithm's detector without a manifold. `aabb` is a box that is not turned. "
           "`distance`: all pairs are measured, which for those that overlap is their depth; "
           "`clearance`: those that are apart, and of the others the decision; `again`: the same a "
           "step further (1 % of the diagonal of the bounds, 0.01 radians), with what the last step "
           "knew, while Bullet begins anew. Bullet is asked for depths in all three: the targets "
           "are those that were set for distances without depths. `toi`: one of the two moves in "
           "a straight line, and the time of impact is found, `impact`: and the contact then; half "
           "of the pairs meet; `turning`: both turn as well, by up to a radian. Bullet runs `btContinuousConvexCollision`, as the sweep test of its "
           "world does; its other cast is below.\n")
    yield from casts_table(streams)
    yield from meshes_table(streams, isas)
    yield from others_tables(streams, context["libraries"], isas[-1])
    yield "## Decisions\n"
    yield ("Before anything is timed, all results of Carom are compared with its reference bit by "
           "bit, and Bullet's decisions with Carom's, except for pairs whose separation is below "
           "0.001 of their mean bounding radius: Bullet rounds the corners of boxes and makes "
           "triangles thicker by a margin, 0.25 mm here. The errors are those of its separations "
           "and depths, as above. Its boxes prefer a face to a pair of edges by 5 %, as ODE's.\n")
    yield from decisions_table(streams)


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
