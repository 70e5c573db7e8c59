#!/usr/bin/env python3
"""Journals of `mesher edit`: what a kill, a full disk or damage leaves is resumed to the same bytes,
or refused.

    tool_journal_test.py TOOL SCRATCH [KILLS [DISKS [SEED]]]
"""

import os
import random
import resource
import shutil
import signal
import struct
import subprocess
import sys
import time

from files import contents, write

FIRST_LINE = b"mesher journal 1\n"
HEAD = 24


def run(*arguments, limit=None, check=None):
    """The tool: exit code, standard error. `limit`: bytes that a file may have."""
    def set_limit():
        if limit is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
    done = subprocess.run([TOOL, *arguments], capture_output=True, text=True, preexec_fn=set_limit)
    if check is not None and done.returncode != check:
        raise AssertionError(f"{arguments}: exit {done.returncode}, expected {check}: {done.stderr}")
    return done.returncode, done.stderr


def records(journal):
    """Where each record starts, and the end."""
    at, offsets = len(FIRST_LINE), []
    while at < len(journal):
        offsets.append(at)
        at += HEAD + struct.unpack_from("<I", journal, at + 4)[0]
    return offsets + [at]


def random_script(rng, updates):
    """Batches of edits of points and of lines between new points, in the unit square."""
    points, lines, rows, new, batches = {}, {}, [], 1000, []

    def free(p):
        return all(abs(p[0] - q[0]) + abs(p[1] - q[1]) > 1e-4 for q in points.values())

    def edit():
        nonlocal new
        ends = {p for line in lines.values() for p in line}
        loose = [p for p in points if p not in ends]
        kind = rng.random()
        if kind < 0.35 or not loose:
            p = (rng.random(), rng.random())
            if not free(p):
                return None
            new += 1
            points[new] = p
            marker = f" marker {rng.randrange(5)}" if rng.random() < 0.3 else ""
            return f"+point {new} {p[0]!r} {p[1]!r}{marker}"
        if kind < 0.6:
            p, moved = rng.choice(loose), (rng.random(), rng.random())
            if not free(moved):
                return None
            points[p] = moved
            return f"move {p} {moved[0]!r} {moved[1]!r}"
        if kind < 0.75:
            p = rng.choice(loose)
            del points[p]
            return f"-point {p}"
        if kind < 0.85 and lines or len(rows) > 40:
            if not lines:
                return None
            line = rng.choice(sorted(lines))
            del lines[line]
            return f"-segment {line}"
        # A short segment on its own row, so that none crosses another.
        new += 1
        y = 1.25 + len(rows) / 16
        rows.append(y)
        a, b = new * 2 + 100000, new * 2 + 100001
        lines[new] = (a, b)
        points[a], points[b] = (0.25, y), (0.75, y)
        return [f"+point {a} 0.25 {y!r}", f"+point {b} 0.75 {y!r}",
                f"+segment {new} {a} {b} marker 3"]

    while len(batches) < updates:
        if rng.random() < 0.02:
            batches.append([f"limit size {rng.choice([0.25, 0.3, 0.5])} in 0 0 0.5 0.5"])
            continue
        if rng.random() < 0.01:
            batches.append(["limit none"])
            continue
        edits = edit()
        if edits is not None:
            batches.append(edits if isinstance(edits, list) else [edits])
    return batches


def text_of(batches):
    text = ""
    for batch in batches:
        text += batch[0] + "\n" if len(batch) == 1 else "\n".join(["begin", *batch, "commit"]) + "\n"
    return text


