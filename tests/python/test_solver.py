"""GetDP, with the program of its page, on the meshes of a LiveMesh, before and after edits: a linear
potential is exact on each of them. Skipped without getdp."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import numpy as np

import livemesh as lm

PAGE = pathlib.Path(__file__).resolve().parents[2] / "mesher/docs/solvers/getdp.md"
SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]


@unittest.skipUnless(shutil.which("getdp"), "needs getdp")
class Solver(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        text = PAGE.read_text(encoding="utf-8")
        program = re.search(r"<!-- file: square.pro -->\s*```\n(.*?)```", text, re.S)[1]
        pathlib.Path(self.folder, "square.pro").write_text(program, encoding="utf-8")

    def answer(self, mesh):
        """The potential at (1, 3), and the flux."""
        mesh.name(facets={"inlet": 7, "outlet": 8}, cells={"rock": 3})
        mesh.write(os.path.join(self.folder, "m.msh"), version=2.2)
        subprocess.run(["getdp", "square.pro", "-msh", "m.msh", "-solve", "Solve", "-pos", "Tell"],
                       cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
        return [float(pathlib.Path(self.folder, name).read_text().split()[-1])
                for name in ("u.txt", "flux.txt")]

    def test_a_potential_before_and_after_edits(self):
        d = lm.LiveMesh(bounds=((0, 0), (8, 8)), min_angle=28, max_area=.2)
        p = d.add_points(SQUARE)
        d.add_segments([(0, 1), (1, 2), (2, 3), (3, 0)], markers=[1, 7, 1, 8])
        d.add_regions([(.1, .1, 3)])
        d.update()
        np.testing.assert_allclose(self.answer(d.mesh()), (1 / 4, 4), rtol=1e-9)
        wall = d.add_polyline(d.add_points([(1, 2), (2, 2.5), (3, 1.5)]), marker=9)
        d.update()
        np.testing.assert_allclose(self.answer(d.mesh()), (1 / 4, 4), rtol=1e-9)
        with d.edit() as change:
            d.move(p[1:3], [(5, 0), (5, 4)])
        self.assertGreater(len(change.cells_added), 0)
        np.testing.assert_allclose(self.answer(d.mesh()), (1 / 5, 4), rtol=1e-9)
        np.testing.assert_allclose(self.answer(d.mesh().second_order()), (1 / 5, 4), rtol=1e-9)
        d.undo()
        d.remove_lines(wall)
        d.update()
        np.testing.assert_allclose(self.answer(d.mesh()), (1 / 4, 4), rtol=1e-9)


if __name__ == "__main__":
    unittest.main()
