"""`pip install` of the package into a fresh environment, offline and with isolation; the wheel in
another one; an editable one; what types say. Skipped without python3-venv."""
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PYTHON = pathlib.Path(__file__).resolve().parents[2] / "mesher" / "python"
HAS_VENV = all(importlib.util.find_spec(name) for name in ("venv", "ensurepip"))
LIBRARY = os.environ.get("LIVEMESH_LIBRARY")
TRY = ("import livemesh as lm; m = lm.mesh([(0, 0), (1, 0), (0, 1)], min_angle=28); "
       "print(len(m.cells), lm.__file__)")


def run(*command, **variables):
    environment = {name: value for name, value in os.environ.items()
                   if name not in ("PYTHONPATH", "LIVEMESH_LIBRARY")}
    environment.update(PIP_NO_INDEX="1", PIP_DISABLE_PIP_VERSION_CHECK="1", **variables)
    process = subprocess.run([str(c) for c in command], capture_output=True, text=True,
                             env=environment, cwd=tempfile.gettempdir())
    if process.returncode != 0:
        raise AssertionError(process.stdout + process.stderr)
    return process.stdout


@unittest.skipUnless(HAS_VENV and LIBRARY, "needs python3-venv and a library")
class Install(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.package = self.folder / "package"  # a copy: pip builds beside the sources
        shutil.copytree(PYTHON, self.package / "mesher" / "python")
        shutil.copy(PYTHON.parents[1] / "LICENSE", self.package)
        self.package = self.package / "mesher" / "python"

    def environment(self, name):
        run(sys.executable, "-m", "venv", "--system-site-packages", self.folder / name)
        return self.folder / name / "bin"

    def test_install_and_the_wheel_elsewhere(self):
        bin_ = self.environment("first")
        run(bin_ / "pip", "install", self.package, LIVEMESH_LIBRARY=LIBRARY)
        self.assertIn(str(self.folder), run(bin_ / "python", "-c", TRY))
        wheels = self.folder / "wheels"
        run(bin_ / "pip", "wheel", "--no-deps", "-w", wheels, self.package,
            LIVEMESH_LIBRARY=LIBRARY)
        (wheel,) = wheels.iterdir()
        self.assertRegex(wheel.name, r"^livemesh-[\d.]+-py3-none-\w+\.whl$")
        other = self.environment("second")
        run(other / "pip", "install", wheel, PATH="/nowhere")  # no compiler, no cmake
        self.assertIn(str(self.folder / "second"), run(other / "python", "-c", TRY))

    def test_editable(self):
        bin_ = self.environment("editable")
        run(bin_ / "pip", "install", "-e", self.package, LIVEMESH_LIBRARY=LIBRARY)
        self.assertIn(str(self.package), run(bin_ / "python", "-c", TRY))

    def test_source_distribution(self):
        sys.path.insert(0, str(PYTHON))
        import build_livemesh

        name = build_livemesh.build_sdist(str(self.folder))
        shutil.unpack_archive(self.folder / name, self.folder)
        source = self.folder / name[:-len(".tar.gz")] / "source"
        for part in ("CMakeLists.txt", "sac/src", "mesher/c/include/livemesh.h",
                     "mesher/include/mesher/mesher.hpp"):
            self.assertTrue((source / part).exists(), part)


if __name__ == "__main__":
    unittest.main()
