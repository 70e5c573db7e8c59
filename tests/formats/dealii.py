#!/usr/bin/env python3
"""Builds and runs the program in mesher/docs/solvers/dealii.md, and compares what it prints; then
changes the page, to see that a wrong answer would be found.

    dealii.py BIN

BIN is the folder of the tools. For where deal.II is installed: its compilation takes a minute.
"""
import os
import pathlib
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "mesher/docs/site"))
import commands  # noqa: E402

PAGE = ROOT / "mesher/docs/solvers/dealii.md"
ANSWER = "flux 4.000000, worst below 1e-9"


def faults_of(page, folder):
    document = commands.Document(page, ROOT, sys.argv[1], folder)
    list(document.run())
    assert document.count == 2, "the page has two commands"
    return document.faults


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        needed = folder / "deal.II"  # what the page says that its commands need
        needed.touch(0o755)
        os.environ["PATH"] = name + os.pathsep + os.environ["PATH"]
        faults = faults_of(PAGE, folder)
        if faults:
            sys.exit("\n".join(faults))
        text = PAGE.read_text(encoding="utf-8")
        assert text.count(ANSWER) == 1
        wrong = folder / "wrong.md"
        wrong.write_text(text.replace(ANSWER, "flux 5.000000, worst below 1e-9"), encoding="utf-8")
        assert len(faults_of(wrong, folder)) == 1, "a wrong answer is not found"
    print("deal.II: as the page says")


main()
