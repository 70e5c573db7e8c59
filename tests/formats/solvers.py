#!/usr/bin/python3
"""Meshes small problems, and has readers and solvers of others look at the files: meshio, gmsh,
CalculiX (ccx) and GetDP, each if it is installed.

    solvers.py MESHER [FOLDER]

The answers are known: a uniform state, which every element represents exactly, a linear potential,
and the deflection of a beam. Exit code 77: nothing of these is installed; 1: a difference.
"""
import os
import shutil
import subprocess
import sys
import tempfile

from foreign import gmsh, meshio

SQUARE = """4 2 0 0
1 0 0
2 4 0
3 4 4
4 0 4
4 1
1 1 2 1
2 2 3 7
3 3 4 1
4 4 1 8
0
1
1 1 1 3
"""


def block(x, markers):
    """A block of x by 1 by 1; markers: of bottom, top, front, back, left, right."""
    corners = [(0, 0, 0), (x, 0, 0), (x, 1, 0), (0, 1, 0), (0, 0, 1), (x, 0, 1), (x, 1, 1),
               (0, 1, 1)]
    faces = [(1, 2, 3, 4), (5, 6, 7, 8), (1, 2, 6, 5), (4, 3, 7, 8), (1, 4, 8, 5), (2, 3, 7, 6)]
    rows = ["8 3 0 0"] + [f"{i} {a} {b} {c}" for i, (a, b, c) in enumerate(corners, 1)]
    rows += ["6 1"]
    for face, marker in zip(faces, markers):
        rows += [f"1 0 {marker}", "4 " + " ".join(map(str, face))]
    return "\n".join(rows + ["0", "1", "1 .5 .5 .5 3"]) + "\n"


class Judge:
    def __init__(self):
        self.looks, self.faults = 0, 0

    def require(self, holds, what):
        self.looks += 1
        if holds:
            return
        self.faults += 1
        print(f"not so: {what}", file=sys.stderr)

    def near(self, found, expected, bound, what):
        self.require(abs(found - expected) <= bound, f"{what}: {found}, expected {expected}")


def run(*command, **options):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, **options).stdout


def write(path, text):
    with open(path, "w", encoding="ascii") as file:
        file.write(text)


# --- Readers -------------------------------------------------------------------------------------

NAMES = {"marker_1": (1, 1), "inlet": (7, 1), "marker_8": (8, 1), "rock": (3, 2)}
# Corners and the midpoint between them, in the order of meshio, which is that of VTK.
MIDPOINTS = {"line3": [(0, 1)], "triangle6": [(0, 1), (1, 2), (2, 0)],
             "tetra10": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]}


def look_at_midpoints(judge, mesh, path):
    for cells in mesh.cells:
        if cells.type not in MIDPOINTS:
            judge.require(False, f"{path} has cells of second order alone, not {cells.type}")
            continue
        pairs = MIDPOINTS[cells.type]
        for k, (a, b) in enumerate(pairs, cells.data.shape[1] - len(pairs)):
            p = mesh.points[cells.data]
            judge.require((p[:, k] == (p[:, a] + p[:, b]) / 2).all(),
                          f"{path}: node {k} of {cells.type} is between {a} and {b}")


def look_by_meshio(judge, mesher):
    named = ["--name-marker", "7=inlet", "--name-region", "3=rock", "--quiet", "--max-area", ".5"]
    for version in ("2.2", "4.1"):
        for order in ("1", "2"):
            path = f"m{version}.{order}.msh"
            run(mesher, "mesh", "square.poly", "-o", path, "--order", order, "--msh-version",
                version, *named)
            mesh = meshio.read(path)
            names = {name: (int(n), int(d)) for name, (n, d) in mesh.field_data.items()}
            judge.require(names == NAMES, f"names of {path}: {names}")
            if order == "2":
                look_at_midpoints(judge, mesh, path)
    run(mesher, "mesh", "square.poly", "-o", "m.inp", "-o", "m.su2", *named)
    mesh = meshio.read("m.inp")
    judge.require(set(mesh.point_sets) == {"marker_1", "inlet", "marker_8"}, "sets of nodes")
    judge.require(set(mesh.cell_sets) == {"rock", "Eall"}, "sets of elements")
    x = mesh.points[mesh.point_sets["inlet"]][:, 0]
    judge.require(len(x) > 2 and (x == 4).all(), "the inlet's nodes in m.inp")
    mesh = meshio.read("m.su2")
    lines = [b.data for b in mesh.cells if b.type == "line"][0]
    ends = mesh.points[lines]
    judge.near(abs(ends[:, 0] - ends[:, 1]).sum(), 16, 1e-12, "the border in m.su2")
    for extension in (".vtu", ".vtk", ".msh", ".inp"):
        path = "cube" + extension
        run(mesher, "mesh", "cube.poly", "-o", path, "--order", "2", "--max-size", ".5",
            "--min-dihedral", "10", "--quiet")
        look_at_midpoints(judge, meshio.read(path), path)


