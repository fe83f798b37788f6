#!/usr/bin/env python3
"""Sets the time of each kernel of the narrow phase beside the least that it could take: a line a
kernel, with its instructions and bytes a pair.

  roofline.py CAROM_BENCH            prints the tables
  roofline.py CAROM_BENCH --write    writes them into docs/roofline.md, below the text
  roofline.py CAROM_BENCH --smoke    two kernels: does it still work?

CAROM_BENCH, of a release build, measures times, the clock and the memory: nothing else should run.
The quicker of two rounds counts. Valgrind counts the instructions of collide_rows() at each address,
on few pairs and with AVX2, since it knows no AVX-512; objdump says what stands there. docs/roofline.md
says how to read the tables. All that takes about four minutes.
"""

import argparse
import collections
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

from instruction_counts import build_no_clock

PAGE = pathlib.Path(__file__).parents[1] / "docs/roofline.md"
HEADING = "## The machine of the tables\n"
DETAILS = ("overlap", "contact")
ISAS = ("avx2", "avx512")
STREAM = "f32/hit50/rows"
SMOKE = ("sphere_sphere", "box_box")
LINE = 64  # bytes

# Pairs to count on. carom_bench draws a quarter as many with one hull, and a 32nd with k-DOPs.
COUNTED = 2048
COUNTED_OF = {"dop": 8 * COUNTED, "hull_hull": COUNTED, "hull": 4 * COUNTED}

# What instructions do, by their names without the v of AVX; what else names a register of vectors
# moves numbers.
ARITHMETIC = re.compile(
    r"(add|sub|mul|div|sqrt|min|max|round|rcp|rsqrt|andn?|x?or|hadd|hsub|blendv?|test|cmp\w*)p[sd]$"
    r"|cvt\w*(ps|pd|dq)"
    r"|p(add|sub|mul|madd|min|max|abs|sign|cmp|andn?|x?or|test|s[lr][la]|blend|avg|sad)")
SCALAR = re.compile(r"(add|sub|mul|div|sqrt|min|max|round|u?comi|cmp\w*)s[sd]$|cvt\w*s[sdi]")
VECTOR = re.compile(r"%[xy]mm")
CLEARED = re.compile(r"\S*xor\S* (%[xy]mm\d+),\1(,|$)")  # x ^ x
STACK = re.compile(r"\(%r[sb]p\)")


def kind_of(instruction):
    """One of the columns of the table, given what objdump prints."""
    name = instruction.split(None, 1)[0].removeprefix("v")
    if not VECTOR.search(instruction):
        return "rest"
    if SCALAR.match(name):
        return "scalar"
    if ARITHMETIC.match(name) and not CLEARED.match(instruction):
        return "arithmetic"
    return "spills" if STACK.search(instruction) else "moves"


def run(command, **options):
    done = subprocess.run(command, capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"roofline: {' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done


def kernels(bench):
    """The names of pairs of simple shapes, in the order of the list of pairs."""
    names = run([bench, "--benchmark_list_tests"]).stdout.splitlines()
    ending = f"/{DETAILS[0]}/{STREAM}/avx2"
    return [name.removesuffix(ending) for name in names
            if name.endswith(ending) and "_mesh/" not in name]


def measure(bench, names, seconds):
    """Context, and the results of carom_bench by name."""
    filters = "|".join(names)
    filters = (f"^(clock/add|cache/copy|memory/read|memory/copy)/t1$|"
               f"^({filters})/({'|'.join(DETAILS)})/{STREAM}/({'|'.join(ISAS)})$")
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        run([bench, f"--benchmark_filter={filters}", f"--benchmark_min_time={seconds}",
             f"--benchmark_out={out.name}", "--benchmark_out_format=json"])
        report = json.load(open(out.name))
    return report["context"], {result["name"]: result for result in report["benchmarks"]}


def quicker(first, second):
    """The results of two rounds, by name: those that something else did not disturb."""
    def time_of(result):
        return next(result[key] for key in result if key.startswith("ns_per_"))
    return {name: min(first[name], second[name], key=time_of) for name in first}


def read_profile(path):
    """Executions by (object file, address), and the calls of collide_rows()."""
    executions, calls, file, callee, is_call = collections.Counter(), 0, "", "", False
    for line in path.read_text().splitlines():
        if is_call:  # what the callee took: it stands there, too
            is_call = False
        elif line.startswith("0x"):
            address, _, count = line.split()
            executions[file, int(address, 16)] += int(count)
        elif line.startswith("ob="):
            file = line[3:]
        elif line.startswith("cfn="):
            callee = line[4:]
        elif line.startswith("calls="):
            is_call = True
            if callee.startswith("carom::collide_rows("):
                calls += int(line[6:].split()[0])
    return executions, calls


def count(bench, name, detail, folder, no_clock):
    """Executions a pair, by (object file, address)."""
    pairs = next((COUNTED_OF[kind] for kind in COUNTED_OF if kind in name), COUNTED)
    path = pathlib.Path(folder, f"{name}.{detail}")
    report = path.with_suffix(path.suffix + ".json")
    run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={path}", "--dump-instr=yes",
         "--compress-pos=no", "--compress-strings=no", "--toggle-collect=carom::collide_rows(*",
         bench, f"--pairs={pairs}", f"--benchmark_filter=^{name}/{detail}/{STREAM}/avx2$",
         "--benchmark_min_time=0.001", f"--benchmark_out={report}", "--benchmark_out_format=json"],
        env={"LD_PRELOAD": str(no_clock), "PATH": "/usr/bin:/bin"})
    executions, calls = read_profile(path)
    if not calls:
        sys.exit(f"roofline: no call of collide_rows() in {name}, {detail}")
    per_pass = json.loads(report.read_text())["benchmarks"][0]["pairs"]
    return {place: number / calls / per_pass for place, number in executions.items()}


