#!/usr/bin/env python3
"""Runs the commands that documents show, and compares what they print.

    commands.py BIN ROOT DOCUMENT...

BIN is the folder of the tools. Each document has a scratch folder of its own, in which its blocks
```console are run in order: a line that begins with `$ ` is a command (with `\\` at its end, it goes
on), the lines behind it are its output, from both streams. `...` in a line stands for anything, a
line of `...` alone for any lines. Commands in tables, `mesher ...`, are run and must succeed. Files
are there from the start; comments of HTML, which nobody sees, say so:

    <!-- file: lake.poly from tests/data/great_lakes.poly -->      a copy
    <!-- file: room.poly -->                                       the block that follows

    <!-- needs: ccx -->    the block of commands that follows is left out where ccx is not installed
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PART = re.compile(r"<!-- file: (?P<copy>\S+) from (?P<source>\S+) -->"
                  r"|<!-- file: (?P<name>\S+) -->\s*^```\w*\n(?P<text>.*?)^```"
                  r"|(?:<!-- needs: (?P<needs>\S+) -->\s*)?^```console\n(?P<block>.*?)^```"
                  r"|^(?P<row>\|[^\n]*)", re.M | re.S)
IN_ROW = re.compile(r"`((?:mesher|traces) \w+ [^`]+)`")


def commands_of(block):
    """Pairs of a command and what it prints."""
    found = []
    for line in block.splitlines(keepends=True):
        if line.startswith("$ "):
            found.append([line[2:], ""])
        elif found and not found[-1][1] and found[-1][0].endswith("\\\n"):
            found[-1][0] += line
        elif found:
            found[-1][1] += line
        else:
            raise ValueError(f"output without a command: {line!r}")
    return found


def pattern_of(expected):
    parts = []
    for line in expected.splitlines():
        if line == "...":
            parts.append(r"(?:.*\n)*?")
        else:
            parts.append(".*?".join(re.escape(text) for text in line.split("...")) + r"\n")
    return "".join(parts)


class Document:
    """A document, whose commands are run as it is read."""

    def __init__(self, path, root, tools, folder):
        self.path, self.root, self.folder = path, root, folder
        self.environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}",
                            "LC_ALL": "C.UTF-8"}
        self.count, self.faults = 0, []

    def run(self):
        """Yields each block of commands, as a match, once it was run."""
        text = self.path.read_text(encoding="utf-8")
        parts = list(PART.finditer(text))
        for part in parts:
            if part["copy"]:
                shutil.copy(self.root / part["source"], self.folder / part["copy"])
            elif part["name"]:
                named = self.folder / part["name"]
                named.parent.mkdir(parents=True, exist_ok=True)
                named.write_text(part["text"], encoding="utf-8")
        for part in parts:
            if part["row"]:
                for command in IN_ROW.findall(part["row"]):
                    status, printed = self.execute(command)
                    if status != 0:
                        self.faults.append(f"{self.path}: {command}: exit {status}\n{printed}")
            elif part["block"] and (not part["needs"] or shutil.which(part["needs"])):
                line = text.count("\n", 0, part.start()) + 1
                for command, expected in commands_of(part["block"]):
                    _, printed = self.execute(command)
                    if not re.fullmatch(pattern_of(expected), printed):
                        self.faults.append(
                            f"{self.path}:{line}: {command}prints\n{printed}not\n{expected}")
                yield part

    def execute(self, command):
        self.count += 1
        made = subprocess.run(["bash", "-c", command], cwd=self.folder, env=self.environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              stdin=subprocess.DEVNULL, timeout=300, check=False)
        return made.returncode, made.stdout


def main(arguments):
    tools, root = os.path.abspath(arguments[0]), pathlib.Path(arguments[1]).resolve()
    count, faults = 0, []
    for name in arguments[2:]:
        with tempfile.TemporaryDirectory() as folder:
            document = Document(root / name, root, tools, pathlib.Path(folder))
            for _ in document.run():
                pass
        if document.count == 0:
            document.faults.append(f"{name}: no commands")
        count += document.count
        faults += document.faults
    print(*faults, f"{count} commands, {len(faults)} print something else", sep="\n")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
