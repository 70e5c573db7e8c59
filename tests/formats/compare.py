#!/usr/bin/python3
"""Writes meshes with mesh_files and compares what meshio and gmsh read with what they are; has both
write them again, and compares what mesh_files reads.

    compare.py MESH_FILES [FOLDER]

Points must be equal bit for bit (but for what gmsh writes, with 14 digits), cells, regions and
markers equal. Exit code 77: neither meshio nor
gmsh is installed; 1: a difference.
"""
import os
import struct
import subprocess
import sys
import tempfile
from collections import Counter

from foreign import (GMSH_WRITES, MESHIO_WRITES, bits, files_of_gmsh, files_of_meshio, gmsh,
                     meshio, open_in_gmsh)


class Truth:
    """A mesh as write_meshes says it is."""

    def __init__(self, path):
        self.points, self.triangles, self.edges = [], [], []
        with open(path) as lines:
            for line in lines:
                kind, *fields = line.split()
                if kind == "v":
                    self.points.append(tuple(int(bits, 16) for bits in fields))
                elif kind == "t":
                    self.triangles.append((tuple(map(int, fields[:3])), float(fields[3])))
                else:
                    self.edges.append((tuple(map(int, fields[:2])), int(fields[2])))

    def has_small_values(self):
        """Whether formats with small numbers keep regions and markers as they are."""
        return (all(r == int(r) and r > 0 for _, r in self.triangles)
                and all(0 <= m < 2**31 - 1 for _, m in self.edges))


def value(its_bits):
    return struct.unpack("<d", struct.pack("<Q", its_bits))[0]


class Comparison:
    def __init__(self, name):
        self.name, self.failures = name, 0

    def equal(self, what, found, expected):
        if found == expected:
            return
        self.failures += 1
        print(f"{self.name}: {what} differ", file=sys.stderr)
        for a, b in zip(found, expected) if isinstance(found, list) else ():
            if a != b:
                print(f"  {a}, expected {b}", file=sys.stderr)
                break

    def points(self, found, truth):
        self.equal("points", [(bits(p[0]), bits(p[1])) for p in found], truth.points)
        self.equal("heights", {p[2] for p in found if len(p) > 2} | {0.0}, {0.0})

    def cells(self, what, found, expected, ordered=True):
        if ordered:
            self.equal(what, list(found), list(expected))
        else:
            self.equal(what, Counter(found), Counter(expected))


def blocks(mesh, kind):
    return [(i, b.data) for i, b in enumerate(mesh.cells) if b.type == kind]


def rows(mesh, kind, data=None):
    """The cells of a kind, each with its value in the cell data of that name."""
    for i, cells in blocks(mesh, kind):
        values = mesh.cell_data[data][i] if data else [None] * len(cells)
        for cell, value in zip(cells, values):
            yield tuple(int(v) for v in cell), value if data is None else float(value)


def compare_vtk(check, mesh, truth):
    has_data = "region" in mesh.cell_data
    regions = [t if has_data else (t[0], None) for t in truth.triangles]
    check.cells("triangles", rows(mesh, "triangle", "region" if has_data else None), regions)
    check.cells("edges", rows(mesh, "line", "marker" if truth.edges else None),
                [(e, float(m)) for e, m in truth.edges])


def compare_msh(check, mesh, truth):
    if "gmsh:physical" not in mesh.cell_data:
        found = [cell for cell, _ in rows(mesh, "triangle")]
        check.cells("triangles", found, [t for t, _ in truth.triangles], ordered=False)
        check.equal("edges", truth.edges, [])
        return
    names = {(int(dim), int(number)): float(name.split("_")[1])
             for name, (number, dim) in mesh.field_data.items()}
    for kind, dim, what in (("triangle", 2, truth.triangles), ("line", 1, truth.edges)):
        found = [(cell, names[dim, int(number)]) for cell, number in
                 rows(mesh, kind, "gmsh:physical")]
        check.cells(kind, found, [(c, float(v)) for c, v in what], ordered=False)


def compare_medit(check, mesh, truth):
    triangles = list(rows(mesh, "triangle", "medit:ref"))
    check.cells("triangles", [t for t, _ in triangles], [t for t, _ in truth.triangles])
    edges = list(rows(mesh, "line", "medit:ref")) if truth.edges else []
    check.cells("edges", [e for e, _ in edges], [e for e, _ in truth.edges])
    if truth.has_small_values():
        check.cells("regions", triangles, truth.triangles)
        check.cells("markers", edges, [(e, float(m)) for e, m in truth.edges])


