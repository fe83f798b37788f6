#!/usr/bin/env python3
"""Measures what a frame may cost, and keeps the figures of each version in docs/benchmarks.md, so
that a slip shows.

  frame_rows.py CAROM_RUN CAROM_BENCH [--rounds N] [--most-bodies N] [--write]

Prints a table: a row, its figure, what it must be and what it aims at. --write also puts the table
into the page, in the place of that of the same version. All scenes run in turn, in several rounds. Of
each the least median counts, since other programs only ever add. Nothing else should run.
"""

import argparse
import itertools
import json
import pathlib
import re
import subprocess
import sys
import tempfile

PAGE = pathlib.Path(__file__).parents[1] / "docs/benchmarks.md"
HEADING = "## Frames, version by version\n"

SCENES = {
    "10k cubes": "brownian:n=10000",
    "10k spheres": "brownian:n=10000,shape=sphere",
    "100k cubes": "brownian:n=100000",
    "100k spheres": "brownian:n=100000,shape=sphere",
    "100k boxes": "brownian:n=100000,shape=box",
    "1M cubes": "brownian:n=1000000",
    "1M spheres": "brownian:n=1000000,shape=sphere",
    "10M spheres": "brownian:n=10000000,shape=sphere",
}
RUNS = [
    ("10k cubes", "contact"), ("10k spheres", "contact"),
    ("100k cubes", "pairs"), ("100k cubes", "contact"),
    ("100k spheres", "pairs"), ("100k spheres", "contact"), ("100k boxes", "manifold"),
    ("1M cubes", "pairs"), ("1M cubes", "contact"),
    ("1M spheres", "pairs"), ("1M spheres", "contact"), ("10M spheres", "contact"),
]
OF_TARGETS = [("100k cubes", "contact"), ("100k spheres", "contact"), ("100k boxes", "manifold")]
LEAST_STAGE_MS = 0.2  # shorter stages are not compared between targets
BENCH = "^bounds/(box|capsule|dop)/f32/t1/|^world/(moving|spaces)/"


def bodies(scene):
    return int(re.search(r"n=(\d+)", SCENES[scene])[1])


def json_of(command, option):
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        subprocess.run([*command, option + out.name], check=True, stdout=subprocess.DEVNULL)
        return json.load(open(out.name))


