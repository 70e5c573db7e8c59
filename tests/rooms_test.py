#!/usr/bin/env python3
"""The order of the rooms holds, and tests/rooms.py says so when an include is turned."""
import pathlib
import shutil
import tempfile
import unittest

import rooms

ROOT = pathlib.Path(__file__).resolve().parents[1]


class Rooms(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)
        for module in rooms.MODULES:
            for folder in ("include", "src"):
                shutil.copytree(ROOT / module / folder, self.root / module / folder)

    def faults_with(self, path, include):
        file = self.root / path
        file.write_text(file.read_text(encoding="utf-8") + f'\n#include "{include}"\n', encoding="utf-8")
        return list(rooms.faults(self.root))

    def test_the_sources_keep_the_order(self):
        self.assertEqual([], list(rooms.faults(ROOT)))

    def test_an_include_of_a_room_above_is_a_fault(self):
        faults = self.faults_with("mesher/src/geometry/box.hpp", "program/world.hpp")
        self.assertEqual(
            ["mesher/src/geometry/box.hpp includes program/world.hpp: program is above geometry"],
            [fault for fault in faults if "above" in fault])

    def test_each_include_between_two_rooms_is_a_fault_when_it_is_turned(self):
        source = self.root / "mesher" / "src"
        turned = 0
        for path in rooms.sources(source):
            name = path.relative_to(source)
            for other in rooms.includes(path):
                if not (source / other).is_file() or other.split("/")[0] == name.parts[0]:
                    continue
                turned += 1
                text = (source / other).read_text(encoding="utf-8")
                (source / other).write_text(text + f'\n#include "{name}"\n', encoding="utf-8")
                found = list(rooms.room_faults_of(source, source / other))
                self.assertEqual(1, len(found), f"{other} includes {name}")
                (source / other).write_text(text, encoding="utf-8")
        self.assertGreater(turned, 100)

    def test_a_circle_within_a_room_is_a_fault(self):
        faults = self.faults_with("mesher/src/geometry/box.hpp", "geometry/box_tree.hpp")
        self.assertTrue(any("circle" in fault for fault in faults), faults)

    def test_a_file_in_no_room_is_a_fault(self):
        (self.root / "mesher/src/loose.hpp").write_text("#pragma once\n", encoding="utf-8")
        self.assertIn("mesher/src/loose.hpp is in no room that tests/rooms.py knows",
                      list(rooms.faults(self.root)))

    def test_the_engine_does_not_know_the_mesher(self):
        faults = self.faults_with("sac/include/sac/mod.hpp", "mesher/mesh.hpp")
        self.assertEqual(["sac/include/sac/mod.hpp includes mesher/mesh.hpp: sac must not know mesher"],
                         faults)

    def test_a_public_header_includes_no_private_one(self):
        faults = self.faults_with("mesher/include/mesher/mesh.hpp", "geometry/box.hpp")
        self.assertEqual(
            ["mesher/include/mesher/mesh.hpp, a public header, includes geometry/box.hpp"], faults)


if __name__ == "__main__":
    unittest.main()
