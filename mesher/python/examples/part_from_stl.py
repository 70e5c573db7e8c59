"""Tetrahedra in a part from an STL file; without a file, in an angle bracket that is written first.

    part_from_stl.py [PART.stl [OUTPUT.vtu]]
"""
import os
import sys
import tempfile

import numpy as np

import livemesh as lm

PROFILE = np.array([(0, 0), (4, 0), (4, 1), (1, 1), (1, 3), (0, 3)], float)
TRIANGLES = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)]  # of the profile
DEPTH = 2.0


def write_bracket(path):
    """The profile, extruded, as ASCII STL."""
    n = len(PROFILE)
    low, high = (np.column_stack((PROFILE, np.full(n, z))) for z in (0, DEPTH))
    facets = [low[[a, c, b]] for a, b, c in TRIANGLES] + [high[list(t)] for t in TRIANGLES]
    for i in range(n):
        j = (i + 1) % n
        facets += [np.array((low[i], low[j], high[j])), np.array((low[i], high[j], high[i]))]
    with open(path, "w", encoding="ascii") as file:
        file.write("solid bracket\n")
        for a, b, c in facets:
            normal = np.cross(b - a, c - a)
            file.write("facet normal {} {} {}\nouter loop\n".format(*normal / np.hypot(*normal[:2])
                       if normal[:2].any() else np.sign(normal)))
            file.writelines("vertex {!r} {!r} {!r}\n".format(*map(float, p)) for p in (a, b, c))
            file.write("endloop\nendfacet\n")
        file.write("endsolid bracket\n")


def main():
    with tempfile.TemporaryDirectory() as folder:
        path = sys.argv[1] if len(sys.argv) > 1 else os.path.join(folder, "bracket.stl")
        if len(sys.argv) < 2:
            write_bracket(path)
        m = lm.mesh(path, max_volume=.02)
    print(m, f"volume {m.quality('volume').sum():.6g}, {len(set(m.facet_ids))} flat faces, "
          f"smallest dihedral angle {m.quality('min_dihedral').min():.1f} degrees")
    if len(sys.argv) > 2:
        m.write(sys.argv[2])
    return m


if __name__ == "__main__":
    main()
