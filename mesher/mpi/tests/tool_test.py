#!/usr/bin/env python3
"""The tool mesher-mpi: its files have the bytes of one process, errors are said once, and no wrong
file is left, whatever happens to a rank.

    tool_test.py MESHER_MPI MESHER FOLDER MPIRUN...
"""
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import time

tool, mesher, folder = sys.argv[1:4]
mpirun = sys.argv[4:]
folder = pathlib.Path(folder) / "tool_test"


def run_ranks(ranks, *arguments):
    command = [*mpirun, "-n", str(ranks), tool, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=300)


def make_input(name, *arguments):
    path = folder / name
    subprocess.run([mesher, "gen", *map(str, arguments), "-o", path], check=True,
                   capture_output=True)
    return path


def meshed_alone(source, target, script=None):
    command = ["edit", source, "--script", script] if script else ["mesh", source]
    if not script:
        command += ["--algorithm", "gap-balls"]
    subprocess.run([mesher, *command, "-o", target, "--quiet"], check=True)
    return target.read_bytes()


def cells_of(text):
    """Triangles or tetrahedra, without the edges and faces of features."""
    types = re.search(r'Name="types"[^>]*>([^<]*)<', text).group(1).split()
    return types.count("10") or types.count("5")


def check_bytes():
    for name, arguments in {
        "plane.node": ["uniform", "--n", 800, "--seed", 3],
        "space.node": ["uniform", "--n", 120, "--seed", 3, "--dim", 3],
    }.items():
        source = make_input(name, *arguments)
        script = folder / "edits.txt"
        z = " 0.25" if "space" in name else ""
        script.write_text(f"+point 100000 0.5 0.5{z} marker 3\n"
                          f"begin\nmove 5 0.25 0.75{z}\n-point 7\ncommit\n")
        for edits in (None, script):
            expected = meshed_alone(source, folder / "alone.vtu", edits)
            for ranks in (1, 3):
                index = folder / f"parts_{ranks}.pvtu"
                more = ["--script", edits] if edits else []
                made = run_ranks(ranks, source, "-o", index, "-o", folder / "merged.vtu", *more)
                assert made.returncode == 0, made.stderr
                assert (folder / "merged.vtu").read_bytes() == expected, name
                pieces = re.findall(r'Source="([^"]+)"', index.read_text())
                assert len(pieces) == ranks
                cells = sum(cells_of((folder / piece).read_text()) for piece in pieces)
                assert cells == cells_of(expected.decode()), (name, ranks, edits)


def check_limits():
    """Limits of size, as options and as edits; backgrounds are told to all ranks."""
    for name, arguments, limit, volume in (
        ("plane.node", ["uniform", "--n", 300, "--seed", 3], "--max-area", "area"),
        ("space.node", ["uniform", "--n", 40, "--seed", 3, "--dim", 3], "--max-volume", "volume"),
    ):
        source = make_input(name, *arguments)
        in_space = name == "space.node"
        sizes = folder / "sizes.csv"
        z = ",z" if in_space else ""
        corners = ["0,0,0.4", "1,0,0.3", "0,1,0.2", "1,1,0.25"]
        if in_space:
            corners = [f"{x},{y},{w},{.4 - .1 * x}" for x in (0, 1) for y in (0, 1)
                       for w in (0, 1)]
        sizes.write_text(f"x,y{z},h\n" + "\n".join(corners) + "\n")
        box = "0.1 0.1 0.1 0.6 0.7 0.8" if in_space else "0.1 0.1 0.6 0.7"
        script = folder / "limits.txt"
        script.write_text(f"limit {volume} {0.004 if in_space else 0.0005} in {box}\n"
                          f"begin\n-point 7\nlimit sizes sizes.csv\ncommit\n"
                          f"limit size 0.3 in {box}\n")
        for more in ([limit, 0.01], ["--max-size", 0.2], ["--sizes", sizes],
                     [limit, 0.02, "--script", script]):
            command = ["edit" if "--script" in more else "mesh", source, *more]
            if "--script" not in more:
                command += ["--algorithm", "gap-balls"]
            expected = folder / "alone.node"
            subprocess.run([mesher, *map(str, command), "-o", expected, "--quiet"], check=True)
            made = run_ranks(3, source, *more, "-o", folder / "ranks.node")
            assert made.returncode == 0, made.stderr
            for end in (".node", ".ele"):
                assert (folder / f"ranks{end}").read_bytes() == \
                    expected.with_suffix(end).read_bytes(), (name, more, end)