def write_cube(path):
    corners = ["0 0 0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "0 1 1"]
    faces = ["1 2 3 4", "5 6 7 8", "1 2 6 5", "2 3 7 6", "3 4 8 7", "4 1 5 8"]
    write(path, ("8 3 0 0\n" + "".join(f"{i + 1} {p}\n" for i, p in enumerate(corners)) + "6 1\n" +
                 "".join(f"1 0 {i + 1}\n4 {f}\n" for i, f in enumerate(faces)) + "0\n0\n").encode())


def random_space_script(rng, updates):
    """Batches of edits of that cube: in cells of their own, points come, move and go, and segments and
    polygons with their points; its lid is moved."""
    cells = [(x, y, z) for x in range(4) for y in range(4) for z in range(3)]
    held, new, batches = {}, 100, []  # cell -> what is to go, and a point that may move

    def place(cell, *parts):
        return " ".join(repr((c + p) / 4) for c, p in zip(cell, parts))

    def any_parts():
        return [rng.uniform(.25, .75) for _ in range(3)]

    while len(batches) < updates:
        kind, cell = rng.random(), rng.choice(cells)
        if kind < 0.1:  # all corners of a face
            height = 1 + rng.randrange(1, 64) / 128
            lid = {5: "0 0", 6: "1 0", 7: "1 1", 8: "0 1"}
            batches.append([f"move {p} {at} {height!r}" for p, at in lid.items()])
        elif kind < 0.13:
            batches.append([f"limit size {rng.choice([0.4, 0.5])} in 0 0 0 0.5 0.5 0.5"])
        elif cell in held:
            gone, point = held[cell]
            if point is not None and rng.random() < 0.5:
                batches.append([f"move {point} {place(cell, *any_parts())}"])
            else:
                batches.append(gone)
                del held[cell]
        else:
            new += 10
            if kind < 0.5:
                batches.append([f"+point {new} {place(cell, *any_parts())} marker {rng.randrange(3)}"])
                held[cell] = [f"-point {new}"], new
                continue
            corners = [(.25, .25), (.75, .25), (.75, .75), (.25, .75)][:2 if kind < 0.7 else 4]
            z, ids = rng.uniform(.3, .7), [str(new + i) for i in range(len(corners))]
            what = "segment" if len(ids) == 2 else "polygon"
            batches.append([f"+point {i} {place(cell, *at, z)}" for i, at in zip(ids, corners)] +
                           [f"+{what} {new} {' '.join(ids)} marker {rng.randrange(4)}"])
            held[cell] = [f"-{what} {new}"] + [f"-point {i}" for i in ids], None
    return batches


class Case:
    """An input, a script, and the bytes after it."""

    BASE = ("edit", "journal_input.node", "--domain", "0", "0", "4", "4")
    SCRIPT = staticmethod(random_script)

    def __init__(self, name, seed, updates):
        self.rng = random.Random(seed)
        self.name = name
        self.script, self.journal = f"{name}.txt", f"{name}.journal"
        self.out, self.wanted = f"{name}.out.vtu", f"{name}.wanted.vtu"
        self.batches = self.SCRIPT(self.rng, updates)
        write(self.script, text_of(self.batches).encode())
        start = time.monotonic()
        run(*self.arguments(self.wanted), check=0)
        self.seconds = time.monotonic() - start

    def arguments(self, out, *more):
        return (*self.BASE, "--script", self.script, "-o", out, "--quiet", *more)

    def with_journal(self, *more):
        return self.arguments(self.out, "--journal", self.journal, *more)

    def forget(self):
        for path in (self.journal, self.journal + ".new", self.out):
            if os.path.exists(path):
                os.remove(path)

    def require_resumed(self, *more):
        run(*self.with_journal(*more), check=0)
        assert contents(self.out) == contents(self.wanted), f"{self.name}: other bytes after resuming"
        left = [f for f in os.listdir(".") if f.endswith(".part")]
        for part in left:
            os.remove(part)  # of outputs: a killed process cannot remove them


class SpaceCase(Case):
    """The same with a cube in space."""

    BASE = ("edit", "journal_cube.poly", "--domain", "0", "0", "0", "2", "2", "2")
    SCRIPT = staticmethod(random_space_script)


def killed(case, kills):
    """Kills at random moments, some of them of one that has resumed; the journal may be compacted.
    What was resumed has the bytes of the whole script at the end."""
    resumed = 0
    for kill in range(kills):
        if kill and kill % 100 == 0:
            print(f"{kill} kills", flush=True)
        if case.rng.random() < 0.7:
            case.forget()
        more = case.rng.choice([(), ("--journal-sync",), ("--journal-limit", "2000")])
        process = subprocess.Popen([TOOL, *case.with_journal(*more)], stderr=subprocess.DEVNULL)
        time.sleep(case.rng.random() * case.seconds * 1.2)
        process.send_signal(signal.SIGKILL)
        process.wait()
        if os.path.exists(case.journal):
            resumed += 1
        if case.rng.random() < 0.3:  # what is resumed alone is a prefix of the script
            run(*case.BASE, "--journal", case.journal, "-o", case.out, "--quiet", check=0)
        case.require_resumed(*more)
    assert resumed > kills // 4, f"only {resumed} of {kills} kills left a journal"


def full_disk(case, times):
    """A file may not grow beyond a random length; then it may."""
    whole = None
    refused = 0
    for _ in range(times):
        case.forget()
        if whole is None:
            run(*case.with_journal(), check=0)
            whole = len(contents(case.journal))
            case.forget()
        limit = case.rng.randrange(0, whole)
        code, said = run(*case.with_journal(), limit=limit)
        assert code == 2 and "cannot_write" in said, (limit, code, said)
        assert not os.path.exists(case.out)
        if os.path.exists(case.journal):
            refused += 1
            journal = contents(case.journal)
            ends = records(journal)
            assert ends[-1] == len(journal) <= limit, "a part of a record was left"
            assert f"update {len(ends) - 1} is not in the journal" in said, said
        case.require_resumed()
    assert refused > times // 2


def full_tmpfs(case, times):
    """The same on a disk that is full, where one can be made."""
    disk = os.path.abspath("journal_disk")
    os.makedirs(disk, exist_ok=True)
    mount = ["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", disk]
    if os.geteuid() != 0 or subprocess.run(mount, capture_output=True).returncode != 0:
        return False
    try:
        for _ in range(times):
            case.forget()
            filler, at = os.path.join(disk, "filler"), os.path.join(disk, "j")
            for path in (filler, at):
                if os.path.exists(path):
                    os.remove(path)
            write(filler, bytes(65536 - 4096 * case.rng.choice([1, 2, 3])))
            arguments = case.arguments(case.out, "--journal", at)
            code, said = run(*arguments)
            assert code == 2 and "No space left on device" in said, (code, said)
            os.remove(filler)
            run(*arguments, check=0)
            assert contents(case.out) == contents(case.wanted)
    finally:
        subprocess.run(["umount", disk], check=True)
    return True


def damaged():
    """Every prefix of a journal, and every byte of one changed."""
    case = Case("damaged", 5, 6)
    case.forget()
    run(*case.with_journal(), check=0)
    journal = contents(case.journal)
    ends = records(journal)
    wanted = []
    for k in range(len(case.batches) + 1):
        write("prefix.txt", text_of(case.batches[:k]).encode())
        run("edit", "journal_input.node", "--domain", "0", "0", "4", "4", "--script", "prefix.txt",
            "-o", "prefix.vtu", "--quiet", check=0)
        wanted.append(contents("prefix.vtu"))

    def resume():
        if os.path.exists(case.out):
            os.remove(case.out)
        return run("edit", "journal_input.node", "--domain", "0", "0", "4", "4", "--journal",
                   case.journal, "-o", case.out)

    for length in range(len(journal) + 1):
        write(case.journal, journal[:length])
        code, said = resume()
        whole = sum(end <= length for end in ends[1:])
        assert code == 0, (length, said)
        assert contents(case.out) == wanted[max(whole - 1, 0)], length
        torn = length not in (0, *ends[1:])
        assert ("are removed" in said) == torn, (length, said)
        assert contents(case.journal) == (journal[:ends[max(whole, 1)]]), length
    for at in range(0, len(journal)):
        changed = bytearray(journal)
        changed[at] ^= 1 << case.rng.randrange(8)
        write(case.journal, changed)
        code, said = resume()
        if at >= ends[-2]:  # what a power cut may leave: the last record goes
            assert code == 0 and "are removed" in said, (at, said)
            assert contents(case.out) == wanted[-2], at
        else:
            assert code in (2, 3), (at, said)
            record = max(end for end in [0, *ends] if end <= at)
            if record > 0:
                assert f"{case.journal}: error[bad_syntax]: the journal is damaged at byte {record}" \
                    in said, (at, said)
            assert contents(case.journal) == changed
    # Records that are whole, but not in order.
    write(case.journal, journal[:ends[2]] + journal[ends[3]:])
    code, said = resume()
    assert code == 3 and f"damaged at byte {ends[2]}" in said, said


def refused():
    """What is not this run's journal."""
    case = Case("refused", 6, 5)
    case.forget()
    base = ["edit", "journal_input.node", "--domain", "0", "0", "4", "4"]
    with_journal = ["--journal", case.journal]
    run(*case.with_journal(), check=0)

    def refuse(code, text, *arguments):
        before = contents(case.journal)
        got, said = run(*arguments, "-o", "none.vtu")
        assert got == code and text in said, (arguments, got, said)
        assert not os.path.exists("none.vtu") and contents(case.journal) == before

    refuse(2, "rho was 1.4142, here it is 2", *base, "--rho", "2", *with_journal)
    refuse(2, "domain was 0 0 4 4, here it is 0 0 8 8", *base[:5], "8", "8", *with_journal)
    refuse(2, "extent was enclosed", *base, "--box", *with_journal)
    refuse(2, "largest was 0", *base, "--max-area", "0.5", *with_journal)
    lines = contents("journal_input.node").replace(b"0.", b"0.0", 1)
    write("journal_other.node", lines)
    refuse(2, "belongs to another input", "edit", "journal_other.node", *base[2:], *with_journal)
    write("in_space.node", b"2 3 0 0\n1 0 0 0\n2 1 1 1\n")
    space = ["edit", "in_space.node", "--journal", "in_space.journal", "--min-dihedral"]
    run(*space, "12", "-o", "in_space.vtu", check=0)
    refuse(2, "min-dihedral was 12, here it is 10", *space, "10")
    write("other.txt", b"+point 7777 0.125 0.125\n")
    refuse(2, "does not begin with the 5 updates", *base, *with_journal, "--script", "other.txt")
    write("not.journal", b"+point 1 0 0\n")
    refuse(3, "not a journal", *base, "--journal", "not.journal")
    write("newer.journal", b"mesher journal 2\n")
    refuse(3, "a journal of version 2; this program reads version 1", *base, "--journal",
           "newer.journal")
    refuse(2, "the journal cannot be the input", *base, "--journal", "journal_input.node")
    refuse(2, "the journal cannot be the script", *base, "--journal", "other.txt", "--script",
           "other.txt")
    refuse(2, "need --journal", *base, "--script", "other.txt", "--journal-sync")
    refuse(2, "cannot be written", *base, "--journal", "no_folder/j")
    # Of two processes the second is refused.
    os.mkfifo("waits.txt")
    first = subprocess.Popen([TOOL, *base, *with_journal, "--journal-append", "--script",
                              "waits.txt", "-o", "first.vtu", "--quiet"])
    pipe = open("waits.txt", "w")  # opens when the first one reads
    refuse(2, "in use by another process", *base, *with_journal)
    pipe.write("+point 7777 0.125 0.125\n")
    pipe.close()
    assert first.wait() == 0
    write("both.txt", contents(case.script) + b"+point 7777 0.125 0.125\n")
    run(*base, "--script", "both.txt", "-o", "second.vtu", "--quiet", check=0)
    assert contents("first.vtu") == contents("second.vtu")


def backgrounds():
    """A background that has changed is refused; one in another folder is found."""
    os.makedirs("folder with blank", exist_ok=True)
    for folder in ("folder", "folder with blank"):
        os.makedirs(folder, exist_ok=True)
        write(f"{folder}/sizes.csv", b"x,y,h\n0,0,0.5\n4,0,2\n0,4,2\n4,4,2\n")
        write(f"{folder}/script.txt", b"limit sizes sizes.csv\n+point 900 1.5 1.5\n"
              b"limit size 0.25 in 0 0 1 1\n+point 901 1.25 1.5\n")
        base = ["edit", "journal_input.node", "--domain", "0", "0", "4", "4", "--quiet"]
        run(*base, "--script", f"{folder}/script.txt", "-o", "wanted.vtu", check=0)
        for limit in ("1000000", "0"):
            if os.path.exists("sizes.journal"):
                os.remove("sizes.journal")
            run(*base, "--script", f"{folder}/script.txt", "--journal", "sizes.journal",
                "--journal-limit", limit, check=0)
            run(*base, "--journal", "sizes.journal", "-o", "out.vtu", check=0)
            assert contents("out.vtu") == contents("wanted.vtu"), (folder, limit)
            folded = b"# folded" in contents("sizes.journal")
            assert folded == (limit == "0" and folder == "folder"), (folder, limit)
        write(f"{folder}/sizes.csv", b"x,y,h\n0,0,0.25\n4,0,2\n0,4,2\n4,4,2\n")
        code, said = run(*base, "--journal", "sizes.journal")
        assert code == 2 and "is not what it was" in said, said


def compacted():
    """A compacted journal leads to the same bytes, in the plane and in space, with markers."""
    case = Case("compacted", 9, 200)
    run(*case.with_journal("--journal-limit", "1000"), check=0)
    assert contents(case.out) == contents(case.wanted)
    assert b"# folded" in contents(case.journal)
    short = len(contents(case.journal))
    case.require_resumed()
    os.remove(case.journal)
    run(*case.with_journal(), check=0)
    assert 0 < short < len(contents(case.journal)), "it is not shorter"
    case.forget()
    run(*case.with_journal("--journal-limit", "1000"), check=0)
    # The updates that it stands for are passed over, and only they.
    write(case.script, (text_of(case.batches[:-1]) + "+point 7777 0.125 0.125\n").encode())
    code, said = run(*case.with_journal())
    assert code == 2 and "does not begin with the 200 updates" in said, said
    write_cube("cube.poly")
    write("cube.txt", b"""-polygon 2
+point 9 0.5 0.5 0.5 marker 6
+polygon 2 5 6 7 8 marker 12
begin
-polygon 2
move 7 1 1 1.25
move 8 0 1 1.25
+polygon 2 5 6 7 8 marker 13
-polygon 4
-polygon 5
-polygon 6
+polygon 4 2 3 7 6
+polygon 5 3 4 8 7 marker 15
+polygon 6 4 1 5 8
commit
+region 1 0.5 0.5 0.75 3
limit size 0.5
+point 10 0.25 0.5 0.5
""")
    base = ["edit", "cube.poly", "--domain", "0", "0", "0", "2", "2", "2", "--quiet"]
    run(*base, "--script", "cube.txt", "-o", "wanted.vtu", check=0)
    for limit in ("1000000", "0"):
        if os.path.exists("cube.journal"):
            os.remove("cube.journal")
        run(*base, "--script", "cube.txt", "--journal", "cube.journal", "--journal-limit", limit,
            check=0)
        run(*base, "--journal", "cube.journal", "-o", "out.vtu", check=0)
        assert contents("out.vtu") == contents("wanted.vtu"), limit
    assert b"# folded" in contents("cube.journal")


def main():
    global TOOL
    TOOL = os.path.abspath(sys.argv[1])
    kills, disks = (int(n) for n in (sys.argv[3:5] + ["24", "10"][len(sys.argv) - 3:])[:2])
    seed = int(sys.argv[5]) if len(sys.argv) > 5 else int(time.time())
    print(f"seed {seed}", flush=True)
    scratch = os.path.join(sys.argv[2], "journal_test")
    shutil.rmtree(scratch, ignore_errors=True)
    os.makedirs(scratch)
    os.chdir(scratch)
    run("gen", "uniform", "--n", "200", "--seed", "3", "-o", "journal_input.node", check=0)
    if len(sys.argv) <= 3:  # a soak repeats what is random
        damaged()
        refused()
        backgrounds()
        compacted()
    write_cube("journal_cube.poly")
    killed(Case("killed", seed, 120), kills)
    killed(SpaceCase("killed_in_space", seed + 3, 40), kills // 3)
    full_disk(Case("disk", seed + 1, 60), disks)
    made = full_tmpfs(Case("tmpfs", seed + 2, 200), disks)
    print("ok" if made else "ok, without a disk of its own")
    os.chdir("..")
    shutil.rmtree(scratch)


main()
