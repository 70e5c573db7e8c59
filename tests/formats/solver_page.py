#!/usr/bin/env python3
"""Runs what the page of a solver shows, mesher/docs/solvers/NAME.md, and compares what is printed;
then changes the page, to see that a wrong answer would be found.

    solver_page.py NAME BIN

BIN is the folder of the tools. For where the solver is installed: dealii, dolfinx, freefem, openfoam.
"""
import os
import pathlib
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "mesher/docs/site"))
import commands  # noqa: E402

# By page: how many commands it has, what it says that they need if that is not a program, and a line
# that they print with a wrong answer for it.
PAGES = {
    "dealii": (2, "deal.II", "flux 4.000000, worst below 1e-9", "flux 5.000000, worst below 1e-9"),
    "dolfinx": (6, "dolfinx", "cube.msh: flux 1.000000, ", "cube.msh: flux 1.000001, "),
    "freefem": (6, None, "flux 4, worst below 1e-9", "flux 4, worst too large"),
    "openfoam": (4, None, "\nT is x in all cells", "\nT is off in all cells")}


def faults_of(page, folder, count):
    folder.mkdir()
    document = commands.Document(page, ROOT, sys.argv[2], folder)
    list(document.run())
    assert document.count == count, f"the page has {document.count} commands, not {count}"
    return document.faults


def main():
    name = sys.argv[1]
    count, needed, answer, wrong_answer = PAGES[name]
    page = ROOT / "mesher/docs/solvers" / f"{name}.md"
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(made)
        programs = folder / "programs"
        programs.mkdir()
        (programs / "python3").symlink_to(sys.executable)
        if needed:
            (programs / needed).touch(0o755)
        os.environ["PATH"] = str(programs) + os.pathsep + os.environ["PATH"]
        os.environ["XDG_CACHE_HOME"] = str(folder / "cache")  # dolfinx keeps what it compiles
        faults = faults_of(page, folder / "right", count)
        if faults:
            sys.exit("\n".join(faults))
        text = page.read_text(encoding="utf-8")
        assert text.count(answer) == 1
        wrong = folder / "wrong.md"
        wrong.write_text(text.replace(answer, wrong_answer), encoding="utf-8")
        faults = faults_of(wrong, folder / "wrong", count)
        assert len(faults) == 1, "a wrong answer is not found"
    print(f"{name}: as the page says")


main()