def check_features():
    """Lines, polygons, surfaces and slivers, and edits of them: what the input encloses."""
    lines = make_input("lines.poly", "trees", "--n", 60, "--seed", 4)
    plates = make_input("plates.poly", "plates", "--size", 0.1)
    cube = folder / "cube.off"
    cube.write_text("OFF\n8 6 0\n" + "\n".join(f"{x} {y} {z}" for x in (0, 1) for y in (0, 1)
                                              for z in (0, 1)) +
                    "\n4 0 1 3 2\n4 4 6 7 5\n4 0 4 5 1\n4 2 3 7 6\n4 0 2 6 4\n4 1 5 7 3\n")
    script = folder / "line_edits.txt"
    script.write_text("begin\n+point 9001 0.31 0.33\n+point 9002 0.34 0.36\n"
                      "+segment 9003 9001 9002 marker 7\ncommit\n-segment 9003\n"
                      "+segment 9004 9001 9002\n")
    solid_script = folder / "solid_edits.txt"
    solid_script.write_text("begin\n+point 9001 0.3 0.3 0.2\n+point 9002 0.4 0.6 0.3\n"
                            "+segment 9003 9001 9002 marker 7\ncommit\nmove 9001 0.2 0.3 0.25\n")
    for source, more, edits in ((lines, [], script), (lines, ["--max-area", 0.01], None),
                                (plates, ["--min-dihedral", 8], None), (plates, [], solid_script),
                                (cube, ["--surface", "--max-volume", 0.01], solid_script)):
        command = ["edit", source, "--script", edits or os.devnull, *more]
        alone = folder / "alone.vtu"
        subprocess.run([mesher, *map(str, command), "-o", alone, "--quiet"], check=True)
        for ranks in (1, 3):
            script_of_ranks = ["--script", edits] if edits else []
            made = run_ranks(ranks, source, *more, *script_of_ranks, "-o", folder / "ranks.vtu")
            assert made.returncode == 0, made.stderr
            assert (folder / "ranks.vtu").read_bytes() == alone.read_bytes(), (source, more, ranks)


def check_shares():
    """Points that ranks read in shares: markers, formats without ids, and the words of errors."""
    lines = ["# points", "", "12 2 0 1"]
    lines += [f"{40 - i} {i % 4}.5 {i // 4}.25 {i % 3}" for i in range(12)]
    marked = "\r\n".join(lines)
    places = [f"{i % 4}.5 {i // 4}.25" for i in range(12)]
    solid = [f"{i % 2} {i // 2 % 2} {i // 4 + .5 * (i % 2)}" for i in range(12)]
    row = "38 2.5 0.25 2"
    assert row in marked
    edits = folder / "share_edits.txt"
    edits.write_text("begin\n-point 40\nmove 39 0.75 0.125\ncommit\n"
                     "+point 40 1.75 1.125 marker 5\n")
    for name, text, more in (
        ("a.node", marked, ["--script", edits]),
        ("a.xyz", "\n".join(places), []),
        ("a.csv", "x,y\n" + "\n".join(places).replace(" ", ","), []),
        ("b.csv", "\n".join(places).replace(" ", ";") + "\n", []),
        ("b.xyz", "\n".join(solid), []),
        ("c.csv", "name,Z,x,y\n" + "\n".join("p " + p for p in solid).replace(" ", ","), []),
        ("more.node", marked + "\n1 0 0 0\n", []),
        ("less.node", marked[:marked.rindex("\n")] + "\n# more\n\n", []),
        ("cut.node", marked[:-2], []),
        ("fields.node", marked.replace(row, row + " 7"), []),
        ("number.node", marked.replace(row, "38 2.5 0.2x5 2"), []),
        ("repeated.node", marked.replace(row, "40 2.5 0.25 2"), []),
        ("duplicate.node", marked.replace(row, "38 0.5 0.25 2"), []),
        ("close.node", marked.replace(row, "38 0.50000000000001 0.25 2"), []),
        ("duplicate.xyz", "\n".join([*places, places[3]]), []),
        ("empty.node", "", []),
        ("zero.node", "0 2 0 0\n", []),
    ):
        source = folder / name
        source.write_text(text)
        command = ["edit", source, "--script", edits] if more else \
            ["mesh", source, "--algorithm", "gap-balls"]
        expected, output = folder / "alone.vtu", folder / "ranks.vtu"
        for path in (expected, output):
            path.unlink(missing_ok=True)
        alone = subprocess.run([mesher, *map(str, command), "-o", expected, "--quiet"],
                               capture_output=True, text=True)
        for ranks in (1, 3, 5):
            made = run_ranks(ranks, source, *more, "-o", output)
            assert made.returncode == alone.returncode, (name, ranks, made.stderr)
            if alone.returncode == 0:
                assert output.read_bytes() == expected.read_bytes(), (name, ranks)
                continue
            said, words = ([line.split("; --repair")[0] for line in run.stderr.splitlines()
                            if "error[" in line] for run in (made, alone))
            assert said == words and len(said) == 1, (name, ranks, said, words)
            assert not output.exists()
            print(said[0].replace(str(folder) + "/", ""))


