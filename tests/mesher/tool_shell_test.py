#!/usr/bin/env python3
"""The completion scripts and manual pages that the tools print: each script is read by its shell,
and completes there; the pages have every option of the help.

    tool_shell_test.py MESHER TRACES
"""
import os
import pathlib
import pty
import re
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

TOOLS = {}


def output(*command, **options):
    process = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=60,
                             stdin=subprocess.DEVNULL, **options)
    if process.returncode != 0 or process.stderr:
        raise AssertionError(f"{command}: {process.returncode}\n{process.stdout}{process.stderr}")
    return process.stdout


def commands(tool):
    """The subcommands that the help lists."""
    listed = output(TOOLS[tool], "--help").split("Subcommands:\n")[1].split("\n\n")[0]
    return re.findall(r"^  (\w+)", listed, re.M)


def options(tool, command):
    """Names of the options of a command, by its help."""
    listed = output(TOOLS[tool], command, "--help").split("Options:\n")[1].split("\n\n")[0]
    heads = re.findall(r"^  (-\S+)", listed, re.M)
    return [name for head in heads for name in head.split(",")]


class Bash(unittest.TestCase):
    def complete(self, *words, tool="mesher", cwd=None):
        """What bash offers for the last of the words."""
        program = (f"source <({TOOLS[tool]} completion bash); COMP_WORDS=(\"$@\"); "
                   "COMP_CWORD=$(($# - 1)); _" + tool + "; printf '%s\\n' \"${COMPREPLY[@]}\"")
        found = output("bash", "--norc", "-c", program, "bash", tool, *words, cwd=cwd)
        return found.split("\n")[:-1] if found != "\n" else []

    def test_parses(self):
        for tool in TOOLS.values():
            script = output(tool, "completion", "bash")
            output("bash", "-n", "-c", script)

    def test_commands(self):
        for tool in TOOLS:
            found = self.complete("", tool=tool)
            self.assertEqual(set(commands(tool)) - set(found), set())
        self.assertEqual(self.complete("me"), ["mesh"])

    def test_every_option_of_the_help(self):
        for tool in TOOLS:
            for command in commands(tool):
                with self.subTest(tool=tool, command=command):
                    found = self.complete(command, "-", tool=tool)
                    self.assertEqual(sorted(found), sorted(options(tool, command)))

    def test_values(self):
        self.assertEqual(self.complete("mesh", "--rule", ""), ["radius-edge", "voronoi-aspect"])
        self.assertEqual(self.complete("mesh", "a.poly", "--rule", "v"), ["voronoi-aspect"])
        self.assertEqual(self.complete("mesh", "--rule", "=", "v"), ["voronoi-aspect"])
        self.assertEqual(self.complete("mesh", "--rule", "="), ["radius-edge", "voronoi-aspect"])
        self.assertIn("uniform", self.complete("gen", "u"))
        self.assertIn("edit-distance-in-a-band", self.complete("example", "e", tool="traces"))
        self.assertEqual(self.complete("mesh", "--rho", ""), [])
        self.assertEqual(self.complete("completion", "f"), ["fish"])

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("lake.poly", "a lake.poly", "other.node"):
                pathlib.Path(folder, name).touch()
            self.assertEqual(sorted(self.complete("mesh", "", cwd=folder)),
                             ["a lake.poly", "lake.poly", "other.node"])
            self.assertEqual(self.complete("mesh", "x.poly", "-o", "ot", cwd=folder),
                             ["other.node"])
            self.assertEqual(self.complete("check", "--input", "la", cwd=folder), ["lake.poly"])
            self.assertEqual(self.complete("show", "o", tool="traces", cwd=folder),
                             ["other.node"])


@unittest.skipUnless(shutil.which("fish"), "fish is not there")
class Fish(unittest.TestCase):
    def complete(self, line, tool="mesher", cwd=None):
        with tempfile.TemporaryDirectory() as home:
            found = output("fish", "--no-config", "-c", f"{TOOLS[tool]} completion fish | source; "
                           f"complete -C '{line}'", cwd=cwd,
                           env={**os.environ, "HOME": home, "XDG_CONFIG_HOME": home,
                                "XDG_DATA_HOME": home})
        return [text.split("\t")[0] for text in found.splitlines()]

    def test_parses(self):
        for tool in TOOLS.values():
            with tempfile.NamedTemporaryFile("w", suffix=".fish") as script:
                script.write(output(tool, "completion", "fish"))
                script.flush()
                output("fish", "--no-execute", script.name)

    def test_completes(self):
        for tool in TOOLS:
            self.assertEqual(set(commands(tool)) - set(self.complete(tool + " ", tool)), set())
        self.assertEqual(self.complete("mesher mesh --rule "), ["radius-edge", "voronoi-aspect"])
        self.assertEqual(self.complete("mesher mesh --max-v"), ["--max-vertices", "--max-volume"])
        self.assertIn("spiral", self.complete("mesher gen s"))

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "lake.poly").touch()
            self.assertEqual(self.complete("mesher mesh la", cwd=folder), ["lake.poly"])
            self.assertEqual(self.complete("mesher mesh x -o la", cwd=folder), ["lake.poly"])


