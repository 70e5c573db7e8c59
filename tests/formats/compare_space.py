#!/usr/bin/python3
"""Writes meshes of tetrahedra with space_files and compares what meshio and gmsh read with what
they are; has meshio, gmsh and TetGen write them in all their ways and compares what we read.

    compare_space.py SPACE_FILES

Points must be equal bit for bit and cells equal, with positive volumes; faces must bound a mesh.
Of complexes, faces, edges, their markers, and the tetrahedra's regions must be equal, too.
Exit code 77: neither meshio nor gmsh is installed; 1: a difference.
"""
import glob
import shutil
import subprocess
import sys
import tempfile
from collections import Counter

from foreign import (MESHIO_WRITES, bits, files_of_gmsh, files_of_meshio, gmsh, meshio,
                     open_in_gmsh)


def read_truth(path):
    points, cells, _ = read_all(path)
    return points, cells


def read_all(path):
    rows = {"v": [], "t": [], "p": []}
    with open(path) as lines:
        for line in lines:
            kind, *fields = line.split()
            rows[kind].append(tuple(map(int, fields)))
    return rows["v"], rows["t"], Counter(rows["p"])


# What a format calls regions, and markers.
MESHIO_NAMES = {".vtu": ("region", "marker"), ".vtk": ("region", "marker"),
                ".msh": ("gmsh:physical",) * 2, ".mesh": ("medit:ref",) * 2}


def parts_by_meshio(path):
    mesh = meshio.read(path)
    region, marker = MESHIO_NAMES[path[path.rindex("."):]]
    parts = Counter()
    for i, block in enumerate(mesh.cells):
        values = mesh.cell_data[region if block.type == "tetra" else marker][i]
        for value, corners in zip(values, block.data):
            parts[(int(value), *sorted(map(int, corners)))] += 1
    return parts


def parts_by_gmsh(path):
    """In .msh values are groups, in .mesh they are entities."""
    _, number = open_in_gmsh(path)
    parts = Counter()
    for dimension in (1, 2, 3):
        values = {}
        for _, group in gmsh.model.getPhysicalGroups(dimension):
            for entity in gmsh.model.getEntitiesForPhysicalGroup(dimension, group):
                values[entity] = group
        for _, entity in gmsh.model.getEntities(dimension):
            _, _, nodes = gmsh.model.mesh.getElements(dimension, entity)
            corners = [number[int(v)] for block in nodes for v in block]
            for i in range(0, len(corners), dimension + 1):
                parts[(values.get(entity, entity), *sorted(corners[i:i + dimension + 1]))] += 1
    gmsh.finalize()
    return parts


def compare_parts(program, stem):
    truth = read_all(stem + ".truth")[2]
    if not truth:
        return 0
    failures, found = 0, {}
    groups = Counter(truth)  # of Gmsh: 0 has the number above all others
    highest = max(part[0] for part in truth if len(part) == 5)
    for part in [part for part in truth if part[0] == 0]:
        groups[(highest + 1, *part[1:])] = groups.pop(part)
    for extension in (".vtu", ".vtk", ".msh", ".mesh", ".node"):
        path = stem + extension
        subprocess.run([program, "dump", path, path + ".read"], check=True)
        found["our " + extension] = read_all(path + ".read")[2]
        if meshio and extension != ".node":
            found["meshio " + extension] = parts_by_meshio(path)
        if gmsh and extension in (".msh", ".mesh"):
            found["gmsh " + extension] = parts_by_gmsh(path)
    if gmsh:
        for path, _ in files_of_gmsh(stem):
            if path.endswith(".msh"):
                subprocess.run([program, "dump", path, path + ".read"], check=True)
                found[path] = read_all(path + ".read")[2]
    for what, parts in found.items():
        if parts not in (truth, groups if what.endswith(" .msh") else truth):
            print(f"{stem} {what}: faces, edges, markers or regions differ: missing "
                  f"{list((truth - parts))[:3]}, too many {list((parts - truth))[:3]}",
                  file=sys.stderr)
            failures += 1
    return failures


def by_meshio(path):
    mesh = meshio.read(path)
    cells = [tuple(map(int, c)) for b in mesh.cells if b.type == "tetra" for c in b.data]
    return [tuple(map(bits, p)) for p in mesh.points], cells


def by_gmsh(path):
    places, number = open_in_gmsh(path)
    points = [tuple(map(bits, place)) for place in places]
    _, _, nodes = gmsh.model.mesh.getElements(3)
    corners = [number[int(v)] for block in nodes for v in block]
    gmsh.finalize()
    return points, [tuple(corners[i:i + 4]) for i in range(0, len(corners), 4)]


def by_hand(stem):
    """.node, .ele and .face, as TetGen describes them."""
    def rows(extension):
        with open(stem + extension) as lines:
            return [line.split() for line in lines]
    nodes, elements, faces = rows(".node"), rows(".ele"), rows(".face")
    points = [tuple(bits(float(x)) for x in row[1:4]) for row in nodes[1:]]
    cells = [tuple(int(v) - 1 for v in row[1:5]) for row in elements[1:]]
    sides = Counter(v for a, b, c in ([int(v) - 1 for v in row[1:4]] for row in faces[1:])
                    for v in ((a, b), (b, c), (c, a)))
    closed = all(sides[b, a] == n == 1 for (a, b), n in sides.items())
    counts = (int(nodes[0][0]), int(elements[0][0]), int(faces[0][0]))
    if not closed or counts != (len(points), len(cells), len(faces) - 1):
        print(f"{stem}: the faces are no closed surface, or counts differ", file=sys.stderr)
        return [], []
    return points, cells


