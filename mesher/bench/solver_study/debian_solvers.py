"""The problems of elements.py by programs of Debian: heat by GetDP (getdp, with PETSc), elasticity
by CalculiX (calculix-ccx). Files go to the working folder. Both assemble from the mesh themselves.
"""
import re
import subprocess

import numpy as np

from elements import boundary_faces

GETDP_OPTIONS = ("none", "jacobi", "icc")  # PETSc's names of preconditioners
CALCULIX_SOLVERS = ("ITERATIVE SCALING", "ITERATIVE CHOLESKY")

# --- GetDP ---------------------------------------------------------------------------------------

HEAT = """
Group { Body = Region[1]; Border = Region[2]; Domain = Region[{Body, Border}]; }
Function {
  exact[] = Sin[X[]] * Cos[Y[]] * Exp[Z[]];
  slope[] = Vector[Cos[X[]] * Cos[Y[]], -Sin[X[]] * Sin[Y[]], Sin[X[]] * Cos[Y[]]] * Exp[Z[]];
}
Constraint { { Name Fixed; Case { { Region Border; Value exact[]; } } } }
FunctionSpace {
  { Name Space; Type Form0;
    BasisFunction {
      { Name sn; NameOfCoef vn; Function BF_Node; Support Domain; Entity NodesOf[All]; } }
    Constraint { { NameOfCoef vn; EntityType NodesOf; NameOfConstraint Fixed; } } }
}
Jacobian { { Name Jac; Case { { Region All; Jacobian Vol; } } } }
Integration {
  { Name Int; Case { { Type Gauss; Case { { GeoElement Tetrahedron; NumberOfPoints 15; } } } } } }
Formulation {
  { Name Heat; Type FemEquation;
    Quantity { { Name u; Type Local; NameOfSpace Space; } }
    Equation {
      Integral { [ Dof{d u}, {d u} ]; In Body; Jacobian Jac; Integration Int; }
      Integral { [ -exact[], {u} ]; In Body; Jacobian Jac; Integration Int; } } }
}
Resolution {
  { Name Solve; System { { Name A; NameOfFormulation Heat; } }
    Operation { Generate[A]; Solve[A]; SaveSolution[A]; } } }
PostProcessing {
  { Name Post; NameOfFormulation Heat; Quantity {
%s  } } }
PostOperation {
  { Name Tell; NameOfPostProcessing Post; Operation {
%s  } } }
"""
SQUARES = {"wrong": "SquNorm[{u} - exact[]]", "u": "SquNorm[exact[]]",
           "off": "SquNorm[{d u} - slope[]]", "slope": "SquNorm[slope[]]"}


def getdp(mesh, preconditioner):
    """Heat with all of the boundary fixed, by conjugate gradients to a residual of 10^-8:
    iterations, and errors as GetDP integrates them."""
    write_msh(mesh, "body.msh")
    values = "".join(f"{{ Name {name}; Value {{ Integral {{ [ {what} ]; In Body; Jacobian Jac; "
                     "Integration Int; } } }\n" for name, what in SQUARES.items())
    prints = "".join(f'Print[ {name}[Body], OnGlobal, Format Table, File "{name}.txt" ];\n'
                     for name in SQUARES)
    with open("heat.pro", "w", encoding="ascii") as file:
        file.write(HEAT % (values, prints))
    said = _run("getdp", "heat.pro", "-msh", "body.msh", "-solve", "Solve", "-pos", "Tell",
                "-ksp_type", "cg", "-pc_type", preconditioner, "-ksp_rtol", "1e-8",
                "-ksp_norm_type", "unpreconditioned", "-ksp_converged_reason")
    found = re.search(r"Linear solve converged due to \S+ iterations (\d+)", said)
    sums = {name: float(np.loadtxt(name + ".txt").ravel()[-1]) for name in SQUARES}
    return {"preconditioner": preconditioner, "iterations": int(found[1]) if found else None,
            "l2_error": (sums["wrong"] / sums["u"]) ** 0.5,
            "energy_error": (sums["off"] / sums["slope"]) ** 0.5}


def write_msh(mesh, path):
    """Version 2.2: the tetrahedra are region 1, their boundary is region 2."""
    points, cells = mesh
    faces = boundary_faces(cells)
    with open(path, "w", encoding="ascii") as file:
        file.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(points)}\n")
        _table(file, points)
        file.write(f"$EndNodes\n$Elements\n{len(cells) + len(faces)}\n")
        for number, face in enumerate(faces + 1, 1):
            print(number, 2, 2, 2, 2, *face, file=file)
        for number, cell in enumerate(cells + 1, 1 + len(faces)):
            print(number, 4, 2, 1, 1, *cell, file=file)
        file.write("$EndElements\n")


# --- CalculiX ------------------------------------------------------------------------------------


def calculix(mesh, problem, fixed, values, load, solver):
    """Displacements of all vertices, and iterations; `values` at the vertices `fixed`, and forces
    at all others. CalculiX ends early, at a residual of some thousandths of the forces (`limit` in
    what it prints). With CHOLESKY it raises the diagonal by `alpha` until there is a factor."""
    points, cells = mesh
    forces = load.reshape(-1, 3).copy()
    forces[fixed] = 0
    with open("job.inp", "w", encoding="ascii") as file:
        file.write("*NODE, NSET=Nall\n")
        _table(file, points, ", ", digits=13)  # it reads 20 characters
        file.write("*ELEMENT, TYPE=C3D4, ELSET=Eall\n")
        _table(file, cells + 1, ", ")
        file.write(f"*MATERIAL, NAME=m\n*ELASTIC\n{problem.young}, {problem.poisson}\n"
                   "*SOLID SECTION, ELSET=Eall, MATERIAL=m\n*BOUNDARY\n")
        file.writelines(f"{v + 1}, {k}, {k}\n" for v in fixed for k in (1, 2, 3))
        file.write(f"*STEP\n*STATIC, SOLVER={solver}\n*BOUNDARY\n")
        file.writelines(f"{v + 1}, {k}, {k}, {value:.12g}\n"
                        for v, row in zip(fixed, values) for k, value in enumerate(row, 1))
        file.write("*CLOAD\n")
        file.writelines(f"{v + 1}, {k}, {value:.12g}\n" for v, row in enumerate(forces)
                        for k, value in enumerate(row, 1) if value)
        file.write("*NODE PRINT, NSET=Nall\nU\n*END STEP\n")
    said = _run("ccx", "job")
    solution = np.zeros(points.shape)
    with open("job.dat", encoding="ascii") as lines:
        for fields in map(str.split, lines):
            if len(fields) == 4 and fields[0].isdigit():
                solution[int(fields[0]) - 1] = [float(field) for field in fields[1:]]
    alphas = re.findall(r"alpha=(\S+)", said)
    told = {"iterations": int(re.search(r"# of iterations = (\d+)", said)[1])}
    if alphas:
        told["alpha"] = float(alphas[-1])
    return solution.ravel(), told


def _table(file, rows, between=" ", digits=17):
    for number, row in enumerate(rows.tolist(), 1):
        file.write(between.join([str(number), *(f"{value:.{digits}g}" for value in row)]) + "\n")


def _run(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}:\n{done.stdout}")
    return done.stdout
