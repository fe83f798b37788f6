#!/usr/bin/env python3
"""Prints what `carom accuracy --out DIR` measured as the tables of docs/accuracy.md.

  scripts/accuracy_table.py DIR/accuracy.json
"""

import json
import sys


def number(value):
    return "-" if value is None else f"{value:.3g}"


def length(value):
    return "-" if value is None else "0" if value == 0 else f"{value:.1e}"


def row(*cells):
    print("| " + " | ".join(str(cell) for cell in cells) + " |")


def head(*cells):
    row(*cells)
    print("|" + "---|" + "---:|" * (len(cells) - 1))


def times(part, whole):
    return f"{part / whole:.2f}" if part is not None and whole else "-"


def by_pair(rows):
    pairs = {}
    for each in rows:
        pairs.setdefault(each["pair"], {})[each["setting"]] = each
    return pairs


def print_tiers(pairs):
    head("pair", "reference ns", "standard ns", "certified x", "exact x", "undecided",
         "wrong: certified, exact", "worst error of a separation, L", "Bullet ns", "its worst error, L")
    for pair, settings in pairs.items():
        standard, bullet = settings["standard"], settings.get("Bullet", {})
        certified, exact = settings["certified"], settings["exact"]
        wrong = [each["false_overlaps"] + each["missed"] for each in (certified, exact)]
        row(pair, number(settings["scalar reference"]["ns_per_pair"]),
            number(standard["ns_per_pair"]),
            times(certified["ns_per_pair"], standard["ns_per_pair"]),
            times(exact["ns_per_pair"], standard["ns_per_pair"]),
            f"{certified['undecided']} of {certified['judged']}", f"{wrong[0]}, {wrong[1]}",
            length(standard["error_worst"]), number(bullet.get("ns_per_pair")),
            length(bullet.get("error_worst")))


def print_fast(pairs):
    head("pair", "time, of standard", "worst error, L", "99.99 %, L", "false overlaps", "missed",
         "judged")
    for pair, settings in pairs.items():
        each = settings.get("single precision")
        if not each:
            continue
        row(pair, times(each["ns_per_pair"], settings["standard"]["ns_per_pair"]),
            length(each["error_worst"]), length(each["error_p9999"]), each["false_overlaps"],
            each["missed"], each["judged"])


def print_scenes(rows):
    head("pairs", "undecided", "standard ns", "single precision x", "certified x", "exact x")
    for each in rows:
        standard = each["ns_standard"]
        row(each["scene"], f"{100 * each['undecided']:.3g} %", number(standard),
            times(each["ns_single_precision"], standard), times(each["ns_certified"], standard),
            times(each["ns_exact"], standard))


def print_reuse(rows):
    head("scene", "tolerance, m", "frame, of standard", "bound, m", "worst error, m", "lost",
         "gained", "pairs")
    for each in rows:
        row(f"`{each['scene']}`", number(each["tolerance"]),
            times(each["frame_ms"], each["frame_ms_standard"]), number(each["error_bound"]),
            number(each["error_worst"]), each["lost"], each["gained"], each["pairs"])


def print_fidelity(rows):
    head("scene", "frame, of standard", "lost", "gained", "pairs", "worst contact error, m",
         "99 %, m", "events moved")
    for each in rows:
        row(f"`{each['scene']}`", times(each["frame_ms"], each["frame_ms_standard"]), each["lost"], each["gained"],
            each["pairs"], length(each["contact_error_worst"]), length(each["contact_error_p99"]),
            each["events_moved"])


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        document = json.load(file)
    print(f"{document['cpu']}; {document['compiler']}, `{document['flags']}`; carom "
          f"{document['version']}, commit {document['commit']}; {document['isa']}; "
          f"{document['mode']} mode.\n")
    pairs = by_pair(document["tradeoff"])
    print_tiers(pairs)
    print("\n### Scenes\n")
    print_scenes(document["undecided"])
    print("\n### The fast tier, pair by pair\n")
    print_fast(pairs)
    print("\n### The fast tier in whole scenes\n")
    print_fidelity(document["fidelity"])
    print("\n### Tolerance\n")
    print_reuse(document["reuse"])


if __name__ == "__main__":
    main()