def surface_by_hand(stem):
    """The faces of .face by the bits of their corners."""
    points, _ = by_hand(stem)
    with open(stem + ".face") as lines:
        rows = [line.split() for line in lines][1:]
    return Counter(tuple(points[int(v) - 1] for v in row[1:4]) for row in rows)


def surface_by_meshio(path):
    mesh = meshio.read(path)
    points = [tuple(map(bits, p)) for p in mesh.points]
    faces = [face for block in mesh.cells if block.type == "triangle" for face in block.data]
    return Counter(tuple(points[int(v)] for v in face) for face in faces)


def compare_surfaces(stem):
    failures = 0
    truth = surface_by_hand(stem)
    for extension in (".off", ".obj", ".stl"):
        if surface_by_meshio(stem + extension) != truth:
            print(f"meshio {stem + extension}: faces differ", file=sys.stderr)
            failures += 1
    return failures


def differs(what, found, expected, ordered=True):
    same = found[0] == expected[0] and (found[1] == expected[1] if ordered else
                                        Counter(found[1]) == Counter(expected[1]))
    if not same:
        print(f"{what}: points or cells differ", file=sys.stderr)
    return not same


TETGEN_BY_MESHIO = ("tetgen", ".node", "tetgen", {})


def our_reading(program, path):
    subprocess.run([program, "dump", path, path + ".read"], check=True)
    return read_truth(path + ".read")


def compare_files_of_meshio(program, stem, truth):
    return sum(differs(path, our_reading(program, path), truth)
               for path in files_of_meshio(stem, [*MESHIO_WRITES, TETGEN_BY_MESHIO]))


def compare_surface_of_meshio(program, stem):
    """The faces of STEM.vtu with their markers, as meshio writes them and we read polygons."""
    mesh = meshio.read(stem + ".vtu")
    faces, markers = [], []
    for block, values in zip(mesh.cells, mesh.cell_data["marker"]):
        if block.type == "triangle":
            faces.extend(tuple(map(int, face)) for face in block.data)
            markers.extend(map(int, values))
    path = stem + ".surface.vtu"
    meshio.write(path, meshio.Mesh(mesh.points, [("triangle", faces)],
                                   cell_data={"marker": [markers]}))
    subprocess.run([program, "dump", path, path + ".read"], check=True)
    points, _, parts = read_all(path + ".read")
    expected = Counter((m, *sorted(face)) for m, face in zip(markers, faces))
    if parts == expected and points == [tuple(map(bits, p)) for p in mesh.points]:
        return 0
    print(f"{path}: points, faces or markers differ", file=sys.stderr)
    return 1


def compare_files_of_gmsh(program, stem, truth):
    """gmsh writes coordinates in text with 16 digits: only binary files are the same to the bit."""
    failures = 0
    for path, is_binary in files_of_gmsh(stem):
        points, cells = our_reading(program, path)
        expected = truth if is_binary else (points, truth[1])
        failures += len(points) != len(truth[0])
        failures += differs(path, (points, cells), expected, False)
    return failures


def compare_files_of_tetgen(program, stem, truth):
    """TetGen refines nothing that is as it wants it, and writes numbers from 1 or from 0 on."""
    failures = 0
    for zero in ("", "z"):
        copy = f"{stem}_tetgen{zero}"
        shutil.copy(stem + ".node", copy + ".node")
        subprocess.run(["tetgen", "-Q" + zero, copy + ".node"], check=True,
                       stdout=subprocess.DEVNULL)
        points, cells = our_reading(program, copy + ".1.node")
        with open(copy + ".1.ele") as lines:
            rows = [line.split("#")[0].split() for line in lines]
        rows = [list(map(int, row[:5])) for row in rows if row][1:]
        if len(points) != len(truth[0]) or cells != [tuple(v - (not zero) for v in row[1:])
                                                     for row in rows]:
            print(f"{copy}.1: points or cells differ", file=sys.stderr)
            failures += 1
    return failures


def main():
    if meshio is None and gmsh is None:
        return 77
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[1], "write", folder], check=True)
        stems = [path[:-6] for path in sorted(glob.glob(folder + "/*.truth"))]
        for stem in stems:
            truth = read_truth(stem + ".truth")
            failures += compare_parts(sys.argv[1], stem)
            if "complex" not in stem:
                failures += differs(stem + ".node", by_hand(stem), truth)
            for extension in (".vtu", ".vtk", ".msh", ".mesh") if meshio else ():
                ordered = extension != ".msh" or "complex" not in stem  # it has region by region
                failures += differs(f"meshio {extension}", by_meshio(stem + extension), truth, ordered)
            for extension in (".vtk", ".msh", ".mesh") if gmsh else ():
                failures += differs(f"gmsh {extension}", by_gmsh(stem + extension), truth, False)
            if meshio:
                if "complex" in stem:
                    failures += compare_surface_of_meshio(sys.argv[1], stem)
                else:
                    failures += compare_surfaces(stem)
                failures += compare_files_of_meshio(sys.argv[1], stem, truth)
            if gmsh:
                failures += compare_files_of_gmsh(sys.argv[1], stem, truth)
            # small: below TetGen's tolerance; of complexes it makes other meshes.
            if shutil.which("tetgen") and "small" not in stem and "complex" not in stem:
                failures += compare_files_of_tetgen(sys.argv[1], stem, truth)
    return 1 if failures or not stems else 0


if __name__ == "__main__":
    sys.exit(main())