def kinds_at(places):
    """What stands at each place."""
    addresses = collections.defaultdict(set)
    for file, address in places:
        addresses[file].add(address)
    kinds = {}
    for file, wanted in addresses.items():
        if not os.path.exists(file):
            continue  # code of the kernel
        for line in run(["objdump", "-d", "--no-show-raw-insn", file]).stdout.splitlines():
            address, colon, instruction = line.partition(":\t")
            if colon and (place := int(address, 16)) in wanted:
                kinds[file, place] = kind_of(instruction)
    return kinds


def count_all(bench, names):
    """By (name, detail) the instructions a pair of each kind."""
    cases = [(name, detail) for name in names for detail in DETAILS]
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        no_clock = build_no_clock(folder)
        found = list(pool.map(lambda case: count(bench, *case, folder, no_clock), cases))
    kinds = kinds_at({place for executions in found for place in executions})
    counts = {}
    for case, executions in zip(cases, found):
        counts[case] = collections.Counter()
        for place, number in executions.items():
            counts[case][kinds.get(place, "rest")] += number
    return counts


class Machine:
    """What the machine can do at best."""

    def __init__(self, results, issue):
        self.issue = issue
        self.ns_per_cycle = results["clock/add/t1"]["ns_per_cycle"]
        self.cache = 2 * LINE / results["cache/copy/t1"]["ns_per_line"]  # bytes a nanosecond
        self.memory = max(LINE / results["memory/read/t1"]["ns_per_line"],
                          2 * LINE / results["memory/copy/t1"]["ns_per_line"])

    def text(self):
        return (f"{1 / self.ns_per_cycle:.2f} GHz while it runs; {self.issue:g} vector instructions of 256 bits "
                f"a cycle at most; {self.cache:.0f} GB/s within the caches, {self.memory:.1f} GB/s from memory.")


def number(value):
    if value < 0.01:
        return "0"
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def row(cells):
    return "| " + " | ".join(cells) + " |"


def kernel_row(name, detail, counts, results, machine, isas):
    timed = [results[f"{name}/{detail}/{STREAM}/{isa}"] for isa in isas]
    times = [result["ns_per_pair"] for result in timed]
    size = timed[0]["bytes_per_pair"]
    arithmetic = counts["arithmetic"] / machine.issue * machine.ns_per_cycle
    cache, memory = size / machine.cache, size / machine.memory
    least = max(arithmetic, cache)
    bounds = [f"**{number(value)}**" if value == least else number(value)
              for value in (arithmetic, cache)]
    instructions = [number(counts[kind])
                    for kind in ("arithmetic", "moves", "spills", "scalar", "rest")]
    return row([name, *map(number, times), number(sum(counts.values())), *instructions,
                number(size), *bounds, number(memory)] + [f"{time / least:.1f}" for time in times])


def table(detail, names, counts, results, machine, isas):
    yield f"\n### {detail.capitalize()}\n"
    yield row(["pair"] + [f"{isa} ns" for isa in isas]
              + ["instructions", "arithmetic", "moves", "spills", "scalar", "rest", "bytes",
                 "least ns, arithmetic", "least ns, caches", "ns from memory"]
              + [f"{isa} : least" for isa in isas])
    yield "|---|" + "---:|" * (10 + 2 * len(isas))
    for name in names:
        yield kernel_row(name, detail, counts[name, detail], results, machine, isas)


def shares(detail, names, counts):
    """Of the instructions of all kernels, those of lanes and those one pair at a time."""
    for title, of_hulls in (("without hulls and k-DOPs", False), ("with hulls or k-DOPs", True)):
        mixes = [counts[name, detail] for name in names
                 if any(kind in name for kind in COUNTED_OF) == of_hulls]
        if mixes:
            parts = ", ".join(
                f"{kind} {100 * sum(mix[kind] / sum(mix.values()) for mix in mixes) / len(mixes):.0f} %"
                for kind in ("arithmetic", "moves", "spills", "scalar", "rest"))
            yield f"\nOf the instructions of a kernel {title}, on average: {parts}."


def tables(arguments):
    names = [name for name in kernels(arguments.bench) if not arguments.smoke or name in SMOKE]
    seconds = 0.01 if arguments.smoke else 0.1
    context, before = measure(arguments.bench, names, seconds)
    counts = count_all(arguments.bench, names)
    _, after = measure(arguments.bench, names, seconds)
    results = quicker(before, after)
    isas = [isa for isa in ISAS if isa in context["isas"].split()]
    machine = Machine(results, arguments.issue)
    yield ""
    yield (f"{context['cpu']}, {context['num_cpus']} processors; {context['compiler']}, "
           f"`{context['flags']}`; carom {context['carom_version']}, commit {context['commit']}; "
           f"{context['date']}.\n")
    yield machine.text()
    for detail in DETAILS:
        yield from table(detail, names, counts, results, machine, isas)
        yield from shares(detail, names, counts)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("bench", help="carom_bench of a release build")
    parser.add_argument("--write", action="store_true", help="write the tables of docs/roofline.md")
    parser.add_argument("--smoke", action="store_true", help="two kernels, short times")
    parser.add_argument("--issue", type=float, default=4,
                        help="vector instructions of 256 bits a cycle (default: 4, Zen 4; Intel: 3)")
    arguments = parser.parse_args()
    text = "\n".join(tables(arguments)) + "\n"
    if arguments.write:
        before, heading, _ = PAGE.read_text().partition(HEADING)
        PAGE.write_text(before + heading + text)
    else:
        print(text, end="")


if __name__ == "__main__":
    main()
