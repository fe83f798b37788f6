#!/usr/bin/env python3
"""Writes the tables of docs/frame.md: what the stages of a frame cost, and what memory alone would
cost. The text above the tables is written by hand and stays.

  frame_page.py CAROM_RUN CAROM_BENCH [--frames N] [--most-bodies N]

Both programs run here, one after the other: nothing else should. Times are medians over frames.
"""

import argparse
import json
import pathlib
import subprocess
import tempfile

PAGE = pathlib.Path(__file__).parents[1] / "docs/frame.md"

# A body consists of so many bytes of a pose, and so many of a shape beside that, in so many arrays.
SPHERE, CUBE, BOX = (16, 0, 1), (16, 32, 2), (32, 16, 3)

SCENES = [
    ("brownian:n=10000,shape=sphere", "contact", SPHERE),
    ("brownian:n=100000,shape=sphere", "contact", SPHERE),
    ("brownian:n=1000000,shape=sphere", "contact", SPHERE),
    ("brownian:n=10000,shape=cube", "contact", CUBE),
    ("brownian:n=100000,shape=cube", "contact", CUBE),
    ("brownian:n=1000000,shape=cube", "contact", CUBE),
    ("brownian:n=100000,shape=box", "manifold", BOX),
    ("varied:n=100000", "contact", CUBE),
    ("static:n=100000", "contact", CUBE),
    ("brownian:n=10000000,shape=sphere", "contact", SPHERE),
]

# The least that each stage reads and writes: bytes a body, a pair, a tested pair, a contact and an
# event. `contact` stands for the bytes of a contact. All bodies are taken to have moved.
FLOOR = {
    "changes": lambda pose, shape, arrays, contact: (3 * pose + 1, 0, 0, 0, 0),  # now, copy, new copy
    "bounds": lambda pose, shape, arrays, contact: (pose + shape + 24, 0, 0, 0, 0),
    "broadphase": lambda pose, shape, arrays, contact: (24, 8, 0, 0, 0),  # bounds in, pairs out
    "pairs": lambda pose, shape, arrays, contact: (0, 16, 0, 0, 0),  # those of this step and the last
    # The pair in; overlap, separation, normal and two arms out, or 64 bytes of points as well.
    "narrowphase": lambda pose, shape, arrays, contact: (pose + shape, 0, 8 + 41, contact - 64, 0),
    # All that in, or the contact of the last step; index, overlap and contact out.
    "results": lambda pose, shape, arrays, contact: (0, 8 + 5, 41, 2 * contact - 64, 0),
    "velocities": lambda pose, shape, arrays, contact: (12, 0, 0, 0, 0),  # contacts are in the cache
    "events": lambda pose, shape, arrays, contact: (0, 2 * (8 + 1), 0, 0, 24),
}

# A stage moves so many bytes between the core and the caches or memory, counted in its code; much of
# it stays in the caches. The second body of a pair lies anywhere: each of its arrays takes a line of 64 bytes.
MOVED = FLOOR | {
    # Bounds twice; keys, records and rows written and read; the rows of some neighbours. Pairs found,
    # counted, put into buckets, counted again, split into lists of partners, and sorted.
    "broadphase": lambda pose, shape, arrays, contact: (2 * 24 + 2 * 4 + 2 * 32 + 2 * 32 + 8, 56, 0, 0, 0),
    "narrowphase": lambda pose, shape, arrays, contact: (
        pose + shape, 0, 8 + 41 + 64 * arrays, contact - 64, 0),
    "velocities": lambda pose, shape, arrays, contact: (12, 0, 0, 64, 0),
    # Of both steps: pairs, overlaps and places of contacts in, two numbers each out and in again.
    "events": lambda pose, shape, arrays, contact: (0, 2 * (13 + 32), 0, 0, 24),
}


def run(program, *args):
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        subprocess.run([program, *args, out.name], check=True, stdout=subprocess.DEVNULL)
        return json.load(open(out.name))


def ns_a_line(bench):
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        subprocess.run([bench, "--benchmark_filter=^memory/", f"--benchmark_out={out.name}",
                        "--benchmark_out_format=json", "--benchmark_min_time=1"],
                       check=True, stdout=subprocess.DEVNULL)
        result = json.load(open(out.name))
    return ({b["name"].removeprefix("memory/"): b["ns_per_line"] for b in result["benchmarks"]},
            result["context"])


def short(number):
    return f"{number:,.0f}" if number >= 100 else f"{number:.3g}"


def mean(values):
    values = values[1:] or values  # the first frame has no last one
    return sum(values) / len(values)


