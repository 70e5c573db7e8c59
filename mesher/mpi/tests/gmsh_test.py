#!/usr/bin/env python3
"""What `mesher-mpi --pieces` and `--partitions` write, as Gmsh reads it: each piece is a partition,
and together they are the whole mesh, as is the one file of all partitions.

    gmsh_test.py MESHER_MPI MESHER FOLDER MPIRUN...      77: there is no Gmsh for this Python
"""
import pathlib
import subprocess
import sys

try:
    import gmsh
except ImportError:
    sys.exit(77)

tool, mesher, folder = sys.argv[1:4]
mpirun = sys.argv[4:]
folder = pathlib.Path(folder) / "gmsh_test"
folder.mkdir(parents=True, exist_ok=True)


def read(paths, dimension):
    """Places by node, and elements by number: (nodes, partition, entity it is a part of)."""
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    for path in paths:
        gmsh.merge(str(path))
    tags, at, _ = gmsh.model.mesh.getNodes()
    nodes = {}
    for i, tag in enumerate(tags):
        place = tuple(at[3 * i:3 * i + 3])
        assert nodes.setdefault(int(tag), place) == place, "one node at two places"
    elements = {}
    for dim, entity in gmsh.model.getEntities(dimension):
        partitions = [int(p) for p in gmsh.model.getPartitions(dim, entity)]
        parent = tuple(gmsh.model.getParent(dim, entity))
        for numbers, corners in zip(*gmsh.model.mesh.getElements(dim, entity)[1:]):
            for i, number in enumerate(numbers):
                of = corners[i * (dimension + 1):(i + 1) * (dimension + 1)]
                assert int(number) not in elements, "an element in two pieces"
                elements[int(number)] = ([int(n) for n in of], partitions, parent)
    gmsh.finalize()
    return nodes, elements


def places(nodes, elements):
    return sorted(tuple(sorted(nodes[n] for n in of)) for of, _, _ in elements.values())


def check(dimension, n, ranks):
    source, whole, parts = folder / "in.node", folder / "whole.msh", folder / "part.msh"
    subprocess.run([mesher, "gen", "uniform", "--n", str(n), "--dim", str(dimension), "-o", source],
                   check=True, capture_output=True)
    for old in folder.glob("part_*.msh"):
        old.unlink()
    run = [*mpirun, "-n", str(ranks), tool, source, "-o"]
    subprocess.run([*run, parts, "--pieces"], check=True)
    subprocess.run([*run, whole], check=True)
    pieces = [folder / f"part_{k + 1}.msh" for k in range(ranks)]
    assert sorted(folder.glob("part_*.msh")) == sorted(pieces)
    nodes, elements = read([whole], dimension)
    of_all_nodes, of_all = read(pieces, dimension)
    assert sorted(of_all_nodes) == list(range(1, len(nodes) + 1))
    assert sorted(of_all) == list(range(1, len(elements) + 1))
    assert places(of_all_nodes, of_all) == places(nodes, elements)
    count = 0
    for k, piece in enumerate(pieces):
        own_nodes, own = read([piece], dimension)
        count += len(own)
        assert {n for of, _, _ in own.values() for n in of} == set(own_nodes)
        for number, (of, partitions, parent) in own.items():
            assert partitions == [k + 1] and parent == (dimension, 1), (partitions, parent)
            assert of_all[number][0] == of and all(own_nodes[n] == of_all_nodes[n] for n in of)
    assert count == len(elements)
    one_file = folder / "partitions.msh"
    subprocess.run([*run, one_file, "--partitions"], check=True)
    in_one_nodes, in_one = read([one_file], dimension)
    assert in_one_nodes == of_all_nodes and in_one == of_all
    print(f"{dimension}-dimensional, {len(elements)} elements in {ranks} pieces")


for dimension, n, ranks in ((2, 500, 1), (2, 500, 3), (2, 3, 5), (3, 60, 2), (3, 60, 4)):
    check(dimension, n, ranks)