def look_by_gmsh(judge):
    if not os.path.exists("m2.2.1.msh"):
        return
    for path in ("m2.2.1.msh", "m2.2.2.msh", "m4.1.1.msh", "m4.1.2.msh", "cube.msh"):
        gmsh.initialize()
        gmsh.option.setNumber("General.Verbosity", 0)
        gmsh.open(path)
        groups = gmsh.model.getPhysicalGroups()
        if path.startswith("m"):
            names = {gmsh.model.getPhysicalName(d, n): (n, d) for d, n in groups}
            judge.require(names == NAMES, f"names of {path} in gmsh: {names}")
        for dimension in (2, 3):
            for kind in gmsh.model.mesh.getElementTypes(dimension):
                places = gmsh.model.mesh.getIntegrationPoints(kind, "Gauss4")[0]
                if path.startswith("m") or dimension == 3:
                    _, sizes, _ = gmsh.model.mesh.getJacobians(kind, places)
                    judge.require(min(sizes) > 0, f"{path}: elements are not inside out")
        gmsh.finalize()


def look_at_twins_by_gmsh(judge, mesher):
    """Version 4.1: gmsh itself reads no $Periodic of 2.2 back."""
    write("cell.poly", CELL)
    for order in ("1", "2"):
        run(mesher, "mesh", "cell.poly", "-o", "twins.msh", "--periodic", "4=2", "--order", order,
            "--quiet")
        gmsh.initialize()
        gmsh.option.setNumber("General.Verbosity", 0)
        gmsh.open("twins.msh")
        master, nodes, twins, _ = gmsh.model.mesh.getPeriodicNodes(1, 2)
        judge.require(master == 4 and len(nodes) > 5, f"order {order}: the right side is periodic")
        for a, b in zip(nodes, twins):
            p, q = (gmsh.model.mesh.getNode(node)[0] for node in (a, b))
            judge.require((p[0], *p[1:]) == (1, *q[1:]) and q[0] == 0, f"twins {p} and {q}")
        gmsh.finalize()


# Corners and the midpoint between them in .ele, .face and .edge of TetGen.
TETGEN = {".ele": (4, [(2, 3), (0, 3), (0, 1), (1, 2), (1, 3), (0, 2)]),
          ".face": (3, [(1, 2), (2, 0), (0, 1)]), ".edge": (2, [(0, 1)])}


def rows(path):
    with open(path, encoding="ascii") as lines:
        all_rows = [line.split("#")[0].split() for line in lines]
    return [row for row in all_rows if row][1:]


def look_at_rows(judge, stem):
    places = {row[0]: tuple(map(float, row[1:4])) for row in rows(stem + ".node")}
    for extension, (corners, pairs) in TETGEN.items():
        for row in rows(stem + extension):
            p = [places[v] for v in row[1:1 + corners + len(pairs)]]
            for k, (a, b) in enumerate(pairs, corners):
                off = max(abs(2 * m - x - y) for m, x, y in zip(p[k], p[a], p[b]))
                judge.require(off < 1e-12, f"{stem}{extension}: node {k} is between {a} and {b}")


def look_at_tetgen(judge, mesher):
    """What TetGen writes in second order is read; and midpoints stand where its do."""
    run("tetgen", "-pqo2fe", "cube.poly")
    run(mesher, "mesh", "cube.poly", "-o", "ours.node", "--order", "2", "--quiet")
    for stem in ("cube.1", "ours"):
        look_at_rows(judge, stem)
    said = run(mesher, "check", "cube.1.node", "--boundary", "any")
    judge.require("of second order are not used" in said and "volume" not in said, said)


# --- CalculiX ------------------------------------------------------------------------------------

STEEL = """*MATERIAL, NAME=m
*ELASTIC
210000, 0.3
*DENSITY
1
*SOLID SECTION, ELSET={elset}, MATERIAL=m
"""


