#!/usr/bin/env python3
"""preprocess.py COMPILE_COMMANDS FILE: prints the file's command and what it compiles, comments
included. Fails if the file has no command."""
import json
import pathlib
import shlex
import subprocess
import sys

path = pathlib.Path(sys.argv[2]).resolve()
entry = next(e for e in json.loads(pathlib.Path(sys.argv[1]).read_text())
             if pathlib.Path(e["file"]) == path)
command = shlex.split(entry["command"])
if "ccache" in command[0]:
    command = command[1:]
output = command.index("-o")
del command[output:output + 2]
command.remove("-c")
print(command, flush=True)
sys.exit(subprocess.run([*command, "-E", "-C"], cwd=entry["directory"]).returncode)
