#!/usr/bin/env python3
"""The order of the rooms: which folder of the sources may include which.

The rooms of mesher/src stand on floors, listed below from the ground up. A file includes files of
its own room and of rooms below, never of rooms above; within a room, headers include each other in
no circle. Public headers include public headers alone, likewise in no circle. The libraries include
each other as DESIGN says: sac nobody, mesher and traces sac.

    tests/rooms.py [ROOT]      prints each include that breaks the order; exit 1 if there is one
    tests/rooms.py --list      prints the rooms
"""
import pathlib
import re
import sys

ROOMS = {  # from the ground up
    "platform": "what is asked of the operating system, one file for each",
    "text": "numbers and quoted text, errors",
    "sets": "sorting, disjoint sets, sets by sorted lists",
    "geometry": "predicates, balls, boxes, the grid; input points at the boundary",
    "graph": "what is asked of a graph before geometry: ids that repeat, ends that are missing",
    "records": "vertices, segments and their labels, as stored; trees of things with a reach",
    "cells": "clipped Voronoi cells",
    "mesh": "the form of a mesh: canonical order, neighbours, borders",
    "delaunay": "the Delaunay kernel",
    "index": "the quadtree and the vertices in it",
    "borders": "what tiles of a mesh tell each other",
    "sizes": "limits of size and the lattices that suit them",
    "rules": "which vertex to insert, in which bucket; the box that suits a rule",
    "live": "a mesh in slots that follows changes",
    "domain": "regions of a triangulation, and how they follow its changes",
    "plane": "features of the input in the plane: segments, their pieces, what crowds them",
    "space": "features of the input in space: edges and polygons",
    "program": "the self-adjusting program: BuildQT, ChooseSteiners, Triangulate, features",
    "tiles": "meshers of the parts of a mesh, and how they come to agree",
    "check": "reports on meshes, and checks that know nothing of how they were made",
    "generate": "families of points, graphs and complexes",
    "refinement": "the static refiners: SVR, Delaunay refinement, flat tetrahedra taken out",
    "repair": "graphs and complexes that do not fit together, made to fit",
    "io": "files",
    "facade": "what users call: edits on one side, runs on the other",
}
MODULES = {"sac": ["sac"], "mesher": ["sac", "mesher"], "traces": ["sac", "traces"]}

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]', re.MULTILINE)


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in (".hpp", ".cpp"))


def includes(path):
    return INCLUDE.findall(path.read_text(encoding="utf-8"))


def room_faults_of(source, path):
    """Includes of one file that go up, or a room that the list above does not know."""
    floor = {room: i for i, room in enumerate(ROOMS)}
    name = path.relative_to(source)
    room = name.parts[0]
    if len(name.parts) == 1 or room not in floor:
        yield f"mesher/src/{name} is in no room that tests/rooms.py knows"
        return
    for other in includes(path):
        other_room = other.split("/")[0]
        if other_room == "mesher" or not (source / other).is_file():
            continue
        if floor.get(other_room, len(floor)) > floor[room]:
            yield f"mesher/src/{name} includes {other}: {other_room} is above {room}"


def room_faults(root):
    source = root / "mesher" / "src"
    for path in sources(source):
        yield from room_faults_of(source, path)


def circles(graph):
    """One circle for each place where a depth-first walk comes back to its own way."""
    state = {}

    def walk(node, way):
        state[node] = 1
        for other in graph[node]:
            if state.get(other) == 1:
                yield way[way.index(other):] + [other] if other in way else [node, other]
            elif other not in state:
                yield from walk(other, way + [other])
        state[node] = 2

    for node in graph:
        if node not in state:
            yield from walk(node, [node])


def circle_faults(base):
    headers = {str(p.relative_to(base)): p for p in sources(base) if p.suffix == ".hpp"}
    graph = {n: [o for o in includes(p) if o in headers] for n, p in headers.items()}
    for circle in circles(graph):
        yield f"{base.parent.name}/{base.name}: a circle of includes: " + " -> ".join(circle)


def module_faults(root):
    """Libraries that include what they must not know, and public headers that include private ones."""
    for module, known in MODULES.items():
        public = root / module / "include"
        for path in sources(public) + sources(root / module / "src"):
            is_public = path.is_relative_to(public)
            for other in includes(path):
                first = other.split("/")[0]
                if "/" in other and first in MODULES and first not in known:
                    yield f"{path.relative_to(root)} includes {other}: {module} must not know {first}"
                if is_public and (root / module / "src" / other).is_file():
                    yield f"{path.relative_to(root)}, a public header, includes {other}"


def faults(root):
    yield from room_faults(root)
    yield from module_faults(root)
    for module in MODULES:
        for folder in ("include", "src"):
            yield from circle_faults(root / module / folder)


def main(arguments):
    if arguments == ["--list"]:
        for room, what in reversed(ROOMS.items()):
            print(f"{room:12} {what}")
        return 0
    root = pathlib.Path(arguments[0] if arguments else pathlib.Path(__file__).parents[1])
    found = list(faults(root))
    for fault in found:
        print(fault)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