def displacements(job):
    """{node: (x, y, z)} that a job prints."""
    write(job + ".inp", open(job + ".txt", encoding="ascii").read())
    said = run("ccx", job)
    if "*ERROR" in said:
        raise RuntimeError(said)
    found = {}
    with open(job + ".dat", encoding="ascii") as lines:
        for line in lines:
            fields = line.split()
            if len(fields) == 4 and fields[0].isdigit():
                found[int(fields[0])] = tuple(map(float, fields[1:]))
    return found


def nodes_of(path):
    """{node: place} of an .inp file."""
    nodes = {}
    with open(path, encoding="ascii") as lines:
        inside = False
        for line in lines:
            if line.startswith("*"):
                inside = line.startswith("*NODE")
            elif inside:
                number, *place = line.split(",")
                nodes[int(number)] = tuple(map(float, place))
    return nodes


def pull(judge, mesher, source, order, boundary, load, strains):
    """A block under uniform tension or pressure: displacements are linear in the places."""
    run(mesher, "mesh", source, "-o", "mesh.inp", "--order", order, "--max-size", ".4", "--quiet",
        "--name-region", "3=steel", "--name-marker", "5=left", "--name-marker", "6=right")
    thickness = "1.\n" if len(strains) == 2 else ""
    write("job.txt", "*INCLUDE, INPUT=mesh.inp\n" + STEEL.format(elset="steel") + thickness +
          "*BOUNDARY\n" +
          boundary + "*STEP\n*STATIC\n*DLOAD\n" + load +
          "*NODE PRINT, NSET=Nall\nU\n*END STEP\n")
    nodes, moved = nodes_of("mesh.inp"), displacements("job")
    judge.require(moved.keys() == nodes.keys(), "every node has moved")
    worst = max(abs(u - strain * x) for n in moved
                for u, strain, x in zip(moved[n], strains, nodes[n]))
    judge.require(worst < 1e-9, f"{source}, order {order}: displacements are off by {worst}")


def bend(judge, mesher):
    """A clamped beam under its weight: theory of thin beams, with shear, to 2%."""
    run(mesher, "mesh", "beam.poly", "-o", "beam.inp", "--order", "2", "--max-size", ".7",
        "--min-dihedral", "10", "--quiet", "--name-marker", "5=clamped", "--name-marker", "6=tip")
    write("bend.txt", "*INCLUDE, INPUT=beam.inp\n" + STEEL.format(elset="Eall") +
          "*BOUNDARY\nclamped, 1, 3\n*STEP\n*STATIC\n*DLOAD\nEall, GRAV, 1, 0, 0, -1\n"
          "*NODE PRINT, NSET=tip\nU\n*END STEP\n")
    tip = displacements("bend")
    young, shear, length = 210000, 210000 / 2.6, 10
    theory = length**4 / (8 * young / 12) + length**2 / 2 / (5 / 6 * shear)
    for _, _, z in tip.values():
        judge.near(-z, theory, .02 * theory, "the deflection of the beam's tip")


def solve_by_calculix(judge, mesher):
    strain = 210 / 210000
    for order in ("1", "2"):
        held = "left, 1, 1\nmarker_3, 2, 2\nmarker_1, 3, 3\n"
        pull(judge, mesher, "cube.poly", order, held, "right, P, -210\n",
             (strain, -.3 * strain, -.3 * strain))
        pull(judge, mesher, "cube.poly", order, held,
             "right, P, 210\nmarker_2, P, 210\nmarker_4, P, 210\n", 3 * (-.4 * strain,))
        pull(judge, mesher, "plate.poly", order, "left, 1, 1\nmarker_1, 2, 2\n",
             "right, P, -210\n", (strain, -.3 * strain))
    bend(judge, mesher)


# --- GetDP ---------------------------------------------------------------------------------------

