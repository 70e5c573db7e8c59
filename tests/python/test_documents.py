"""What docstrings and the README show is true, and the examples run."""
import doctest
import importlib
import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import livemesh as lm

PACKAGE = pathlib.Path(lm.__file__).resolve().parent
PYTHON = pathlib.Path(__file__).resolve().parents[2] / "mesher" / "python"
# Modules of the package import pyvista, and are to be looked at where it is not.
STAND_INS = str(pathlib.Path(__file__).with_name("stand_ins"))
sys.path.append(STAND_INS)
TOOL = os.environ.get("LIVEMESH_TOOL", "")
DATA = pathlib.Path(__file__).resolve().parents[1] / "data"


def has(name):
    return importlib.util.find_spec(name) is not None


def run(example, *arguments):
    process = subprocess.run([sys.executable, str(PYTHON / "examples" / example), *arguments],
                             capture_output=True, text=True, timeout=300)
    if process.returncode != 0:
        raise AssertionError(process.stdout + process.stderr)
    return process.stdout


class Documents(unittest.TestCase):
    def test_docstrings(self):
        names = {name: getattr(lm, name) for name in lm.__all__}
        for path in sorted(PACKAGE.rglob("*.py")):
            parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
            module = importlib.import_module(".".join(p for p in parts if p != "__init__"))
            found = doctest.testmod(module, extraglobs={**names, "lm": lm, "np": np})
            self.assertEqual(found.failed, 0, path)

    def test_everything_public_has_a_docstring(self):
        for name in lm.__all__:
            thing = getattr(lm, name)
            if callable(thing):
                self.assertTrue(thing.__doc__, name)
            for part, value in vars(thing).items() if isinstance(thing, type) else ():
                if not part.startswith("_") and (callable(value) or isinstance(value, property)):
                    self.assertTrue(value.__doc__, f"{name}.{part}")

    def test_readme(self):
        readme = PYTHON / "README.md"
        text = readme.read_text(encoding="utf-8")
        if TOOL:
            os.environ["PATH"] = os.path.dirname(TOOL) + os.pathsep + os.environ["PATH"]
        else:  # no view
            text = re.sub(r"^## A live mesh in a browser$.*?^## ", "## ", text, flags=re.M | re.S)
        test = doctest.DocTestParser().get_doctest(text, {"DATA": str(DATA)}, "README.md",
                                                   str(readme), 0)
        with tempfile.TemporaryDirectory() as folder:
            before = os.getcwd()
            os.chdir(folder)
            try:
                found = doctest.DocTestRunner().run(test)
            finally:
                os.chdir(before)
        self.assertEqual(found.failed, 0)
        self.assertGreater(found.attempted, 10)

    def test_getting_started(self):
        found = doctest.testfile(str(PYTHON.parent / "docs" / "start.md"), module_relative=False)
        self.assertEqual(found.failed, 0)
        self.assertGreater(found.attempted, 5)

    def test_readme_of_the_repository(self):
        text = (PYTHON.parents[1] / "README.md").read_text(encoding="utf-8")
        (block,) = re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)
        with tempfile.TemporaryDirectory() as folder:
            shutil.copy(DATA / "great_lakes.poly", os.path.join(folder, "lake.poly"))
            process = subprocess.run([sys.executable, "-c", block], cwd=folder, text=True,
                                     capture_output=True, timeout=100)
            self.assertEqual((process.returncode, process.stderr), (0, ""))
            self.assertTrue(os.path.exists(os.path.join(folder, "lake.vtu")))

    @unittest.skipUnless(shutil.which("stubtest"), "mypy is not there")
    def test_types_are_those_of_the_program(self):
        allowed = pathlib.Path(__file__).with_name("stubtest_allowlist.txt")
        process = subprocess.run(["stubtest", "livemesh", "--allowlist", str(allowed),
                                  "--ignore-unused-allowlist"], cwd=PYTHON, text=True,
                                 capture_output=True, timeout=300, env={
                                     **os.environ, "PYTHONPATH": os.pathsep.join(
                                         (os.environ.get("PYTHONPATH", ""), STAND_INS))})
        self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
        process = subprocess.run(["mypy", "--strict", "-p", "livemesh", "--cache-dir", os.devnull],
                                 cwd=PYTHON, text=True, capture_output=True, timeout=300)
        self.assertEqual(process.returncode, 0, process.stdout)


class Examples(unittest.TestCase):
    @unittest.skipUnless(has("scipy"), "scipy is not there")
    def test_heat_around_an_obstacle(self):
        follows, anew = run("heat_around_obstacle.py", "10"), run("heat_around_obstacle.py",
                                                                  "--anew", "10")
        mean = [float(text.split("mean temperature ")[1].split(",")[0]) for text in (follows, anew)]
        self.assertAlmostEqual(mean[0], mean[1], delta=.01)

    def test_sides_of_a_periodic_cell_agree(self):
        said = run("periodic_cell.py").splitlines()
        self.assertRegex(said[0], r"^[0-9]+ twins, \[1.0, 0.0\] from each other$")
        self.assertRegex(said[1], r"^[0-9]+ twins, \[0.0, 1.0\] from each other$")
        twins = [int(line.split()[0]) for line in said[:2]]
        vertices, unknowns = [int(n) for n in re.findall("([0-9]+) (?:vertices|unknowns)", said[2])]
        self.assertGreater(min(twins), 5)
        # The four corners have one unknown: twice two twins, and one more for both pairs.
        self.assertEqual(vertices - unknowns, sum(twins) - 1)

    def test_a_shape_is_optimised(self):
        self.assertIn("conductance", run("optimise_shape.py", "16"))

    def test_coasts_from_geojson(self):
        lakes = lm.Graph.read(DATA / "great_lakes.poly")
        row = {int(i): k for k, i in enumerate(lakes.point_ids)}
        beside = {}
        for a, b in lakes.segments:
            beside.setdefault(row[int(a)], []).append(row[int(b)])
            beside.setdefault(row[int(b)], []).append(row[int(a)])
        rings, left = [], set(beside)
        while left:  # each coast is a closed line
            ring = [left.pop()]
            while True:
                following = [p for p in beside[ring[-1]] if p in left]
                if not following:
                    break
                ring.append(following[0])
                left.remove(following[0])
            rings.append(ring + ring[:1])
        points = lakes.points
        features = [{"type": "Feature", "properties": {"marker": 4},
                     "geometry": {"type": "LineString", "coordinates": points[r].tolist()}}
                    for r in rings]
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "lakes.geojson")
            with open(path, "w") as file:
                json.dump({"type": "FeatureCollection", "features": features}, file)
            text = run("coasts.py", path, os.path.join(folder, "lakes.vtu"))
            self.assertIn("triangles", text)
            made = lm.Mesh.read(os.path.join(folder, "lakes.vtu"))
            self.assertEqual(set(made.facet_markers), {4})

    def test_a_part_from_stl(self):
        self.assertIn("volume 12, 8 flat faces", run("part_from_stl.py"))


if __name__ == "__main__":
    unittest.main()
