"""The page of the narrow phase against other libraries, for peers_report.py; and how its pages write
numbers and rows."""

# How many times faster than Bullet Carom has to be, and wants to be, on the strongest instruction
# set. Quotients: the time of Bullet where the target was set, by those of the target.
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
    ("hull_hull_8", "distance"): (9, 14),
    ("hull_hull_16", "distance"): (9, 14),
    ("hull_hull_32", "distance"): (9, 14),
    ("hull_hull_64", "distance"): (9, 14),
    ("hull_hull_8", "contact"): (8, 14),
    ("hull_hull_16", "contact"): (8, 14),
    ("hull_hull_32", "contact"): (8, 12),
    ("hull_hull_8", "manifold"): (7, 14),
    ("hull_hull_16", "manifold"): (7, 14),
    ("hull_hull_32", "manifold"): (7, 12),
    ("sphere_mesh", "contact"): (4, 7),
    ("capsule_mesh", "contact"): (6779 / 900, 6779 / 400),
    ("box_mesh", "contact"): (13799 / 1700, 13799 / 800),
    ("hull_mesh_16", "contact"): (7, 11),
    ("mesh_mesh", "contact"): (5, 20),
    ("hull_hull_16", "toi"): (10, 25),
    ("hull_hull_16", "turning"): (5, 10),
    ("sphere_sphere", "impact"): (20, 40),
    ("box_box", "impact"): (15, 40),
    ("hull_hull_16", "impact"): (8, 20),
}


def number(value):
    """Three digits, without an exponent."""
    return f"{value:.0f}" if value >= 100 else f"{value:#.3g}"


def target(value, reached):
    return f"**{value}**" if reached else str(value)


def row(cells):
    return "| " + " | ".join(cells) + " |"


def machine(context):
    return (f"{context['cpu']}, {context['processors']} processors; {context['compiler']}, "
            f"`{context['flags']}`")


def build(context):
    return f"carom {context['carom_version']}, commit {context['commit']}; {context['date']}"


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


def exact_table(results, version):
    """Exact decisions of Carom and CGAL."""
    if not results:
        return
    yield "## Exact decisions\n"
    yield (f"Overlap or not, at the standard and the exact tier, beside CGAL {version} with "
           "`Exact_predicates_exact_constructions_kernel`, which computes with intervals and, where "
           "these do not decide, in rationals: `compare_squared_distance()` of spheres, "
           "`squared_distance()` of a point and a triangle, `do_intersect()` of triangles and of "
           "closed surface meshes. Bodies stand in their places, and coordinates that CGAL needs exactly have been found "
           "so, before the time begins. `touching`: "
           "pairs that touch to within the rounding of their positions. CGAL decides the first "
           "2,000 pairs. `otherwise`: pairs that it decides otherwise than the exact tier, with "
           "none left out.\n")
    yield row(["pair", "pairs are", "overlap", "standard", "exact", "CGAL", "x CGAL", "otherwise"])
    yield "|---|---|" + "---:|" * 6
    for result in results:
        ns = result["ns"]
        yield row([result["pair"], "touching" if result["touching"] else "random",
                   f"{result['hit_percent']:.1f} %"]
                  + [number(ns[runner]) for runner in ("standard", "exact", "cgal")]
                  + [f"{ns['cgal'] / ns['exact']:.3g}", str(result["different"])])
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
           "knew, while Bullet begins anew. Bullet is asked for depths in all three. `toi`: "
           "one of the two moves in a straight line, and the time of impact is found, `impact`: "
           "and the contact then; half of the pairs meet; `turning`: both turn as well, by up to a "
           "radian. Bullet runs `btContinuousConvexCollision`, as the sweep test of its world does; "
           "its other cast is below.\n")
    yield from casts_table(streams)
    yield from meshes_table(streams, isas)
    yield from others_tables(streams, context["libraries"], isas[-1])
    yield from exact_table(report.get("exact"), context["libraries"]["cgal"])
    yield "## Decisions\n"
    yield ("Before anything is timed, all results of Carom are compared with its reference bit by "
           "bit, and Bullet's decisions with Carom's, except for pairs whose separation is below "
           "0.001 of their mean bounding radius: Bullet rounds the corners of boxes and makes "
           "triangles thicker by a margin, 0.25 mm here. The errors are those of its separations "
           "and depths, as above. Its boxes prefer a face to a pair of edges by 5 %, as ODE's.\n")
    yield from decisions_table(streams)