POTENTIAL = """
Group {
  Rock = Region[3]; Inlet = Region[7]; Outlet = Region[8];
  Domain = Region[{Rock, Inlet, Outlet}];
}
Constraint {
  { Name Fixed; Case { { Region Inlet; Value 1; } { Region Outlet; Value 0; } } }
}
FunctionSpace {
  { Name Space; Type Form0;
    BasisFunction {
      { Name sn; NameOfCoef vn; Function BF_Node; Support Domain; Entity NodesOf[All]; }
    }
    Constraint { { NameOfCoef vn; EntityType NodesOf; NameOfConstraint Fixed; } } }
}
Jacobian { { Name Jac; Case { { Region All; Jacobian Vol; } } } }
Integration {
  { Name Int; Case { { Type Gauss; Case {
    { GeoElement Triangle; NumberOfPoints 4; } { GeoElement Triangle2; NumberOfPoints 6; }
  } } } }
}
Formulation {
  { Name Laplace; Type FemEquation;
    Quantity { { Name u; Type Local; NameOfSpace Space; } }
    Equation { Integral { [ Dof{d u}, {d u} ]; In Rock; Jacobian Jac; Integration Int; } } }
}
Resolution {
  { Name Solve; System { { Name A; NameOfFormulation Laplace; } }
    Operation { Generate[A]; Solve[A]; SaveSolution[A]; } }
}
PostProcessing {
  { Name Post; NameOfFormulation Laplace; Quantity {
    { Name u; Value { Local { [ {u} ]; In Rock; Jacobian Jac; } } }
    { Name flux;
      Value { Integral { [ CompX[{d u}] ]; In Rock; Jacobian Jac; Integration Int; } } }
  } }
}
PostOperation {
  { Name Tell; NameOfPostProcessing Post; Operation {
    Print[ u, OnPoint {1, 3, 0}, Format Table, File "u.txt" ];
    Print[ flux[Rock], OnGlobal, Format Table, File "flux.txt" ];
  } }
}
"""


# A cell that repeats to the right: its hole is near one side.
CELL = """8 2 0 0
1 0 0
2 1 0
3 1 1
4 0 1
5 .05 .4
6 .2 .4
7 .2 .6
8 .05 .6
5 1
1 1 2 1
2 2 3 2
3 3 4 3
4 4 1 4
5 5 6 9
0
1
1 .5 .5 5
"""

PERIODIC = """
Group {
  Cell = Region[5]; Right = Region[2]; Left = Region[4];
  Domain = Region[{Cell, Right, Left}];
}
Function { f[] = (1 + 4 * Pi^2) * Sin[2 * Pi * X[]]; exact[] = Sin[2 * Pi * X[]]; }
Constraint {
  { Name Same; Case {
    { Region Right; Type Link; RegionRef Left; Coefficient 1; Function Vector[X[] - 1, Y[], Z[]]; }
  } }
}
FunctionSpace {
  { Name Space; Type Form0;
    BasisFunction {
      { Name sn; NameOfCoef vn; Function BF_Node; Support Domain; Entity NodesOf[All]; }
    }
    Constraint { { NameOfCoef vn; EntityType NodesOf; NameOfConstraint Same; } } }
}
Jacobian { { Name Jac; Case { { Region All; Jacobian Vol; } } } }
Integration { { Name Int; Case { { Type Gauss; Case {
  { GeoElement Triangle; NumberOfPoints 7; } } } } } }
Formulation {
  { Name Reaction; Type FemEquation;
    Quantity { { Name u; Type Local; NameOfSpace Space; } }
    Equation {
      Integral { [ Dof{d u}, {d u} ]; In Cell; Jacobian Jac; Integration Int; }
      Integral { [ Dof{u}, {u} ]; In Cell; Jacobian Jac; Integration Int; }
      Integral { [ -f[], {u} ]; In Cell; Jacobian Jac; Integration Int; } } }
}
Resolution {
  { Name Solve; System { { Name A; NameOfFormulation Reaction; } }
    Operation { Generate[A]; Solve[A]; SaveSolution[A]; } }
}
PostProcessing {
  { Name Post; NameOfFormulation Reaction; Quantity {
    { Name wrong;
      Value { Integral { [ ({u} - exact[])^2 ]; In Cell; Jacobian Jac; Integration Int; } } }
  } }
}
PostOperation {
  { Name Tell; NameOfPostProcessing Post;
    Operation { Print[ wrong[Cell], OnGlobal, Format Table, File "wrong.txt" ]; } }
}
"""