def check_errors():
    source = make_input("plane.node", "uniform", "--n", 300)
    crossing = folder / "crossing.poly"
    crossing.write_text("4 2 0 0\n1 0 0\n2 1 1\n3 0 1\n4 1 0\n2 0\n1 1 2\n2 3 4\n0\n")
    far = folder / "far.txt"
    far.write_text("+point 9999 0.5 0.5\n+point 10000 1e6 0\n")
    for arguments, code, text in (
        ([folder / "none.node", "-o", folder / "no.vtu"], 2, "cannot_read"),
        ([source, "-o", folder / "no.pvtu", "--script", far], 1, "far.txt:2:1: error"),
        ([source, "-o", folder / "no.pvtu", "--max-vertices", 5], 4, "too_many"),
        ([source, "-o", folder / "no.pvtu", "--rho", 0.5], 2, "bad_option"),
        ([source, "-o", folder / "no.node", "--max-area", -1], 2, "bad_option"),
        ([source, "-o", folder / "no.node", "--max-area", "nan"], 2, "bad_option"),
        ([source, "-o", folder / "no.node", "--max-volume", 1], 2, "bad_option"),
        ([source, "-o", folder / "no.node", "--max-area", 1e-30], 2, "bad_option"),
        ([source, "-o", folder / "no.node", "--sizes", folder / "none.csv"], 2, "cannot_read"),
        ([source, "-o", folder / "none" / "no.msh", "--pieces"], 2, "cannot_write"),
        ([source, "-o", folder / "none" / "no.pvtu"], 2, "cannot_write"),
        ([crossing, "-o", folder / "no.vtu"], 1, "crossing.poly:7:1: error[crossing"),
        ([source, "--surface", "-o", folder / "no.vtu"], 2, "--surface is for space"),
        ([source, "--min-dihedral", 5, "-o", folder / "no.vtu"], 2, "--min-dihedral is for space"),
        ([source, "-o", folder / "no.what"], 2, "unknown_format"),
        ([source, "-o", folder / "none" / "no.msh", "--partitions"], 2, "cannot_write"),
        ([source, "-o", folder / "no.msh", "--partitions", "--pieces"], 2, "bad_option"),
        ([source, "-o", folder / "no.vtu", "--partitions"], 2, "no OUTPUT is one"),
        ([source, "--nonsense"], 2, "bad_option"),
    ):
        failed = run_ranks(3, *arguments)
        said = [line for line in failed.stderr.splitlines() if "error[" in line]
        assert len(said) == 1 and text in said[0], (arguments, failed.stderr)
        assert failed.returncode == code, (arguments, failed.returncode, failed.stderr)
        assert not list(folder.glob("no*")), arguments


def ranks_under(parent):
    """The processes of the tool that this mpirun has started."""
    found = []
    for path in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            text = path.read_text()
        except OSError:
            continue
        pid, name, rest = re.match(r"(\d+) \((.*)\) (.*)", text, re.DOTALL).groups()
        if int(rest.split()[1]) == parent and name == pathlib.Path(tool).name[:15]:
            found.append(int(pid))
    return found


def check_kills(times):
    source = make_input("large.node", "uniform", "--n", 15000)
    good = folder / "good"
    good.mkdir()
    start = time.monotonic()
    outputs = ("a.pvtu", "a.node", "a.msh")
    paths = [word for name in outputs for word in ("-o", good / name)]
    assert run_ranks(3, source, "--pieces", *paths).returncode == 0
    whole = time.monotonic() - start
    expected = {path.name: path.read_bytes() for path in good.iterdir()}
    left = folder / "left"
    for seed in range(times):
        shutil.rmtree(left, ignore_errors=True)
        left.mkdir()
        delay = random.Random(seed).uniform(0.3, 1.1) * whole
        paths = [word for name in outputs for word in ("-o", left / name)]
        run = subprocess.Popen([*mpirun, "-n", "3", tool, source, "--pieces", *paths],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(delay)
        ranks = sorted(ranks_under(run.pid))
        if ranks:
            os.kill(random.Random(seed).choice(ranks), signal.SIGKILL)
        code = run.wait(timeout=120)
        found = {p.name for p in left.iterdir()}
        if "a.pvtu" in found:
            assert {f"a_{k}.vtu" for k in range(3)} <= found, (seed, found)
        for name in found & set(expected):
            assert (left / name).read_bytes() == expected[name], (seed, name)
        print(f"rank killed after {delay:.2f} of {whole:.2f} s: exit {code}, {sorted(found)}")


shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
check_bytes()
check_limits()
check_features()
check_shares()
check_errors()
if sys.platform == "linux":
    check_kills(8)
