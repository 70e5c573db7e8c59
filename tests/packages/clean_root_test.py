#!/usr/bin/env python3
"""The Debian packages in a clean root: a fresh Debian 12, where they are installed, used and removed.

    clean_root_test.py PACKAGES [--make] [--pip] [--root FOLDER]

PACKAGES is the folder in which ./run package leaves them; with --make it is run first. With --pip also what the README of
livemesh says: `pip install` of the sources, without a network, and its wheel where no compiler is.
--root keeps the root. Needs root, debootstrap and a mirror of Debian; skipped (77) without.
"""
import argparse
import hashlib
import os
import pathlib
import re
import resource
import shutil
import stat
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
NAMES = ("liblivemesh1", "libmesher-dev", "mesher", "python3-livemesh")
BUILD = ["g++", "cmake", "make"]
KEPT = ("proc", "sys", "dev", "tmp", "run", "var/cache", "var/log", "var/lib/apt", "var/lib/dpkg",
        "etc/ld.so.cache", "root")
USED = {}


class Chroot:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)

    def run(self, *command, cwd="/", offline=False):
        """What a command prints; it must succeed."""
        # /proc goes with the command.
        mount = 'mount -t proc proc "$0/proc" && exec chroot "$0" "$@"'
        wrapped = ["unshare", "--mount", *(["--net"] if offline else []), "sh", "-c", mount,
                   str(self.folder), "/bin/sh", "-c", f"cd {cwd} && exec \"$@\"", "sh", *command]
        process = subprocess.run(wrapped, capture_output=True, text=True, stdin=subprocess.DEVNULL,
                                 env={"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "LC_ALL": "C.UTF-8",
                                      "HOME": "/root", "DEBIAN_FRONTEND": "noninteractive"})
        if process.returncode != 0:
            sys.exit(f"{' '.join(command)}: {process.returncode}\n"
                     f"{process.stdout[-4000:]}{process.stderr[-4000:]}")
        return process.stdout

    def apt(self, *arguments):
        return self.run("apt-get", "-qq", "-y", "--no-install-recommends", *arguments)

    def has(self, program):
        found = subprocess.run(["chroot", str(self.folder), "/bin/sh", "-c", "command -v " + program],
                               capture_output=True, check=False)
        return found.returncode == 0

    def copy(self, source, target):
        target = self.folder / target.lstrip("/")
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, target)

    def files(self):
        """What is there, by path: a digest, or where a link leads."""
        found = {}
        for folder, folders, names in os.walk(self.folder):
            here = pathlib.Path(folder).relative_to(self.folder)
            folders[:] = [f for f in folders if str(here / f) not in KEPT]
            for name in names + folders:
                path = self.folder / here / name
                if str(here / name) in KEPT:
                    continue
                mode = path.lstat().st_mode
                if stat.S_ISLNK(mode):
                    found[str(here / name)] = os.readlink(path)
                elif stat.S_ISREG(mode):
                    found[str(here / name)] = hashlib.sha256(path.read_bytes()).hexdigest()
                else:
                    found[str(here / name)] = "folder"
        return found


def check(condition, message):
    if not condition:
        sys.exit(message)


def block(document, language):
    text = (ROOT / document).read_text(encoding="utf-8")
    return re.search(rf"^```{language}\n(.*?)^```", text, re.M | re.S)[1]


def use_tools(root):
    root.run("mesher", "mesh", "lake.poly", "--min-angle", "28", "-o", "lake.vtu", "-o", "lake.svg",
             cwd="/trial")
    root.run("mesher", "check", "lake.vtu", "--input", "lake.poly", "--rho", "1.066", cwd="/trial")
    root.run("traces", "example", "quicksort", "--n", "100", "-o", "q.trace", cwd="/trial")
    root.run("traces", "audit", "q.trace", cwd="/trial")
    for page in ("mesher", "traces"):
        check((root.folder / f"usr/share/man/man1/{page}.1.gz").exists(), f"no page of {page}")
    completed = root.run("bash", "-c", "source /usr/share/bash-completion/completions/mesher; "
                         "COMP_WORDS=(mesher mesh --rule v); COMP_CWORD=3; _mesher; "
                         "echo \"${COMPREPLY[@]}\"")
    check(completed == "voronoi-aspect\n", f"bash completes {completed!r}")


def use_python(root, python="python3"):
    (root.folder / "trial/first.py").write_text(block("README.md", "python"))
    root.run(python, "first.py", cwd="/trial")
    where = root.run(python, "-c", "import livemesh; print(livemesh.__file__, livemesh.__version__)")
    if root.has("mesher"):
        root.run("mesher", "check", "lake.vtu", "--input", "lake.poly", "--rho", "1.066", cwd="/trial")
    return where


def use_libraries(root):
    for file in (ROOT / "tests/consumer").iterdir():
        root.copy(file, f"/trial/consumer/{file.name}")
    root.run("cmake", "-S", "consumer", "-B", "consumer/build", "-DCMAKE_BUILD_TYPE=Release",
             cwd="/trial")
    root.run("cmake", "--build", "consumer/build", cwd="/trial")
    for program in ("use_sac", "use_mesher"):
        root.run(f"consumer/build/{program}", cwd="/trial")
    (root.folder / "trial/program.c").write_text(block("mesher/c/README.md", "c"))
    root.run("gcc", "-std=c99", "program.c", "-o", "program", "-llivemesh", cwd="/trial")
    said = root.run("./program", cwd="/trial")
    check(re.fullmatch(r"\d+ triangles\n", said), f"the C program says {said!r}")


