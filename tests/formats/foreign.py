"""Files that meshio and gmsh write of a mesh, in all their ways, and what they read.

Each of `meshio` and `gmsh` is None if it is not installed.
"""
import struct

try:
    import meshio
except ImportError:
    meshio = None
try:
    import gmsh
except ImportError:
    gmsh = None

# How meshio writes: a name, an extension, the format's name and its options.
MESHIO_WRITES = [("zlib", ".vtu", "vtu", {"compression": "zlib"}),
                 ("plain", ".vtu", "vtu", {"compression": None}),
                 ("ascii42", ".vtk", "vtk42", {"binary": False}),
                 ("ascii51", ".vtk", "vtk51", {"binary": False}),
                 ("binary42", ".vtk", "vtk42", {"binary": True}),
                 ("binary51", ".vtk", "vtk51", {"binary": True}),
                 ("medit", ".mesh", "medit", {"float_fmt": ".17g"})]
# How gmsh writes: binary or not, an extension, the version of .msh.
GMSH_WRITES = ((0, ".msh", 4.1), (0, ".mesh", 4.1), (0, ".vtk", 4.1), (1, ".msh", 4.1),
               (1, ".vtk", 4.1), (0, ".msh", 2.2), (1, ".msh", 2.2))


def bits(number):
    return struct.unpack("<Q", struct.pack("<d", number))[0]


def files_of_meshio(stem, ways):
    """Points and cells of STEM.vtu in files that meshio writes; yields their paths."""
    mesh = meshio.read(stem + ".vtu")
    mesh.cell_data = {}
    mesh.point_data = {}
    for name, extension, form, options in ways:
        path = f"{stem}.meshio_{name}{extension}"
        meshio.write(path, mesh, form, **options)
        yield path


def files_of_gmsh(stem):
    """STEM.msh in files that gmsh writes; yields their paths and whether they are binary."""
    for binary, extension, version in GMSH_WRITES:
        path = f"{stem}.gmsh{binary}_{version}{extension}"
        gmsh.initialize()
        gmsh.option.setNumber("General.Verbosity", 0)
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.option.setNumber("Mesh.SaveAll", version > 4)  # before, that drops the groups
        gmsh.option.setNumber("Mesh.Binary", binary)
        gmsh.open(stem + ".msh")
        gmsh.write(path)
        gmsh.finalize()
        yield path, bool(binary)


def open_in_gmsh(path):
    """The places of the nodes by number, and the index of each; gmsh.finalize() is the caller's."""
    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 0)
    gmsh.open(path)
    tags, places, _ = gmsh.model.mesh.getNodes()
    order = sorted(range(len(tags)), key=lambda i: tags[i])
    number = {int(tags[i]): k for k, i in enumerate(order)}
    return [places[3 * i:3 * i + 3] for i in order], number
