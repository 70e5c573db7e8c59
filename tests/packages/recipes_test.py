#!/usr/bin/env python3
"""The recipes of packages can be read, and all places have the version of the project."""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGES = ROOT / "mesher/packages"


def version_in(path, pattern):
    found = re.search(pattern, (ROOT / path).read_text(encoding="utf-8"), re.M)
    return found[1] if found else "none"


def main():
    project = version_in("CMakeLists.txt", r"^project\(.* VERSION ([\d.]+)")
    found = {
        "mesher/python/pyproject.toml": r'^version = "(.*)"',
        "mesher/packages/vcpkg/mesher/vcpkg.json": r'"version": "(.*)"',
        "mesher/packages/conan/conanfile.py": r'^    version = "(.*)"',
        "mesher/packages/conda/meta.yaml": r'^  version: "(.*)"',
        "mesher/c/include/livemesh.h": r'^/\* "([\d.]+)"\. \*/',
        ".github/CHANGELOG.md": r"^## ([\d.]+)",
    }
    wrong = [f"{path} has the version {version}, not {project}" for path, pattern in found.items()
             if (version := version_in(path, pattern)) != project]
    json.loads((PACKAGES / "vcpkg/mesher/vcpkg.json").read_text(encoding="utf-8"))
    recipe = PACKAGES / "conan/conanfile.py"
    compile(recipe.read_text(encoding="utf-8"), str(recipe), "exec")
    for path in ("vcpkg/mesher/portfile.cmake", "conan/conanfile.py", "conda/meta.yaml"):
        if "ntried" not in (PACKAGES / path).read_text(encoding="utf-8"):
            wrong.append(f"{path} does not say that it is untried")
    print(*wrong, sep="\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
