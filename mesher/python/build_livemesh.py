"""Builds wheels and source distributions of livemesh (PEP 517, 660), by CMake and this file alone.

The environment may set LIVEMESH_LIBRARY, a library that was built already; LIVEMESH_BUILD, a folder
for CMake that is kept, so that the next build is short; CMAKE_ARGS and CMAKE_BUILD_PARALLEL_LEVEL.
"""
import base64
import hashlib
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE / "source" if (HERE / "source").exists() else HERE.parents[1]
LIBRARY = {"win32": "livemesh.dll", "darwin": "liblivemesh.dylib"}.get(sys.platform,
                                                                       "liblivemesh.so")
VERSION = re.search(r'^version = "(.*)"', (HERE / "pyproject.toml").read_text(), re.M).group(1)
NAME = f"livemesh-{VERSION}"
TAG = "py3-none-" + re.sub(r"\W", "_", sysconfig.get_platform())
METADATA = f"""Metadata-Version: 2.1
Name: livemesh
Version: {VERSION}
Summary: Delaunay meshes of good quality that follow edits of their input
License: MIT
Requires-Python: >=3.9
Requires-Dist: numpy
Description-Content-Type: text/markdown

"""


def build_library(folder):
    """The path of the shared library, built in `folder` unless there is one already."""
    if os.environ.get("LIVEMESH_LIBRARY"):
        return pathlib.Path(os.environ["LIVEMESH_LIBRARY"]).resolve()
    folder = os.environ.get("LIVEMESH_BUILD") or folder
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    subprocess.check_call(["cmake", "-S", str(HERE), "-B", folder, *generator,
                           *shlex.split(os.environ.get("CMAKE_ARGS", ""))])
    subprocess.check_call(["cmake", "--build", folder, "--target", "livemesh"])
    return next(pathlib.Path(folder).rglob(LIBRARY)).resolve()


def metadata():
    return {"METADATA": (METADATA + (HERE / "README.md").read_text()).encode(),
            "WHEEL": (f"Wheel-Version: 1.0\nGenerator: build_livemesh\nRoot-Is-Purelib: false\n"
                      f"Tag: {TAG}\n").encode(),
            "LICENSE": (ROOT / "LICENSE").read_bytes()}


def write_wheel(folder, files):
    """files: contents by the path in the wheel."""
    info = NAME + ".dist-info/"
    files = {**files, **{info + name: data for name, data in metadata().items()}}
    record = "".join(
        f"{path},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode()[:43]}"
        f",{len(data)}\n" for path, data in files.items()) + f"{info}RECORD,,\n"
    name = f"{NAME}-{TAG}.whl"
    with zipfile.ZipFile(os.path.join(folder, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in {**files, info + "RECORD": record.encode()}.items():
            wheel.writestr(zipfile.ZipInfo(path, (1980, 1, 1, 0, 0, 0)), data, zipfile.ZIP_DEFLATED)
    return name


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = pathlib.Path(metadata_directory, NAME + ".dist-info")
    folder.mkdir()
    for name, data in metadata().items():
        (folder / name).write_bytes(data)
    return folder.name


prepare_metadata_for_build_editable = prepare_metadata_for_build_wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    files = {p.relative_to(HERE).as_posix(): p.read_bytes()
             for p in sorted((HERE / "livemesh").rglob("*"))
             if p.suffix in (".py", ".typed", ".pyi") or p.name == "py.typed"}
    with tempfile.TemporaryDirectory() as folder:
        files["livemesh/" + LIBRARY] = build_library(folder).read_bytes()
    return write_wheel(wheel_directory, files)


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    with tempfile.TemporaryDirectory() as folder:
        shutil.copyfile(build_library(folder), HERE / "livemesh" / LIBRARY)
    return write_wheel(wheel_directory, {"livemesh.pth": f"{HERE}\n".encode()})


def build_sdist(sdist_directory, config_settings=None):
    """The package, and of the repository what its library is made of."""
    parts = [(HERE / name, name) for name in ("pyproject.toml", "build_livemesh.py", "README.md",
                                              "CMakeLists.txt", "livemesh")]
    inside = ["CMakeLists.txt", "LICENSE"]
    for module, folders in (("sac", ("include", "src")), ("mesher", ("include", "src", "c")),
                            ("traces", ("include", "src"))):
        inside += [f"{module}/{name}" for name in ("CMakeLists.txt", *folders)]
    parts += [(ROOT / name, "source/" + name) for name in inside]

    def wanted(member):
        return None if re.search(r"__pycache__|\.so$|\.dylib$|\.dll$", member.name) else member

    with tarfile.open(os.path.join(sdist_directory, NAME + ".tar.gz"), "w:gz") as archive:
        for path, name in parts:
            if path.exists():
                archive.add(path, f"{NAME}/{name}", filter=wanted)
        info = tarfile.TarInfo(f"{NAME}/PKG-INFO")
        info.size = len(METADATA.encode())
        with tempfile.TemporaryFile() as file:
            file.write(METADATA.encode())
            file.seek(0)
            archive.addfile(info, file)
    return NAME + ".tar.gz"
