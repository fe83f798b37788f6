#!/usr/bin/env python3
"""Runs clang-tidy on a file of a build, unless the same input has passed before.

  tidy.py BUILD_DIR FILE [OPTION of clang-tidy]...

The input is the text and the names of the file and of all that it includes, the command that
compiles it, the checks and the version of clang-tidy, whatever folder the project is in. What passed
is remembered in ${XDG_CACHE_HOME:-~/.cache}/carom/tidy, an empty file each.
"""
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

ROOT = str(pathlib.Path(__file__).resolve().parent.parent)


def compile_command(build, file):
    """The arguments of the compiler and the folder it runs in; without the precompiled header, which
    holds text that is included as well."""
    for entry in json.loads((build / "compile_commands.json").read_text()):
        if entry["file"] == file:
            break
    else:
        sys.exit(f"tidy.py: {file} is not part of {build}")
    arguments = shlex.split(entry["command"])
    if "-include-pch" in arguments:
        at = arguments.index("-include-pch")
        del arguments[at - 1:at + 3]
    return arguments, entry["directory"]


def included_files(arguments, folder):
    """All files that the compiler reads."""
    output = arguments.index("-o")
    command = [*arguments[:output], *arguments[output + 2:], "-M"]
    rule = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout
    names = re.split(r"(?<!\\)\s+", rule.partition(": ")[2].replace("\\\n", " ").strip())
    return [os.path.join(folder, name.replace("\\ ", " ")) for name in names]


def input_digest(build, file, options):
    digest = hashlib.sha256()

    def add(text):
        digest.update(text.replace(ROOT.encode(), b"") + b"\0")

    arguments, folder = compile_command(build, file)
    add(" ".join([*arguments, *options]).encode())
    add(subprocess.run(["clang-tidy", "--version"], check=True, capture_output=True).stdout)
    add(subprocess.run(["clang-tidy", "--dump-config", file], check=True, capture_output=True).stdout)
    for name in included_files(arguments, folder):
        add(name.encode())
        add(pathlib.Path(name).read_bytes())
    return digest.hexdigest()


def main():
    build, file, options = pathlib.Path(sys.argv[1]).resolve(), os.path.abspath(sys.argv[2]), sys.argv[3:]
    cache = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or "~/.cache").expanduser() / "carom" / "tidy"
    digest = input_digest(build, file, options)
    passed = cache / digest
    if passed.exists():
        return
    if subprocess.run(["clang-tidy", "--quiet", "-p", str(build), *options, file]).returncode != 0:
        sys.exit(1)
    if input_digest(build, file, options) != digest:
        return  # somebody has changed a file in the meantime
    cache.mkdir(parents=True, exist_ok=True)
    passed.touch()


if __name__ == "__main__":
    main()