def solve_periodic_by_getdp(judge, mesher):
    """u - u'' = (1 + 4 pi^2) sin(2 pi x), the same at both sides: sin(2 pi x), whose derivative there
    is not 0, as it would be without the link."""
    write("cell.poly", CELL)
    write("cell.pro", PERIODIC)
    for sides in (["--periodic", "4=2"], []):
        run(mesher, "mesh", "cell.poly", "-o", "cell.msh", "--msh-version", "2.2", "--max-area",
            ".0005", "--quiet", *sides)
        said = subprocess.run(["getdp", "cell.pro", "-msh", "cell.msh", "-solve", "Solve", "-pos",
                               "Tell"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              check=False).stdout
        if sides:
            wrong = float(open("wrong.txt", encoding="ascii").read().split()[-1])
            judge.require(wrong < 1e-5, f"the periodic solution is off by {wrong}: {said}")
        else:
            judge.require("Error" in said, f"sides that do not fit together are linked: {said}")


def potential(judge, mesh, at_one, flux, what):
    run("getdp", "square.pro", "-msh", mesh, "-solve", "Solve", "-pos", "Tell")
    for path, expected in (("u.txt", at_one), ("flux.txt", flux)):
        with open(path, encoding="ascii") as said:
            judge.near(float(said.read().split()[-1]), expected, 1e-9, f"{what}: {path}")


def solve_by_getdp(judge, mesher):
    """u = x / 4 in the square, by its groups in a .msh of version 2.2."""
    write("square.pro", POTENTIAL)
    for order in ("1", "2"):
        run(mesher, "mesh", "square.poly", "-o", "square.msh", "--msh-version", "2.2", "--order",
            order, "--max-area", ".2", "--quiet")
        potential(judge, "square.msh", .25, 4, f"order {order}")


# A wall comes into the square, moves and bends; then the right side moves; and
# then it is all as it was.
EDITS = ["""begin
+point 5 1 2
+point 6 2 2.5
+point 7 3 1.5
+polyline 5 5 6 7 marker 9
commit
move 6 1.5 3.5
+point 8 0.5 3
""", """begin
move 2 5 0
move 3 5 4
commit
limit area 0.05 in 2 0 5 2
""", """begin
-polyline 5
-point 5
-point 6
-point 7
-point 8
commit
move 2 4 0
move 3 4 4
"""]


def solve_edited_by_getdp(judge, mesher):
    """u is x over the width of the square in meshes that follow edits, too."""
    write("square.pro", POTENTIAL)
    for count, at_one in ((0, 1 / 4), (1, 1 / 4), (2, 1 / 5), (3, 1 / 4)):
        write("edits.txt", "".join(EDITS[:count]))
        run(mesher, "edit", "square.poly", "--script", "edits.txt", "-o", "edited.msh",
            "--msh-version", "2.2", "--max-area", ".2", "--domain", "0", "0", "8", "8", "--quiet")
        potential(judge, "edited.msh", at_one, 4, f"after {count} scripts of edits")


def main():
    mesher = os.path.abspath(sys.argv[1])
    folder = sys.argv[2] if len(sys.argv) > 2 else tempfile.mkdtemp()
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    write("square.poly", SQUARE)
    write("plate.poly", "4 2 0 0\n1 0 0\n2 2 0\n3 2 1\n4 0 1\n4 1\n1 1 2 1\n2 2 3 6\n3 3 4 2\n"
          "4 4 1 5\n0\n1\n1 1 .5 3\n")
    write("cube.poly", block(1, (1, 2, 3, 4, 5, 6)))
    write("beam.poly", block(10, (1, 1, 1, 1, 5, 6)))
    judge, missing = Judge(), []
    for name, is_there, look in (
            ("meshio", meshio is not None, lambda: look_by_meshio(judge, mesher)),
            ("gmsh", gmsh is not None, lambda: look_by_gmsh(judge)),
            ("gmsh", gmsh is not None, lambda: look_at_twins_by_gmsh(judge, mesher)),
            ("tetgen", shutil.which("tetgen"), lambda: look_at_tetgen(judge, mesher)),
            ("ccx", shutil.which("ccx"), lambda: solve_by_calculix(judge, mesher)),
            ("getdp", shutil.which("getdp"), lambda: solve_by_getdp(judge, mesher)),
            ("getdp", shutil.which("getdp"), lambda: solve_edited_by_getdp(judge, mesher)),
            ("getdp", shutil.which("getdp"), lambda: solve_periodic_by_getdp(judge, mesher))):
        if is_there:
            look()
        else:
            missing.append(name)
    if missing:
        print("not installed:", ", ".join(missing))
    print(f"{judge.looks} looks, {judge.faults} faults")
    return 1 if judge.faults else 77 if judge.looks == 0 else 0


sys.exit(main())
