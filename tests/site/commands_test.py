#!/usr/bin/env python3
"""What the documents show of the tools is what they print; and what they would not print is found.

    commands_test.py BIN
"""
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "mesher/docs/site"))
import build
import commands

BIN = str(pathlib.Path(sys.argv.pop(1)).resolve())


def documents():
    """Those that have commands."""
    for path in sorted((ROOT / "mesher/docs").rglob("*.md")):
        if "```console" in path.read_text(encoding="utf-8"):
            yield path


class Commands(unittest.TestCase):
    def faults(self, path):
        with tempfile.TemporaryDirectory() as folder:
            document = commands.Document(path, ROOT, BIN, pathlib.Path(folder))
            list(document.run())
            return document.count, document.faults

    def faults_of(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "page.md")
            path.write_text(text, encoding="utf-8")
            return self.faults(path)[1]

    def test_documents(self):
        count = 0
        for path in documents():
            with self.subTest(path=path.name):
                done, faults = self.faults(path)
                count += done
                self.assertEqual(faults, [], "\n".join(faults))
        self.assertGreater(count, 80)

    def test_other_output_is_found(self):
        self.assertEqual(self.faults_of("```console\n$ echo a; echo b\na\nb\n```\n"), [])
        self.assertEqual(self.faults_of("```console\n$ echo a1b\na...b\n```\n"), [])
        self.assertEqual(self.faults_of("```console\n$ seq 9\n1\n...\n9\n```\n"), [])
        self.assertEqual(self.faults_of("```console\n$ echo \\\n  a\na\n$ true\n```\n"), [])
        for text in ("$ echo a\nb\n", "$ echo a\n", "$ true\na\n", "$ seq 9\n1\n...\n8\n",
                     "$ mesher mesh nothing.poly -o a.vtu\n"):
            self.assertEqual(len(self.faults_of(f"```console\n{text}```\n")), 1, text)

    def test_a_command_in_a_table_that_fails_is_found(self):
        self.assertEqual(len(self.faults_of("| a | `mesher mesh none.poly -o a.vtu` |\n")), 1)
        self.assertEqual(self.faults_of("| a | `mesher gen uniform --n 9 -o a.node` |\n"), [])

    def test_files_are_there(self):
        self.assertEqual(self.faults_of("<!-- file: a -->\n```\n12\n```\n"
                                        "<!-- file: b from LICENSE -->\n\n"
                                        "```console\n$ cat a; head -c 3 b; echo\n12\nMIT\n```\n"), [])
        self.assertEqual(self.faults_of("<!-- file: in/folders/a -->\n```\n12\n```\n"
                                        "```console\n$ cat in/folders/a\n12\n```\n"), [])

    def test_a_block_that_needs_a_program_is_left_out_without_it(self):
        block = "```console\n$ echo a\nb\n```\n"
        self.assertEqual(self.faults_of("<!-- needs: no-such-program -->\n" + block), [])
        self.assertEqual(len(self.faults_of("<!-- needs: sh -->\n" + block)), 1)


class Links(unittest.TestCase):
    def test_a_broken_link_ends_the_build(self):
        page = pathlib.Path("mesher/docs/page.md")
        self.assertEqual(build.linked(page, "[a](start.md#install) [b](../python)"),
                         "[a](start.md#install) [b](../python/README.md)")
        self.assertEqual(build.linked(page, "`[a](nothing.md)`"), "`[a](nothing.md)`")
        with self.assertRaises(SystemExit):
            build.linked(page, "[a](nothing.md)")

    def test_links_of_all_documents(self):
        for path in build.listed():
            if path.suffix == ".md" and "site" not in path.parts:
                build.linked(path, (ROOT / path).read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
