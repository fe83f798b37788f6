#!/usr/bin/env python3
"""Turns the JSON of carom_bench into Markdown tables.

  bench_table.py [JSON] [--all]    the newest file of build/bench by default

A table a group: a row a case, a column an instruction set or number of threads. Narrow phase and
bounds in nanoseconds, and how many times faster than the scalar reference; the others in
milliseconds a frame. Without --all: of the narrow phase the streams with half the pairs
overlapping.
"""

import argparse
import collections
import json
import pathlib
import sys

STREAM_RATES = ("hit10", "hit90")


def newest():
    files = sorted((pathlib.Path(__file__).parents[1] / "build/bench").glob("*.json"))
    if not files:
        sys.exit("bench_table: no JSON in build/bench: run make bench first")
    return files[-1]


def per_item(result):
    """Nanoseconds a pair, a body, a line of memory: whatever the case counts."""
    return next(result[key] for key in result if key.startswith("ns_per_"))


def split(name):
    """Group, case and column of a benchmark's name."""
    parts = name.split("/")
    columns = 2 if parts[-2] in ("t1", "t2") else 1
    return parts[0], " ".join(parts[1:-columns]), " ".join(parts[-columns:])


def cell(group, result):
    value = per_item(result)
    if group in ("find_pairs", "world"):
        return f"{result['ms']:.3g}"
    speedup = result.get("speedup")
    if speedup is None or result["name"].endswith("/reference"):
        return f"{value:.3g}"
    return f"{value:.3g} ({speedup:.3g}x)"


def bodies(case):
    """The number of bodies in the name of a scene: brownian_10k."""
    text = case.split()[0].rsplit("_", 1)[-1]
    units = {"k": 1_000, "M": 1_000_000}
    return int(text[:-1]) * units[text[-1]] if text[-1] in units else int(text)


def table(group, cases):
    columns = list(dict.fromkeys(column for row in cases.values() for column in row))
    unit = "ms a frame" if group in ("find_pairs", "world") else "ns each"
    yield f"### {group} ({unit})\n"
    yield "| case | " + " | ".join(columns) + " |"
    yield "|---|" + "---:|" * len(columns)
    for case, row in cases.items():
        cells = [cell(group, row[column]) if column in row else "" for column in columns]
        yield f"| {case} | " + " | ".join(cells) + " |"
    yield ""


def context_lines(context):
    yield f"{context['cpu']}, {context['num_cpus']} processors; {context['compiler']}, " \
          f"`{context['flags']}`; carom {context['carom_version']}, commit {context['commit']}; " \
          f"{context['date']}. Medians of the passes.\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("json", nargs="?", type=pathlib.Path, help="default: newest of build/bench")
    parser.add_argument("--all", action="store_true", help="all hit rates")
    arguments = parser.parse_args()
    report = json.loads((arguments.json or newest()).read_text())

    groups = collections.defaultdict(lambda: collections.defaultdict(dict))
    for result in report["benchmarks"]:
        if result.get("error_occurred") or result.get("run_type") == "aggregate":
            continue
        group, case, column = split(result["name"])
        if not arguments.all and any(rate in case.split() for rate in STREAM_RATES):
            continue
        if group in ("find_pairs", "world"):
            result["ms"] = per_item(result) * bodies(case) * 1e-6
        groups[group][case][column] = result
    for line in context_lines(report["context"]):
        print(line)
    for group, cases in groups.items():
        print("\n".join(table(group, cases)))


if __name__ == "__main__":
    main()