# A shell on a terminal of its own, for zsh completes nowhere else. It says when it takes keys, and
# what the line is when control-X is pressed.
ZSH = r"""PS1=; PROMPT_EOL_MARK=; fpath=({folder} $fpath); autoload -U compinit; compinit -u -D
takes_keys() {{ print -r -- "<""keys>" }}; zle -N zle-line-init takes_keys
shown() {{ print -r -- "<${{BUFFER}}>" }}; zle -N shown; bindkey "^X" shown
"""


class Terminal:
    def __init__(self, folder):
        self.process, self.terminal = pty.fork()
        if self.process == 0:
            os.chdir(folder)
            os.execvpe("zsh", ["zsh", "-f", "-i"], {**os.environ, "HOME": str(folder), "TERM": "dumb",
                                                    "COLUMNS": "200"})
        self.seen = ""

    def close(self):
        os.kill(self.process, signal.SIGKILL)
        os.waitpid(self.process, 0)
        os.close(self.terminal)

    def send(self, keys):
        os.write(self.terminal, keys.encode())

    def wait(self, pattern, seconds):
        """What matches the pattern in the output, or None if it does not come."""
        until = time.monotonic() + seconds
        while not (found := re.search(pattern, self.seen)):
            left = until - time.monotonic()
            if left <= 0 or not select.select([self.terminal], [], [], left)[0]:
                return None
            self.seen += os.read(self.terminal, 65536).decode(errors="replace")
        self.seen = self.seen[found.end():]
        return found


@unittest.skipUnless(shutil.which("zsh"), "zsh is not there")
class Zsh(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name, tool in TOOLS.items():
            (self.folder / f"_{name}").write_text(output(tool, "completion", "zsh"))

    def becomes(self, line):
        """The line after Tab."""
        terminal = Terminal(self.folder)
        try:
            terminal.send(ZSH.format(folder=self.folder) + "print re''ady\n")
            self.assertTrue(terminal.wait(r"ready\r?\n", 60), "zsh is not ready")
            self.assertTrue(terminal.wait("<keys>", 60), "zsh takes no keys")
            terminal.send(line + "\t")
            for _ in range(30):  # a key that is pressed while zsh completes may be lost
                terminal.send("\x18")
                found = terminal.wait("<((?:mesher|traces) [^<>]*)>", 2)
                if found and found[1].rstrip() != line:
                    return found[1].rstrip()
            return line
        finally:
            terminal.close()

    def test_parses(self):
        for name in TOOLS:
            output("zsh", "-n", str(self.folder / f"_{name}"))

    def test_completes(self):
        self.assertEqual(self.becomes("mesher me"), "mesher mesh")
        self.assertEqual(self.becomes("mesher mesh --rul"), "mesher mesh --rule=")
        self.assertEqual(self.becomes("mesher mesh --rule=vor"),
                         "mesher mesh --rule=voronoi-aspect")
        self.assertEqual(self.becomes("mesher gen sph"), "mesher gen sphere")
        self.assertEqual(self.becomes("traces stab"), "traces stability")

    def test_files(self):
        (self.folder / "lake.poly").touch()
        self.assertEqual(self.becomes("mesher mesh lak"), "mesher mesh lake.poly")
        self.assertEqual(self.becomes("mesher mesh x -o lak"), "mesher mesh x -o lake.poly")


class Manual(unittest.TestCase):
    def test_has_commands_options_and_examples(self):
        for tool in TOOLS:
            page = output(TOOLS[tool], "manual").replace("\\-", "-")
            for command in commands(tool):
                section = re.search(rf'^\.SS "{tool} {command} .*?(?=^\.SS|\Z)', page, re.M | re.S)
                self.assertTrue(section, command)
                for option in options(tool, command):
                    self.assertIn(f"\\fB{option}\\fR", section[0])
        page = output(TOOLS["mesher"], "manual").replace("\\-", "-")
        self.assertIn("\n  mesher mesh lake.poly -o lake.1.node -o lake.svg\n", page)
        self.assertIn("Exit codes: 0 ok", page)

    @unittest.skipUnless(shutil.which("man"), "man is not there")
    def test_man_formats_it_without_warnings(self):
        for tool in TOOLS:
            with tempfile.NamedTemporaryFile("w", suffix=".1") as page:
                page.write(output(TOOLS[tool], "manual"))
                page.flush()
                text = output("man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", page.name,
                              env={**os.environ, "MANWIDTH": "80", "MANPAGER": "cat"})
            text = re.sub(".\b", "", text)  # what is bold is struck twice
            for part in ("NAME", "SYNOPSIS", "COMMANDS"):
                self.assertIn(part, text)


if __name__ == "__main__":
    for tool_name in ("mesher", "traces"):
        TOOLS[tool_name] = os.path.abspath(sys.argv.pop(1))
    unittest.main()
