#!/usr/bin/env python3
"""How models of surfaces as they come are meshed, beside TetGen: one JSON line a model.

    models.py MESHER MODEL... [--algorithms auto,svr,refine,gap-balls] [--seconds S]

MODEL is an .obj, .off, .stl or .ply, closed or not, that may cut itself: `mesher mesh --surface
--repair` meshes it, by `auto` if no algorithms are given, and `mesher check --repair --ties --rho 2`
judges the mesh. TetGen (1.5, if installed: `tetgen -pq2.0/0`) reads .off, .ply, .stl alone, and is
left out for others. Each may take S seconds (150). Seconds are those of the processor, with reading
and writing, and for ours with the repair.

    vertices, tetrahedra      of the part that is kept
    check                     0: accepted; else what is wrong
    code, error               where there is no mesh: what the program ends with ("timeout": nothing)
    tetgen_*                  the same of TetGen
"""
import argparse
import json
import os
import pathlib
import resource
import shutil
import subprocess
import tempfile


def run(command, seconds, folder):
    """The exit code ("timeout": none), seconds of the processor, and what it says last."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        made = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=seconds,
                              errors="replace", check=False)
        code, said = made.returncode, (made.stderr or made.stdout).strip().splitlines()[-1:]
    except subprocess.TimeoutExpired:
        code, said = "timeout", []
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return code, round(used, 3), "".join(said)


def count(path):
    """The first number of a .node or .ele file."""
    with open(path, encoding="ascii") as lines:
        return int(next(line for line in lines if not line.startswith("#")).split()[0])


def ours(mesher, model, algorithm, seconds, folder):
    mesh = [mesher, "mesh", model, "--surface", "--repair", "--algorithm", algorithm, "--quiet",
            "-o", "a.node"]
    code, used, said = run(mesh, seconds, folder)
    if code != 0:
        return {"code": code, "s": used, "error": said}
    check = [mesher, "check", "a.node", "--input", model, "--surface", "--repair", "--ties",
             "--rho", "2"]
    accepted, _, fault = run(check, 10 * seconds, folder)
    return {"s": used, "vertices": count(folder / "a.node"), "tetrahedra": count(folder / "a.ele"),
            "check": 0 if accepted == 0 else fault or accepted}


def tetgens(model, seconds, folder):
    if model.suffix.lower() not in (".off", ".ply", ".stl") or not shutil.which("tetgen"):
        return {}
    name = "t" + model.suffix.lower()
    shutil.copy(model, folder / name)
    code, used, said = run(["tetgen", "-pq2.0/0", name], seconds, folder)
    if code != 0 or not (folder / "t.1.node").exists():
        return {"tetgen_s": used, "tetgen_code": code, "tetgen_error": said}
    return {"tetgen_s": used, "tetgen_vertices": count(folder / "t.1.node")}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesher", type=pathlib.Path)
    parser.add_argument("models", type=pathlib.Path, nargs="+")
    parser.add_argument("--algorithms", default="auto")
    parser.add_argument("--seconds", type=float, default=150)
    args = parser.parse_args()
    mesher = os.path.abspath(args.mesher)
    for model in args.models:
        model = model.resolve()
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            beside = tetgens(model, args.seconds, folder)
            for algorithm in args.algorithms.split(","):
                figure = ours(mesher, model, algorithm, args.seconds, folder)
                print(json.dumps({"bench": "models", "model": model.name, "algorithm": algorithm,
                                  **figure, **beside}), flush=True)


if __name__ == "__main__":
    main()