def install_and_use(root, packages):
    """Tools and Python where nothing but what they need is."""
    for package in packages.values():
        root.copy(package, f"/debs/{package.name}")
    debs = {name: f"/debs/{package.name}" for name, package in packages.items()}
    root.apt("update")
    root.apt("install", debs["mesher"])
    use_tools(root)
    check(not root.has("python3"), "the tools want python3")
    root.apt("install", debs["liblivemesh1"], debs["python3-livemesh"])
    where = use_python(root)
    check("/usr/lib/python3/dist-packages/livemesh/" in where, f"livemesh is {where}")
    check(not root.has("cc") and not root.has("cmake"), "packages bring a compiler")
    root.apt("purge", *(name for name in NAMES if name != "libmesher-dev"))
    print("tools and Python, without a compiler: used and removed")
    root.apt("install", *BUILD, "zlib1g-dev", "python3-numpy")
    before = root.files()
    root.apt("install", *debs.values())
    use_tools(root)
    use_python(root)
    use_libraries(root)
    root.apt("purge", *NAMES)
    after = root.files()
    ours = {path for path in after if path.split("/")[0] in ("trial", "debs")}
    changed = {path for path in before.keys() | after.keys()
               if before.get(path) != after.get(path)} - ours
    check(not changed, f"removed, but not as before: {sorted(changed)[:20]}")
    left = [path for path in after.keys() - ours if re.search("livemesh|mesher", path)]
    check(not left, f"left: {left}")
    print(f"all four, with a compiler: used and removed; {len(after)} paths as before")


def sources(root):
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True,
                            check=True).stdout.split("\n")[:-1]
    for name in listed:
        if name.startswith(("sac/", "mesher/", "traces/")) or "/" not in name:
            root.copy(ROOT / name, f"/source/{name}")


def pip(root):
    """As the README of livemesh says; then the wheel, where no compiler is."""
    listed = re.search(r"`apt install ([^`]*)`", (ROOT / "mesher/python/README.md").read_text())
    needed = listed[1].split()
    root.apt("install", "make", *needed)  # make or ninja
    sources(root)
    root.run("python3", "-m", "venv", "--system-site-packages", "/venv")
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    root.run("/venv/bin/pip", "install", "./mesher/python", cwd="/source", offline=True)
    use_python(root, "/venv/bin/python")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    print(f"pip install and the first example: {seconds:.0f} s of processor, "
          f"{time.monotonic() - start:.0f} s", flush=True)
    check(seconds < 600, "above ten minutes of processor")
    library = next((root.folder / "venv").rglob("liblivemesh.so"))
    root.copy(library, "/trial/liblivemesh.so")
    root.run("sh", "-c", "cd /source && LIVEMESH_LIBRARY=/trial/liblivemesh.so /venv/bin/pip wheel "
             "--no-deps -w /trial ./mesher/python", offline=True)
    root.apt("purge", *BUILD, *needed, "cpp", "gcc", "binutils")
    root.apt("autoremove", "--purge")
    root.apt("install", "python3-venv", "python3-numpy")
    check(not any(root.has(p) for p in ("cc", "c++", "gcc", "g++", "cmake")), "a compiler is left")
    root.run("python3", "-m", "venv", "--system-site-packages", "/other")
    (wheel,) = (root.folder / "trial").glob("*.whl")
    root.run("/other/bin/pip", "install", f"/trial/{wheel.name}", offline=True)
    where = use_python(root, "/other/bin/python")
    check(where.startswith("/other/"), f"livemesh is {where}")
    print(f"{wheel.name}: installed without a compiler and a network, and used")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("packages", type=pathlib.Path)
    parser.add_argument("--make", action="store_true")
    parser.add_argument("--pip", action="store_true")
    parser.add_argument("--root", type=pathlib.Path)
    args = parser.parse_args()
    if os.geteuid() != 0 or not shutil.which("debootstrap"):
        print("needs root and debootstrap")
        return 77
    if args.make:
        subprocess.run([str(ROOT / "run"), "package"], check=True)
    packages = {name: file for name in NAMES for file in args.packages.glob(f"{name}_*.deb")}
    check(len(packages) == len(NAMES), f"no packages in {args.packages}: ./run package makes them")
    with tempfile.TemporaryDirectory() as scratch:
        folder = args.root or pathlib.Path(scratch, "root")
        if not (folder / "etc/debian_version").exists():
            made = subprocess.run(["debootstrap", "--variant=minbase", "bookworm", str(folder)],
                                  capture_output=True, text=True, check=False)
            if made.returncode != 0:
                print(f"debootstrap: {made.stdout[-2000:]}{made.stderr[-2000:]}")
                return 77
        root = Chroot(folder)
        root.copy(ROOT / "tests/data/great_lakes.poly", "/trial/lake.poly")
        install_and_use(root, packages)
        if args.pip:
            pip(root)
    return 0


if __name__ == "__main__":
    sys.exit(main())