def bytes_of(counts, stage, kind, scene):
    tests_all = mean(scene["tested_pairs_per_frame"]) > 0.99 * mean(scene["pairs_per_frame"])
    if stage == "changes" and tests_all:
        return 0  # a sample says that everything moves
    a_contact = 128 if scene["detail"] == "manifold" else 64
    body, pair, tested, contact, event = counts[stage](*kind, a_contact)
    # Overlaps that persist are counted, but make no event.
    events = sum(mean(scene["events_per_frame"][kind]) for kind in ("begin", "end"))
    return (body * scene["bodies"] + pair * mean(scene["pairs_per_frame"]) +
            tested * mean(scene["tested_pairs_per_frame"]) +
            contact * mean(scene["contacts_per_frame"]) + event * events)


def on_64_cores(one_thread, two_threads):
    """How many times as fast 64 cores are by Amdahl's law."""
    serial = min(1, sum(two_threads["serial_ms"].values()) / one_thread["frame_ms"]["median"])
    return 1 / (serial + (1 - serial) / 64)


def scene_rows(name, detail, kind, scene, two_threads, ns):
    bodies = scene["bodies"]
    frame, frame_2 = scene["frame_ms"]["median"], two_threads["frame_ms"]["median"]
    yield ""
    yield f"### `{name}`, detail {detail}"
    yield ""
    yield (f"{bodies:,} bodies, {mean(scene['pairs_per_frame']):,.0f} pairs. One thread "
           f"{short(frame)} ms, two {short(frame_2)} ms ({frame / frame_2:.2f} times as fast; "
           f"64 cores: {on_64_cores(scene, two_threads):.0f} times), "
           f"{scene['bytes_per_body']:.0f} bytes a body held.")
    yield ""
    yield ("| stage | ms | ns a body | ns a pair | MB moved | least MB | ms for these at the speed of a "
           "copy | times that | ms on two threads | of these serial |")
    yield "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|"
    pairs = mean(scene["pairs_per_frame"])
    total = 0
    for stage, ms in scene["stage_ms"].items():
        if stage not in FLOOR or ms == 0:
            continue
        least = bytes_of(FLOOR, stage, kind, scene)
        moved = bytes_of(MOVED, stage, kind, scene)
        least_ms = least / 128 * ns["copy/t1"] / 1e6  # a copied line is read and written
        total += least_ms
        yield (f"| {stage} | {short(ms)} | {1e6 * ms / bodies:.1f} | {1e6 * ms / pairs:.1f} | "
               f"{short(moved / 1e6)} | {short(least / 1e6)} | {short(least_ms)} | "
               f"{f'{ms / least_ms:.1f}' if least else ''} | {short(two_threads['stage_ms'][stage])} | "
               f"{short(two_threads['serial_ms'][stage])} |")
    yield (f"| frame | {short(frame)} | {1e6 * frame / bodies:.1f} | {1e6 * frame / pairs:.1f} | | | "
           f"{short(total)} | "
           f"{frame / total:.1f} | {short(frame_2)} | "
           f"{short(sum(two_threads['serial_ms'].values()))} |")


def page(arguments):
    ns, context = ns_a_line(arguments.bench)
    yield ""
    yield (f"{context['num_cpus']} processors of {context['mhz_per_cpu'] / 1000:.1f} GHz. One thread reads "
           f"{64 / ns['read/t1']:.1f} GB/s, copies {64 / ns['copy/t1']:.1f} GB/s, and fetches a line "
           f"from a random place every {ns['gather/t1']:.1f} ns. Two threads together read "
           f"{ns['read/t1'] / ns['read/t2']:.2f} times as fast, copy "
           f"{ns['copy/t1'] / ns['copy/t2']:.2f} times, and fetch lines "
           f"{ns['gather/t1'] / ns['gather/t2']:.2f} times "
           "(`carom_bench --benchmark_filter=memory/`).")
    yield ""
    yield "## Scenes"
    for name, detail, kind in SCENES:
        count = int(name.split("n=")[1].split(",")[0])
        if count > arguments.most_bodies:
            continue
        frames = max(4, min(arguments.frames, 20_000_000 // count))
        common = [arguments.run, "run", name, "--frames", str(frames), "--detail", detail]
        one, two = (run(*common, "--threads", threads, "--json") for threads in ("1", "2"))
        yield from scene_rows(name, detail, kind, one, two, ns)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run")
    parser.add_argument("bench")
    parser.add_argument("--frames", type=int, default=60)
    parser.add_argument("--most-bodies", type=int, default=10_000_000)
    tables = "\n".join(page(parser.parse_args()))
    text, heading, _ = PAGE.read_text().partition("## The machine of the tables\n")
    PAGE.write_text(text + heading + tables + "\n")


if __name__ == "__main__":
    main()
