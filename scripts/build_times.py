#!/usr/bin/env python3
"""Prints where a build spent its time, from the log that Ninja keeps.

  build_times.py BUILD_DIR [--files N] [--most SECONDS]

The seconds are wall time of each compiler, with as many of them side by side as Ninja ran; files
that a compiler cache had are there as well. --most: fails if a file took longer than this.
"""
import argparse
import pathlib
import sys


def read_log(path):
    """The last entry of every object file and precompiled header: name -> seconds."""
    seconds = {}
    for line in path.read_text().splitlines():
        fields = line.split("\t")
        if len(fields) != 5 or not fields[3].endswith((".o", ".gch", ".pch")):
            continue
        seconds[fields[3]] = (int(fields[1]) - int(fields[0])) / 1000
    return seconds


def source_of(output):
    """tests/CMakeFiles/io_test.dir/io/npz_test.cc.o -> tests/io/npz_test.cc; a group of files that
    are compiled together: tests/... .dir/Unity/unity_tests_io_0_cxx.cxx.o -> tests_io_0 (group)"""
    folder, _, rest = output.partition("CMakeFiles/")
    source = rest.partition(".dir/")[2].removesuffix(".o")
    group = source.removeprefix("Unity/unity_").removesuffix("_cxx.cxx")
    return folder + (source if group == source else group + " (group)")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--files", type=int, default=12)
    parser.add_argument("--most", type=float)
    arguments = parser.parse_args()

    log = arguments.build / ".ninja_log"
    if not log.exists():
        sys.exit(f"build_times: {log} does not exist: nothing was built there")
    times = {source_of(name): spent for name, spent in read_log(log).items()}
    folders = {}
    for source, spent in times.items():
        count, total = folders.get(source.split("/")[0], (0, 0.0))
        folders[source.split("/")[0]] = (count + 1, total + spent)

    slowest = sorted(times.items(), key=lambda item: -item[1])
    for source, spent in slowest[: arguments.files]:
        print(f"{spent:7.1f} s  {source}")
    print()
    for folder, (count, total) in sorted(folders.items(), key=lambda item: -item[1][1]):
        print(f"{total:7.1f} s  {folder}, {count} files")
    print(f"{sum(times.values()):7.1f} s  in all, {len(times)} files")

    if arguments.most and slowest and slowest[0][1] > arguments.most:
        sys.exit(f"build_times: {slowest[0][0]} took longer than {arguments.most:g} s")


main()