def compare_triangles(check, mesh, truth):
    check.cells("triangles", [t for t, _ in rows(mesh, "triangle")],
                [t for t, _ in truth.triangles])


BY_MESHIO = {".vtu": compare_vtk, ".vtk": compare_vtk, ".msh": compare_msh, ".mesh": compare_medit,
             ".off": compare_triangles, ".obj": compare_triangles}
BY_GMSH = (".msh", ".vtk", ".mesh")


def judge_by_meshio(path, truth, extension):
    check = Comparison(f"meshio {path}")
    mesh = meshio.read(path)
    check.points(mesh.points, truth)
    BY_MESHIO[extension](check, mesh, truth)
    return check.failures


def judge_by_gmsh(path, truth, extension):
    check = Comparison(f"gmsh {path}")
    places, number = open_in_gmsh(path)
    check.points(places, truth)
    found = {1: [], 2: []}
    for dim, tag in gmsh.model.getEntities():
        group = gmsh.model.getPhysicalGroupsForEntity(dim, tag)
        name = gmsh.model.getPhysicalName(dim, group[0]) if len(group) else "none_0"
        for _, _, nodes in zip(*gmsh.model.mesh.getElements(dim, tag)):
            size = dim + 1
            for i in range(0, len(nodes), size):
                cell = tuple(number[int(v)] for v in nodes[i:i + size])
                found[dim].append((cell, float(name.split("_")[1]) if extension == ".msh" else 0.0))
    gmsh.finalize()
    for dim, what in ((2, truth.triangles), (1, truth.edges)):
        expected = [(c, float(v) if extension == ".msh" else 0.0) for c, v in what]
        check.cells(f"cells of dimension {dim}", found[dim], expected, ordered=False)
    return check.failures


def nearly_equal(points, expected):
    """Whether all coordinates are, to 13 digits of the largest."""
    values = [[value(x) for p in of for x in p] for of in (points, expected)]
    largest = max(map(abs, values[1]), default=0)
    return len(values[0]) == len(values[1]) and all(
        abs(a - b) <= 1e-13 * largest for a, b in zip(*values))


def judge_our_reading(program, path, truth, exact=True):
    """What mesh_files says of a file must be the points and cells of `truth`."""
    check = Comparison(f"mesh_files {path}")
    subprocess.run([program, "dump", path, path + ".truth"], check=True)
    ours = Truth(path + ".truth")
    if exact:
        check.equal("points", ours.points, truth.points)
    else:
        check.equal("points nearly equal", nearly_equal(ours.points, truth.points), True)
    check.cells("triangles", [t for t, _ in ours.triangles], [t for t, _ in truth.triangles],
                ordered=False)
    check.cells("edges", [e for e, _ in ours.edges], [e for e, _ in truth.edges], ordered=False)
    return check.failures


def judge_files_of_meshio(program, stem, truth):
    return sum(judge_our_reading(program, path, truth)
               for path in files_of_meshio(stem, MESHIO_WRITES))


def judge_files_of_gmsh(program, stem, truth):
    return sum(judge_our_reading(program, path, truth, exact=is_binary)
               for path, is_binary in files_of_gmsh(stem))


def main():
    if meshio is None and gmsh is None:
        print("neither meshio nor gmsh is installed")
        return 77
    folder = sys.argv[2] if len(sys.argv) > 2 else tempfile.mkdtemp()
    os.makedirs(folder, exist_ok=True)
    subprocess.run([sys.argv[1], "write", folder], check=True)
    failures = judged = 0
    for name in sorted(n[:-6] for n in os.listdir(folder) if n.endswith(".truth")):
        stem = os.path.join(folder, name)
        truth = Truth(stem + ".truth")
        for extension in BY_MESHIO if meshio else ():
            failures += judge_by_meshio(stem + extension, truth, extension)
            judged += 1
        for extension in BY_GMSH if gmsh else ():
            failures += judge_by_gmsh(stem + extension, truth, extension)
            judged += 1
        if meshio:
            failures += judge_files_of_meshio(sys.argv[1], stem, truth)
            judged += len(MESHIO_WRITES)
        if gmsh:
            failures += judge_files_of_gmsh(sys.argv[1], stem, truth)
            judged += len(GMSH_WRITES)
    print(f"{judged} files judged, {failures} differences")
    return 1 if failures else 0


sys.exit(main())