class Measurements:
    def __init__(self, options):
        self.options = options
        self.reports = {}  # by scene, detail, threads and target
        self.bench = {}    # nanoseconds a body, by name
        self.machine = self.narrower = self.wider = None
        for _ in range(options.rounds):
            for (scene, detail), threads in itertools.product(RUNS, (1, 2)):
                if bodies(scene) <= options.most_bodies:
                    self.run(scene, detail, threads)
            self.run_bench()
        self.compare_targets()

    def run(self, scene, detail, threads, isa="auto"):
        frames = max(6, min(60, 20_000_000 // bodies(scene)))
        report = json_of([self.options.run, "run", SCENES[scene], "--frames", str(frames), "--detail",
                          detail, "--threads", str(threads), "--isa", isa, "--json"], "")
        best = self.reports.setdefault((scene, detail, threads, isa), report)
        for key in ("stage_ms", "frame_ms"):
            best[key] = {name: min(ms, report[key][name]) for name, ms in best[key].items()}
        best["first_frame_ms"] = min(best["first_frame_ms"], report["first_frame_ms"])
        return best

    def run_bench(self):
        result = json_of([self.options.bench, f"--benchmark_filter={BENCH}",
                          "--benchmark_min_time=0.2", "--benchmark_out_format=json"],
                         "--benchmark_out=")
        self.machine = result["context"]
        for row in result["benchmarks"]:
            name, ns = row["name"], row["ns_per_body"]
            self.bench[name] = min(ns, self.bench.get(name, ns))

    def compare_targets(self):
        """Runs scenes on the two widest targets of this machine."""
        self.narrower, self.wider = self.machine["isas"].split()[-2:]
        for _, (scene, detail), isa in itertools.product(
                range(self.options.rounds), OF_TARGETS, (self.narrower, self.wider)):
            self.run(scene, detail, 1, isa)

    def ms(self, scene, detail, threads=1):
        return self.reports[scene, detail, threads, "auto"]["frame_ms"]["median"]

    def ns(self, pattern):
        return max(ns for name, ns in self.bench.items() if re.match(pattern, name))


def first_to_tenth(measured, scene):
    report = measured.reports[scene, "contact", 1, "auto"]
    return report["first_frame_ms"] / report["frame_ms"]["median"]


def bytes_of(measured, scene, key):
    return measured.reports[scene, "contact", 1, "auto"][key]


def worst_stage(measured):
    """How many times as long as on the narrower target the slowest stage takes on the wider one."""
    ratios = []
    for scene, detail in OF_TARGETS:
        narrow, wide = (measured.reports[scene, detail, 1, isa]["stage_ms"]
                        for isa in (measured.narrower, measured.wider))
        ratios += [(wide[stage] / ms, f"{stage}, {scene}") for stage, ms in narrow.items()
                   if ms >= LEAST_STAGE_MS]
    return max(ratios)


def page_faults(measured):
    """The mean of a frame in the worst scene."""
    means = []
    for (scene, detail, threads, isa), report in measured.reports.items():
        faults = report["page_faults_per_frame"][10:60]
        if isa == "auto" and faults:
            means.append((sum(faults) / len(faults), f"{scene}, {detail}, {threads} threads"))
    return max(means)


def rows(m):
    """Name, figure, must, aim; `must` has the sense of the comparison in front."""
    def ratio(name, scene, detail, of, of_detail, must, aim):
        return (name, m.ms(scene, detail) / m.ms(of, of_detail), must, aim)

    def has(scene):
        return bodies(scene) <= m.options.most_bodies

    for scene, must, aim in (("1M cubes", 1.8, 1.4), ("1M spheres", 1.4, 1.2),
                             ("100k cubes", 1.8, 1.4), ("100k spheres", 1.4, 1.2)):
        if has(scene):
            yield ratio(f"{scene}, contacts : pairs alone", scene, "contact", scene, "pairs", must, aim)
    yield ratio("100k boxes, manifolds : 100k cubes, pairs alone", "100k boxes", "manifold",
                "100k cubes", "pairs", 2.5, 1.8)
    for kind in ("box", "capsule", "dop"):
        yield (f"bounds of a {kind}, ns", m.ns(f"bounds/{kind}/f32/t1/{m.wider}"), 10, 5)
    if has("1M spheres"):
        yield ("1M spheres, contacts, one thread, ms", m.ms("1M spheres", "contact"), 150, 80)
        yield ("the same, two threads, ms", m.ms("1M spheres", "contact", 2), 80, 45)
    for scene, detail in RUNS:
        if has(scene):
            yield (f"{scene}, {detail}, one thread : two",
                   m.ms(scene, detail) / m.ms(scene, detail, 2), -1.85, -1.95)
    if has("1M cubes"):
        yield ("1M cubes, contacts, bytes held a body", bytes_of(m, "1M cubes", "bytes_per_body"),
               300, 200)
        yield ("the same, bytes of the process at the peak a body",
               bytes_of(m, "1M cubes", "peak_rss_bytes") / bodies("1M cubes"), 400, 250)
    for crowd in ("100k_cubes", "100k_spheres"):
        everything = m.ns(f"world/moving/{crowd}/all/t1")
        yield (f"1 % of {crowd} move : all", m.ns(f"world/moving/{crowd}/some/t1") / everything,
               0.1, 0.03)
        yield (f"none of {crowd} moves : all", m.ns(f"world/moving/{crowd}/none/t1") / everything,
               0.01, 0.003)
    for scene in ("10k cubes", "100k cubes", "100k spheres", "1M cubes", "1M spheres"):
        if has(scene):
            yield (f"{scene}, first frame : median", first_to_tenth(m, scene), 1.3, 1.1)
    stage_ratio, stage = worst_stage(m)
    yield (f"{m.wider} : {m.narrower}, the worst stage ({stage})", stage_ratio, 1.03, 0.8)
    for scene in ("1M spheres", "10M spheres"):
        if has(scene):
            a_body = m.ms(scene, "contact") / bodies(scene)
            yield (f"cost a body, {scene} : 10k spheres",
                   a_body / (m.ms("10k spheres", "contact") / 10_000), 2, 1.4)
    faults, worst = page_faults(m)
    yield (f"page faults a frame, frames 10 to 60 ({worst})", faults, 0, 0)
    for crowd, count, must, aim in (("20_boxes", 20, 4, 2), ("100_spheres", 100, 6, 3),
                                    ("500_boxes", 500, 60, 35)):
        yield (f"a step of {crowd}, us", m.ns(f"world/moving/{crowd}/all/t1") * count * 1e-3, must, aim)
    yield ("4,096 spaces : as many worlds",
           m.ns("world/spaces/.*/together") / m.ns("world/spaces/.*/alone"), 0.33, 0.15)


def short(number):
    return f"{number:.0f}" if number >= 100 or number == int(number) else f"{number:.3g}"


def is_met(figure, must):
    return figure >= -must if must < 0 else figure <= must


def table(measured):
    machine = measured.machine
    yield f"### carom {machine['carom_version']}"
    yield ""
    yield (f"{machine['cpu']}, {machine['num_cpus']} processors; {machine['compiler']}; commit "
           f"{machine['commit']}; {machine['date'][:10]}.")
    yield ""
    yield "| row | figure | must | aim | |"
    yield "|---|---:|---:|---:|---|"
    for name, figure, must, aim in rows(measured):
        sense = "at least " if must < 0 else ""
        yield (f"| {name} | {short(figure)} | {sense}{abs(must):g} | {abs(aim):g} | "
               f"{'met' if is_met(figure, must) else 'short'} |")


def write(lines):
    text, heading, blocks = PAGE.read_text().partition(HEADING)
    if not heading:
        sys.exit(f"frame_rows: no section '{HEADING.strip()}' in {PAGE.name}")
    version = lines[0]
    kept = [block for block in re.split(r"^(?=### )", blocks, flags=re.M)
            if block.splitlines()[:1] != [version]]
    new = "\n".join(lines) + "\n"
    PAGE.write_text(text + heading + kept[0] + "\n".join([new] + kept[1:]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run", help="carom-run of a release build")
    parser.add_argument("bench", help="carom_bench of the same build")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--most-bodies", type=int, default=10_000_000)
    parser.add_argument("--write", action="store_true", help="keep the table in docs/benchmarks.md")
    options = parser.parse_args()
    lines = list(table(Measurements(options)))
    print("\n".join(lines))
    if options.write:
        write(lines)


if __name__ == "__main__":
    main()
