#!/usr/bin/env python3
"""The programs in the documents compile: every block of C++, or of C
that is C++ too, that includes something.

    document_examples.py COMPILER ROOT INCLUDE_DIRECTORY... -- DOCUMENT...
"""
import pathlib
import re
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```(?:cpp|c)\n(.*?)^```", re.MULTILINE | re.DOTALL)


def programs(document):
    text = document.read_text(encoding="utf-8")
    for match in BLOCK.finditer(text):
        if "#include" in match[1]:
            yield text.count("\n", 0, match.start()) + 1, match[1]


def compiles(compiler, includes, program):
    with tempfile.NamedTemporaryFile("w", suffix=".cpp") as source:
        source.write(program)
        source.flush()
        made = subprocess.run(
            [compiler, "-std=c++20", "-fsyntax-only", *[f"-I{i}" for i in includes], source.name],
            capture_output=True, text=True, check=False)
    return made.returncode == 0, made.stderr


def main(arguments):
    split = arguments.index("--")
    compiler, root, *includes = arguments[:split]
    failures = count = 0
    for name in arguments[split + 1:]:
        for line, program in programs(pathlib.Path(root) / name):
            count += 1
            good, errors = compiles(compiler, includes, program)
            if good:
                continue
            failures += 1
            print(f"{name}:{line}: does not compile\n{errors[:2000]}")
    print(f"{count} programs, {failures} do not compile")
    return 0 if failures == 0 and count > 0 else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
