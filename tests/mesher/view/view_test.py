#!/usr/bin/env python3
"""The server of `mesher view` without a browser: who is let in, what is refused, what pages see,
what survives a kill.

    view_test.py TOOL DATA SCRATCH [SEED [MUTANTS [LIVES]]]

SEED may be `random`. MUTANTS: messages in the plane and as many in space; LIVES: of servers that are
killed while their journals are compacted.
"""

import http.client
import json
import os
import random
import shutil
import socket
import struct
import subprocess
import sys
import threading
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.dirname(HERE)]
from client import Client, Mirror, Refused, Server  # noqa: E402
from files import contents, write  # noqa: E402


def edit(*arguments):
    done = subprocess.run([TOOL, "edit", *arguments, "--quiet"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def require_replayed(server, source, *options, formats=("vtu", "msh")):
    """The script, replayed by `mesher edit`, gives the bytes that the page saves."""
    status, script, _ = server.get("save/edits.txt")
    assert status == 200
    write("replayed.txt", script)
    for extension in formats:
        edit(source, *options, "--script", "replayed.txt", "-o", f"replayed.{extension}")
        status, saved, _ = server.get(f"save/mesh.{extension}")
        assert status == 200, saved
        assert saved == contents(f"replayed.{extension}"), f".{extension} differs"
    return script


def same_as_snapshot(client, mirror):
    now = client.ask(do="snapshot")
    assert Mirror(now).content() == mirror.content()
    return now


def refuses_strangers():
    with Server(TOOL, "square.poly", "--journal", "strangers.journal") as server:
        own = f"127.0.0.1:{server.port}"
        status, body, headers = server.get("")
        assert status == 200 and b"<canvas" in body
        assert headers["Cache-Control"] == "no-store"
        assert "default-src 'self'" in headers["Content-Security-Policy"]
        for page in ("app.js", "plane.js", "space.js", "mesh.js", "tiles.js", "gl.js", "wire.js",
                     "style.css"):
            assert server.get(page)[0] == 200, page
        assert server.get("", headers={"Host": f"localhost:{server.port}"})[0] == 200
        assert server.get("no_such")[0] == 404
        assert server.get("../page.html")[0] == 404
        assert server.get("save/../../etc/passwd")[0] == 409
        assert server.get("save/mesh.exe")[0] == 409
        assert server.get("", method="POST")[0] == 405
        assert server.get("", method="DELETE")[0] == 405
        status, body, headers = server.get("app.js", method="HEAD")
        assert status == 200 and body == b"" and int(headers["Content-Length"]) > 1000
        # A wrong token, none, a part of it, more than it.
        wrong = ("0" if server.token[0] != "0" else "1") + server.token[1:]
        for path in ("/", "/app.js", f"/{wrong}/", f"/{server.token[:-1]}/", f"/{server.token}0/",
                     f"/{server.token}", f"//{server.token}/", "/socket", f"/{wrong}/socket"):
            status, body, _ = server.get(path, whole=True)
            assert status == 403 and body == b"refused\n", path
        # Another Host, as of a name that was pointed at this machine; another Origin.
        for host in ("example.org", f"example.org:{server.port}", "127.0.0.1", "127.0.0.1:1",
                     f"127.0.0.1:{server.port}.example.org", f"127.0.0.2:{server.port}", ""):
            assert server.get("", headers={"Host": host})[0] == 403, host
        for origin in ("http://example.org", f"https://{own}", "null", f"http://{own}.example.org",
                       f"http://127.0.0.1:{server.port + 1}", "", own):
            assert server.get("", headers={"Origin": origin})[0] == 403, origin
            try:
                Client(server, origin=origin)
                raise AssertionError(f"a web socket of {origin!r} was let in")
            except Refused as refused:
                assert str(refused) == "403", origin
        for case in ({"origin": None}, {"host": "example.org"}, {"path": f"/{wrong}/socket"},
                     {"path": "/socket"}):
            try:
                Client(server, **case)
                raise AssertionError(f"a web socket was let in: {case}")
            except Refused as refused:
                assert str(refused) == "403", case
        try:
            Client(server, path=server.path + "other")
            raise AssertionError("there is another web socket")
        except Refused as refused:
            assert str(refused) == "404"
        # It listens on the loopback address alone.
        addresses = {info[4][0] for info in socket.getaddrinfo(socket.gethostname(), None,
                                                               socket.AF_INET)}
        for address in addresses - {"127.0.0.1"}:
            with socket.socket() as other:
                other.settimeout(5)
                reached = other.connect_ex((address, server.port)) == 0
                assert not reached or address.startswith("127."), address
        Client(server).close()
    code, said = server.stop()
    assert code == 0, (code, said)


def shows_edits_to_all():
    with Server(TOOL, "square.poly", "--journal", "all.journal") as server:
        one, two = Client(server), Client(server)
        mirrors = [Mirror(one.snapshot), Mirror(two.snapshot)]
        commands = [{"do": "point", "at": [0.3, 0.4]},
                    {"do": "line", "through": [[0.2, 0.2], [0.8, 0.25]], "marker": 7},
                    {"do": "line", "through": [[0.4, 0.5], [0.7, 0.5], [0.6, 0.7]], "closed": True},
                    {"do": "region", "at": [0.57, 0.56], "attribute": 2.5, "largest": 0.001},
                    {"do": "hole", "at": [0.1, 0.9]},
                    {"do": "delete", "features": [["point", 5]]},
                    {"do": "undo"}, {"do": "undo"}, {"do": "redo"},
                    {"do": "script", "text": "begin\n+point 90 .9 .8\n+point 91 .8 .9\n"
                     "+segment 92 90 91\ncommit\n+point 93 .15 .15\n"}]
        for command in commands:
            tag = one.send(**command)
            expected = 2 if command["do"] == "script" else 1
            for client, mirror in ((one, mirrors[0]), (two, mirrors[1])):
                for _ in range(expected):
                    change = client.receive()
                    assert change["kind"] == "change", change
                    assert change["tag"] == tag
                    mirror.apply(change)
                    assert len(mirror.simplices) == change["state"]["simplices"]
                    kept = sum(label != 0 for _, label in mirror.simplices.values())
                    assert kept == change["state"]["kept"]
        assert mirrors[0].content() == mirrors[1].content()
        same_as_snapshot(two, mirrors[0])
        # A drag is one update, whatever it did on the way; all see it on the way.
        before = one.ask(do="snapshot")["state"]
        for x in (0.31, 0.33, 0.36):
            change = one.ask(do="drag", point=5, at=[x, 0.41])
            assert change["kind"] == "change" and change["state"]["updates"] == before["updates"]
            mirrors[0].apply(change)
        one.send(do="drag", point=5, at=[0.38, 0.42], drop=True)
        last = [one.receive() for _ in range(3)]
        assert [m["kind"] for m in last] == ["change", "state", "dropped"]
        mirrors[0].apply(last[0])
        assert last[2]["state"]["updates"] == before["updates"] + 1
        assert last[2]["state"]["undo"] == before["undo"] + 1
        same_as_snapshot(one, mirrors[0])
        assert mirrors[0].points[5] == (0.38, 0.42)
        # Somebody else's edit, or an end of the connection, drops it.
        one.ask(do="drag", point=5, at=[0.39, 0.43])
        state = two.ask(do="undo")["state"]
        assert state["updates"] == before["updates"] + 3, "the drag, and its undo"
        assert Mirror(two.ask(do="snapshot")).points[5] == (0.38, 0.42)
        three = Client(server)
        three.ask(do="drag", point=5, at=[0.4, 0.44])
        three.close()
        time.sleep(0.3)
        assert two.ask(do="snapshot")["state"]["updates"] == before["updates"] + 4
        script = require_replayed(server, "square.poly", formats=("vtu", "msh", "off", "obj"))
        assert script.count(b"move 5") == 4 and b"move 5 0.38 0.42" in script
        archive = server.get("save/mesh.node")[1]
        write("saved.tar", archive)
        os.makedirs("untarred", exist_ok=True)
        subprocess.run(["tar", "-xf", "saved.tar", "-C", "untarred"], check=True)
        os.makedirs("own", exist_ok=True)
        edit("square.poly", "--script", "replayed.txt", "-o", "own/square.node")
        for part in ("node", "ele", "edge", "poly", "neigh"):
            assert contents(f"untarred/square.{part}") == contents(f"own/square.{part}"), part
        for extension in ("vtk", "inp", "su2", "mesh", "svg"):
            status, body, headers = server.get(f"save/mesh.{extension}")
            assert status == 200 and len(body) > 100, extension
            assert headers["Content-Disposition"] == f'attachment; filename="square.{extension}"'
        fresh = one.ask(do="fresh")
        assert fresh["kind"] == "fresh" and fresh["same"] is True, fresh
        state = one.ask(do="snapshot")["state"]
        for count in ("vertices", "simplices"):
            assert fresh[count] == state[count], count
        assert fresh["calls"] > 0


def refuses_nonsense(seed):
    """Commands that are none, that are wrong, or noise: nothing changes, and the server lives."""
    rng = random.Random(seed)
    with Server(TOOL, "square.poly", "--domain", "-1", "-1", "2", "2", "--journal",
                "nonsense.journal") as server:
        client = Client(server)
        watcher = Client(server)
        before = Mirror(client.snapshot).content()
        wrong = [{}, {"do": 3}, {"do": "paint"}, {"do": "point"}, {"do": "point", "at": 5},
                 {"do": "point", "at": [1]}, {"do": "point", "at": [1, 2, 3]},
                 {"do": "point", "at": ["a", 1]}, {"do": "point", "at": [1e300, 0]},
                 {"do": "point", "at": [1e-40, 0]}, {"do": "point", "at": [50, 50]},
                 {"do": "point", "at": [0, 0]}, {"do": "point", "at": [0.5, 0.5], "marker": 1.5},
                 {"do": "line", "through": []}, {"do": "line", "through": [1]},
                 {"do": "line", "through": "all"}, {"do": "line", "through": [1, 77]},
                 {"do": "line", "through": [1, 2]}, {"do": "line", "through": [1, 3], "closed": 1},
                 {"do": "line", "through": [[0.5, -0.1], [0.5, 0.5]]},
                 {"do": "line", "through": [1, 2 ** 60]}, {"do": "line", "through": [1, -2 ** 63]},
                 {"do": "line", "through": [1, 2 ** 64]}, {"do": "line", "through": [1, 1.5]},
                 {"do": "line", "through": [None, 2]}, {"do": "line", "through": [[0.2], 2]},
                 {"do": "delete"}, {"do": "delete", "features": []},
                 {"do": "delete", "features": [["point", 99]]},
                 {"do": "delete", "features": [["planet", 1]]}, {"do": "delete", "features": [5]},
                 {"do": "region", "at": [0.5, 0.5]}, {"do": "hole"},
                 {"do": "region", "at": [0.5, 0.5], "attribute": "x"},
                 {"do": "drag", "point": 99, "at": [0, 0]}, {"do": "drag", "point": 1},
                 {"do": "drag", "point": 1, "at": [90, 0]}, {"do": "undo"}, {"do": "redo"},
                 {"do": "script"}, {"do": "script", "text": ""}, {"do": "script", "text": "hello"},
                 {"do": "script", "text": "limit sizes /etc/passwd"},
                 {"do": "script", "text": "limit area 1\nlimit \t sizes /etc/passwd"},
                 {"do": "script", "text": "limit area -1"},
                 {"do": "limit", "largest": -1}, {"do": "limit", "size": "x"},
                 {"do": "limit", "size": 1, "largest": 1}, {"do": "limit", "box": [[0, 0]]},
                 {"do": "limit", "size": .1, "box": [[1, 1], [0, 0]]},
                 {"do": "limit", "size": .1, "box": [[0, 0, 0], [1, 1, 1]]},
                 {"do": "unlimit"}, {"do": "unlimit", "box": [[0, 0], [1, 1]]},
                 {"do": "script", "text": "begin\n+point 60 .5 .5\n"},
                 {"do": "script", "text": "begin\n+point 60 .5 .5\n+point 60 .6 .5\ncommit\n"},
                 {"do": "script", "text": "+point 9007199254740993 .5 .5\n"}]
        for command in wrong:
            answer = client.ask(**command)
            assert answer["kind"] == "error" and answer["text"], (command, answer)
        crossing = client.ask(do="line", through=[[0.5, 0.5], [0.5, 0.5]])
        assert crossing["kind"] == "error"
        crossing = client.ask(do="line", through=[[0.5, -0.1], [0.5, 0.5]])
        assert crossing["code"] == "crossing_segments" and crossing["places"][0][:2] == [0.5, 0], \
            crossing
        # Text that is no JSON, bytes, deep nests, what is not UTF-8 (which closes).
        texts = [b"", b"{", b"[1,2", b"null", b"[]", b"42", b'"do"', b"[" * 100000, b'{"a":' * 50000,
                 b'{"do":"point","at":[NaN,1]}', b'{"do":"point","at":[1e999,0]}',
                 b'{"do":"undo"}' * 2, b"\x00\x01\x02", json.dumps({"do": "x" * 100000}).encode()]
        for text in texts:
            client.send_frame(text)
            assert client.receive()["kind"] == "error", text[:40]
        client.send_frame(b'{"do":"undo"}', opcode=2)
        assert client.receive()["kind"] == "error"
        # Mutations of good commands that edit nothing: a drag to where the point is.
        good = json.dumps({"do": "drag", "point": 1, "at": [0.0, 0.0]}).encode()
        for _ in range(400):
            mutant = bytearray(good)
            for _ in range(rng.randrange(1, 4)):
                kind, at = rng.randrange(3), rng.randrange(len(mutant))
                if kind == 0:
                    mutant[at] = rng.randrange(32, 127)
                elif kind == 1:
                    del mutant[at]
                else:
                    mutant[at:at] = mutant[rng.randrange(len(mutant)):][:rng.randrange(6)]
            try:
                command = json.loads(mutant)
                moves = (isinstance(command, dict) and command.get("do") == "drag" and
                         command.get("at") != [0.0, 0.0])
            except ValueError:
                moves = False
            if not moves:
                client.send_frame(bytes(mutant))
        client.ask(do="snapshot")
        # Frames that are none.
        for _ in range(60):
            stranger = Client(server)
            kind = rng.randrange(5)
            if kind == 0:
                stranger.socket.sendall(rng.randbytes(rng.randrange(1, 200)))
            elif kind == 1:
                stranger.send_frame(b'{"do":"point","at":[0.5,0.5]}', masked=False)
            elif kind == 2:
                stranger.send_frame(b"\xff\xfe\xfd")
            elif kind == 3:
                stranger.socket.sendall(b"\x81\xff" + struct.pack(">Q", 1 << 62))
            else:
                stranger.send_frame(b"x" * rng.randrange(1000), opcode=rng.choice([3, 5, 11]))
            stranger.close()
        big = Client(server)
        try:
            big.send_frame(b" " * (2 << 20))
            big.receive()
            raise AssertionError("a message of 2 MB was read")
        except (EOFError, OSError):
            pass
        # HTTP that is none.
        for _ in range(60):
            with socket.create_connection((server.host, server.port), timeout=10) as raw:
                text = rng.choice([rng.randbytes(100), b"GET / HTTP/1.1\r\n" + b"A: b\r\n" * 5000,
                                   b"GET " + server.path.encode() + b" HTTP/9.9\r\n\r\n",
                                   b"POST " + server.path.encode() + b" HTTP/1.1\r\nHost: "
                                   b"127.0.0.1\r\nContent-Length: 99999999\r\n\r\n"])
                raw.sendall(text)
        # More connections than there may be; those that are there go on.
        many = [socket.create_connection((server.host, server.port), timeout=10)
                for _ in range(100)]
        for raw in many:
            raw.close()
        assert Mirror(client.ask(do="snapshot")).content() == before
        assert contents("nonsense.journal").count(b"upd\n") == 1, "something was edited"
        watcher.send(do="snapshot")
        message = watcher.receive()
        assert message["kind"] == "snapshot", "an edit was sent to all"
        assert server.process.poll() is None


EDITING = {"point", "line", "polygon", "hole", "region", "delete", "drag", "limit", "unlimit", "undo",
           "redo", "script"}


def any_command(rng, d, points):
    """One of each kind, most of them good."""
    def place():
        return [round(rng.uniform(.05, .95), 3) for _ in range(d)]
    point, box = rng.choice(points), [[0] * d, [.5] * d]
    commands = [{"do": "point", "at": place(), "marker": 3},
                {"do": "line", "through": [place(), place()], "marker": 1},
                {"do": "line", "through": [1, place(), place()], "closed": True},
                {"do": "hole", "at": place()},
                {"do": "region", "at": place(), "attribute": 2.5, "largest": .5},
                {"do": "delete", "features": [["point", point], ["line", rng.randrange(1, 9)]]},
                {"do": "delete", "features": [["point", point]]},
                {"do": "drag", "point": point, "at": place(), "drop": True},
                {"do": "drag", "point": point, "at": place()},
                {"do": "drag", "feature": ["line", rng.randrange(1, 9)], "by": [.125] * d,
                 "drop": rng.random() < .5},
                {"do": "limit", "largest": rng.uniform(.05, 1), "box": box},
                {"do": "limit", "size": rng.uniform(.3, 1)}, {"do": "unlimit", "box": box},
                {"do": "undo"}, {"do": "redo"}, {"do": "snapshot"}, {"do": "fresh"},
                {"do": "calls", "on": rng.random() < .5},
                {"do": "script", "text": "begin\n+point %d %s\ncommit\n" %
                 (rng.randrange(50, 99), " ".join(map(str, place())))}]
    if d == 3:
        commands += [{"do": "polygon", "through": [place(), place(), place()]},
                     {"do": "drag", "feature": ["polygon", rng.randrange(1, 9)],
                      "by": [0, 0, rng.choice([.125, -.125])], "drop": True}]
    return commands[rng.randrange(len(commands))]


def mutated(rng, text):
    text = bytearray(text)
    for _ in range(rng.randrange(5)):
        if not text:
            break
        kind, at = rng.randrange(6), rng.randrange(len(text))
        if kind == 0:
            text[at] = rng.randrange(256)
        elif kind == 1:
            text[at] = rng.randrange(32, 127)
        elif kind == 2:
            del text[at:at + rng.randrange(1, 5)]
        elif kind == 3:
            text[at:at] = text[rng.randrange(len(text)):][:rng.randrange(12)]
        elif kind == 4:
            text[at:at] = rng.choice([b"1e999", b"-", b"null", b"[[[", b"{}", b"9007199254740993",
                                      b'"', b"\\u0000", b"nan", b"0" * 40])
        else:
            del text[at:]
    return bytes(text)


def is_asked(text):
    """Whether a message is a command that edits."""
    try:
        command = json.loads(text.decode())
    except ValueError:
        return False
    name = command.get("do") if isinstance(command, dict) else None
    return isinstance(name, str) and name in EDITING


def survives_mutants(seed, count):
    """Mutants of all commands: no crash, no edit that was not asked for, and what pages have, a fresh
    run and the script agree at the end."""
    for source, d in (("square.poly", 2), ("cube.poly", 3)):
        rng = random.Random(seed + d)
        options = ("--domain", *["-1"] * d, *["2"] * d, "--max-vertices", "3000")
        with Server(TOOL, source, *options, "--journal", f"mutants{d}.journal") as server:
            client = Client(server)
            mirror = Mirror(client.snapshot)
            made = refused = closed = 0
            for _ in range(count):
                message = mutated(rng, json.dumps(any_command(rng, d, sorted(mirror.points))).encode())
                try:
                    client.send_frame(message)
                    end, answer = client.send(do="paint"), {}  # is refused, after all else
                    while answer.get("tag") != end:
                        answer = client.receive()
                        if answer["kind"] == "change":
                            assert is_asked(message), message
                            mirror.apply(answer)
                            made += 1
                        elif answer["kind"] == "snapshot":
                            assert Mirror(answer).content() == mirror.content(), message
                        refused += answer["kind"] == "error"
                except TimeoutError as error:
                    raise AssertionError(f"no answer: {message}") from error
                except (EOFError, OSError):  # what is not UTF-8
                    assert server.process.poll() is None, (server.process.returncode, message)
                    closed += 1
                    client = Client(server)
                    mirror = Mirror(client.snapshot)
            assert made > count / 20 and refused > count, (made, refused, closed)
            same_as_snapshot(client, mirror)
            fresh = client.ask(do="fresh")
            while fresh.get("text") == "a fresh run is under way":  # a mutant's
                fresh = client.ask(do="fresh")
            while fresh["kind"] != "fresh" and fresh["kind"] != "error":
                fresh = client.receive()
            assert fresh.get("same") is True, fresh
            require_replayed(server, source, *options, formats=("vtu",))
            assert server.stop()[0] == 0


def random_command(rng, mirror):
    kind = rng.random()
    ids = sorted(mirror.points)
    place = [rng.uniform(0.02, 0.98), rng.uniform(0.02, 0.98)]
    if kind < 0.35:
        return {"do": "point", "at": place}
    if kind < 0.45:
        other = [min(0.98, max(0.02, x + rng.uniform(-0.1, 0.1))) for x in place]
        return {"do": "line", "through": [place, other], "marker": rng.randrange(3)}
    if kind < 0.6:
        return {"do": "drag", "point": rng.choice(ids), "at": place, "drop": True}
    if kind < 0.7:
        return {"do": "delete", "features": [["point", rng.choice(ids)]]}
    if kind < 0.8:
        return {"do": "region", "at": place, "attribute": rng.randrange(4)}
    return {"do": rng.choice(["undo", "undo", "redo"])}


def survives_kills(seed):
    """Random edits, with kills; at the end the script gives the bytes of a run without any."""
    rng = random.Random(seed)
    journal = "kills.journal"
    if os.path.exists(journal):
        os.remove(journal)
    updates = 0
    history = (0, 0)
    content = None
    for life in range(8):
        server = Server(TOOL, "square.poly", "--journal", journal)
        client = Client(server)
        mirror = Mirror(client.snapshot)
        state = client.snapshot["state"]
        more = state["updates"] - updates  # of a command that was not answered: all of it, or nothing
        assert more in ((0, 1) if life > 0 else (0,)), f"life {life}: {state['updates']}, {updates}"
        if more == 0:
            assert (state["undo"], state["redo"]) == history
        if content is not None and more == 0:
            for part in (0, 2):
                assert mirror.content()[part] == content[part], f"life {life}: " + str(
                    set(map(str, mirror.content()[part])) ^ set(map(str, content[part])))[:2000]
        for _ in range(12):
            command = random_command(rng, mirror)
            tag = client.send(**command)
            ends = {"dropped"} if command["do"] == "drag" else {"change", "error", "state"}
            while True:
                message = client.receive()
                if message["kind"] == "change":
                    mirror.apply(message)
                if "state" in message:
                    state = message["state"]
                if message.get("tag") == tag and message["kind"] in ends:
                    break
                if message["kind"] == "error" and command["do"] == "drag" and \
                        message["code"] == "unknown_id":
                    break
            if command["do"] == "drag" and message["kind"] == "dropped":
                state = message["state"]
        updates, history = state["updates"], (state["undo"], state["redo"])
        content = mirror.content()
        if life < 7:
            client.send(do="point", at=[rng.uniform(0.02, 0.98), rng.uniform(0.02, 0.98)])
            time.sleep(rng.random() * 0.004)
            server.kill()
    require_replayed(server, "square.poly")
    code, said = server.stop()
    assert code == 0 and "resumed" in said, said
    edit("square.poly", "--journal", journal, "-o", "resumed.vtu")
    assert contents("resumed.vtu") == contents("replayed.vtu")


def compacts_and_survives_kills(seed, lives):
    """A view with a short journal, which is compacted as it goes on, and killed: it comes back with
    all that was answered, and its script makes the same mesh."""
    for source, d in (("square.poly", 2), ("cube.poly", 3)):
        rng = random.Random(seed + d)
        journal, updates, folded = f"short{d}.journal", 0, 0

        def place():
            return [rng.uniform(.05, .95) for _ in range(d)]

        def any_edit(points):
            loose = [p for p in points if p > 2 ** d]
            if not loose or rng.random() < .4:
                return {"do": "point", "at": place()}
            if len(loose) > 10:
                return {"do": "delete", "features": [["point", rng.choice(loose)]]}
            at = place()
            corners = [at, *([x + (i == k) / 32 for i, x in enumerate(at)] for k in range(2))]
            return rng.choice([{"do": "drag", "point": rng.choice(loose), "at": at, "drop": True},
                               {"do": "polygon" if d == 3 else "line", "through": corners},
                               {"do": "region", "at": at, "attribute": 2},
                               {"do": "undo"}, {"do": "redo"}])

        content = None
        for life in range(lives):
            server = Server(TOOL, source, "--journal", journal, "--journal-limit", "900")
            client = Client(server)
            mirror = Mirror(client.snapshot)
            state = client.snapshot["state"]
            assert state["updates"] - updates in ((0, 1) if life > 0 else (0,)), (life, state, updates)
            if life > 0 and state["updates"] == updates:
                assert mirror.content() == content, f"life {life}"
            for _ in range(12):
                client.send(**any_edit(sorted(mirror.points)))
                end, message = client.send(do="paint"), {}
                while message.get("tag") != end:
                    message = client.receive()
                    if message["kind"] == "change":
                        mirror.apply(message)
                    state = message.get("state", state)
            updates, content = state["updates"], mirror.content()
            folded += b"# folded" in contents(journal)
            if life == lives - 1:
                require_replayed(server, source, formats=("vtu", "obj"))
            client.send(do="point", at=place())
            time.sleep(rng.random() * .004)
            server.kill()
        assert folded > lives // 2, f"{folded} of {lives} journals were compacted"


def tells_of_full_disks():
    """An update that cannot be in the journal is taken back, and told so; later ones are made."""
    with Server(TOOL, "square.poly", "--journal", "full.journal") as server:
        length = len(contents("full.journal"))
    os.remove("full.journal")
    with Server(TOOL, "square.poly", "--journal", "full.journal", limit=length + 150) as server:
        client = Client(server)
        mirror = Mirror(client.snapshot)
        first = client.ask(do="point", at=[0.3, 0.4])
        assert first["kind"] == "change"
        mirror.apply(first)
        tag = client.send(do="line", through=[[0.1 + i / 50, 0.1 + i / 90] for i in range(20)])
        snapshot = client.receive()
        assert snapshot["kind"] == "snapshot" and Mirror(snapshot).content() == mirror.content()
        error = client.receive()
        assert error["tag"] == tag and error["code"] == "cannot_write", error
        assert "update 2 is not in the journal, the 1 before it are" in error["text"]
        mirror = Mirror(snapshot)
        last = client.ask(do="point", at=[0.6, 0.4])
        assert last["kind"] == "change" and last["state"]["updates"] == 2, last
        mirror.apply(last)
        # A drag goes back.
        for _ in range(20):
            moved = client.ask(do="drag", point=5, at=[0.3 + random.random() / 10, 0.45])
            mirror.apply(moved)
            client.send(do="drag", point=5, at=list(mirror.points[5]), drop=True)
            messages = [client.receive()]
            while messages[-1]["kind"] != "dropped":
                messages.append(client.receive())
            for message in messages:
                if message["kind"] == "change":
                    mirror.apply(message)
            if any(m["kind"] == "error" for m in messages):
                break
        else:
            raise AssertionError("the disk was never full")
        same_as_snapshot(client, mirror)
    edit("square.poly", "--journal", "full.journal", "-o", "full.vtu")


def follows_in_space():
    source = "cube.poly"
    with Server(TOOL, source, "--journal", "space.journal") as server:
        client = Client(server)
        mirror = Mirror(client.snapshot)
        assert len(client.snapshot["neighbours"]) == 4 * len(client.snapshot["labels"])
        commands = [{"do": "point", "at": [0.5, 0.5, 0.5]},
                    {"do": "line", "through": [9, [0.5, 0.25, 0.75]], "marker": 4},
                    {"do": "drag", "point": 9, "at": [0.5, 0.5, 0.6], "drop": True},
                    {"do": "polygon", "through": [[0.2, 0.2, 0.2], [0.4, 0.2, 0.2],
                                                  [0.2, 0.4, 0.2]], "marker": 9},
                    {"do": "region", "at": [0.7, 0.7, 0.3], "attribute": 3},
                    {"do": "delete", "features": [["point", 11]]}, {"do": "undo"},
                    {"do": "undo"}, {"do": "redo"}]
        for command in commands:
            tag = client.send(**command)
            while True:
                message = client.receive()
                assert message["kind"] != "error", (command, message)
                if message["kind"] == "change":
                    mirror.apply(message)
                if message.get("tag") == tag and message["kind"] == (
                        "dropped" if command.get("drop") else "change"):
                    break
        same_as_snapshot(client, mirror)
        require_replayed(server, source, formats=("vtu", "stl", "mesh"))
        assert server.get("save/input.poly")[0] == 200
        assert client.ask(do="fresh")["same"] is True


def drags_lines_and_polygons():
    """All points of a line or polygon move in one update, which undo takes back as one."""
    def told(client, mirror, **command):
        tag, messages = client.send(**command), []
        while not messages or messages[-1].get("tag") != tag or messages[-1]["kind"] == "state":
            messages.append(client.receive())
            if command.get("drop") and messages[-1]["kind"] == "change":
                mirror.apply(messages.pop())
        if messages[-1]["kind"] == "dropped":  # an error comes behind
            end = client.send(do="nothing")
            while messages[-1].get("tag") != end:
                messages.append(client.receive())
            messages.pop()
        for message in messages:
            if message["kind"] == "change":
                mirror.apply(message)
        return messages[-1]

    with Server(TOOL, "square.poly", "--journal", "line_drag.journal") as server:
        client = Client(server)
        mirror = Mirror(client.snapshot)
        mirror.apply(client.ask(do="line", through=[[.3, .3], [.5, .4], [.7, .3]]))
        before = same_as_snapshot(client, mirror)
        for y in (.1, .2, .25):
            told(client, mirror, do="drag", feature=["line", 5], by=[0, y])
            assert mirror.points[6] == (.5, .4 + y)
        state = told(client, mirror, do="drag", feature=["line", 5], by=[0, .5], drop=True)["state"]
        assert state["updates"] == before["state"]["updates"] + 1
        assert [mirror.points[p] for p in (5, 6, 7)] == [(.3, .8), (.5, .9), (.7, .8)]
        same_as_snapshot(client, mirror)
        # Back to where it began: no update. Refused: nothing is moved.
        told(client, mirror, do="drag", feature=["line", 5], by=[.1, 0])
        assert told(client, mirror, do="drag", feature=["line", 5], by=[0, 0],
                    drop=True)["state"]["updates"] == state["updates"]
        refused = told(client, mirror, do="drag", feature=["line", 5], by=[0, .15], drop=True)
        assert refused["code"] == "outside_domain" and refused["places"] == [[.5, 1.05, 0]], refused
        assert mirror.points[6] == (.5, .9)
        # Another edit drops it.
        told(client, mirror, do="drag", feature=["line", 5], by=[-.1, 0])
        change = client.ask(do="undo")
        assert change["state"]["updates"] == state["updates"] + 2
        mirror.apply(change)
        assert mirror.points[6] == (.5, .9)
        mirror.apply(client.ask(do="undo"))
        assert mirror.points[6] == (.5, .4)
        line = {"feature": ["line", 5]}
        for wrong in (line, {**line, "at": [0, 0]}, {**line, "by": [0, 0, 0]},
                      {**line, "by": [1e300, 0]}, {"feature": ["line", 99], "by": [0, 0]},
                      {"feature": ["hole", 1], "by": [0, 0]}, {"feature": 5, "by": [0, 0]},
                      {"point": 5, "by": [0, 0]}):
            assert client.ask(do="drag", **wrong)["kind"] == "error", wrong
        same_as_snapshot(client, mirror)
        script = require_replayed(server, "square.poly")
        assert b"begin\nmove 5 0.3 0.8\nmove 6 0.5 0.9\nmove 7 0.7 0.8\ncommit\n" in script
    box = ("--domain", "-1", "-1", "-1", "2", "2", "2")
    with Server(TOOL, "cube.poly", *box, "--journal", "face_drag.journal") as server:
        client = Client(server)
        mirror = Mirror(client.snapshot)
        first = mirror.content()
        face = {p for p, at in mirror.points.items() if at[2] == 1}
        assert len(face) == 4
        told(client, mirror, do="drag", feature=["polygon", 6], by=[0, 0, .25])
        state = told(client, mirror, do="drag", feature=["polygon", 6], by=[0, 0, .5],
                     drop=True)["state"]
        assert (state["updates"], state["undo"]) == (1, 1)
        assert {p for p, at in mirror.points.items() if at[2] == 1.5} == face
        assert client.ask(do="fresh")["same"] is True
        same_as_snapshot(client, mirror)
        # One corner alone bends its faces: a corner that is off is told, and nothing moves.
        bent = told(client, mirror, do="drag", point=3, at=[-.25, 1, 1.75], drop=True)
        assert bent["code"] == "not_flat" and bent["features"][0][0] == "polygon", bent
        assert tuple(bent["places"][0]) in {(-.25, 1, 1.75), *mirror.points.values()}, bent
        same_as_snapshot(client, mirror)
        require_replayed(server, "cube.poly", *box)
        mirror.apply(client.ask(do="undo"))
        assert mirror.content() == first
    server = Server(TOOL, "cube.poly", *box, "--journal", "face_drag.journal")
    client = Client(server)
    assert client.snapshot["state"]["redo"] == 1
    assert client.ask(do="redo")["kind"] == "change"
    client.ask(do="drag", feature=["polygon", 6], by=[.5, 0, 0])
    server.kill()  # what was not dropped is not in the journal
    with Server(TOOL, "cube.poly", *box, "--journal", "face_drag.journal") as server:
        points = Mirror(Client(server).snapshot).points
        assert {at for p, at in points.items() if p in face} == \
            {(x, y, 1.5) for x in (0, 1) for y in (0, 1)}


def says_where_errors_are():
    """Also of what is wrong by its ids alone."""
    for source, cases in (
            ("square.poly", (({"do": "line", "through": [3, 3]}, "zero_length", [1, 1, 0]),
                             ({"do": "script", "text": "-point 3"}, "point_in_use", [1, 1, 0]))),
            ("cube.poly", (({"do": "polygon", "through": [1, [.5, .5, .5], [.25, .5, .75], 1]},
                            "bad_polygon", "1"),
                           ({"do": "script", "text": "begin\n+point 40 .5 .25 .125\n"
                             "+polygon 40 1 40 2 40\ncommit\n"}, "bad_polygon", [.5, .25, .125]),
                           ({"do": "script", "text": "-point 1"}, "point_in_use", "1")))):
        with Server(TOOL, source, "--journal", f"where_{source}.journal") as server:
            client = Client(server)
            points = Mirror(client.snapshot).points
            for command, code, place in cases:
                error = client.ask(**command)
                assert error.get("code") == code, error
                assert error["places"] == [list(points[1]) if place == "1" else place], error


def draws_calls():
    """On request a picture of the calls that an update ran; of a drag one."""
    with Server(TOOL, "square.poly", "--journal", "calls.journal") as server:
        client = Client(server)
        assert server.get("calls.svg")[0] == 404
        assert client.ask(do="calls", on=True)["state"]["calls"] == 0
        assert server.get("calls.svg")[0] == 404, "nothing has run yet"
        change = client.ask(do="point", at=[0.3, 0.4])
        drawn = client.receive()
        assert drawn["kind"] == "state"
        assert drawn["state"]["calls"] == change["state"]["revision"]
        status, first, headers = server.get("calls.svg?1")
        assert status == 200 and first.startswith(b"<svg") and b"point" in first
        assert headers["Content-Security-Policy"].startswith("default-src 'none'")
        for x in (0.31, 0.32):
            assert client.ask(do="drag", point=5, at=[x, 0.4])["kind"] == "change"
            assert server.get("calls.svg")[1] == first, "a drag on its way"
        client.send(do="drag", point=5, at=[0.33, 0.4], drop=True)
        while client.receive()["kind"] != "dropped":
            pass
        second = server.get("calls.svg")[1]
        assert second.startswith(b"<svg") and second != first
        assert client.ask(do="calls", on=False)["state"]["calls"] is None
        assert server.get("calls.svg")[0] == 404
        assert client.ask(do="calls", on=3)["kind"] == "error"


def stops_on_request():
    """An update without end: pages are served while it runs, told of it, and may stop it."""
    endless = {"do": "limit", "size": 1e-5}

    def told(client, kind):
        client.skips = set()
        message = client.receive()
        while message["kind"] != kind:
            message = client.receive()
        client.skips = {"busy", "idle"}
        return message

    def stop():
        status, said, _ = server.get("stop", method="POST")
        assert status == 200
        return said

    with Server(TOOL, "square.poly", "--journal", "endless.journal") as server:
        client = Client(server)
        client.send(**endless)
        for _ in range(12):  # it goes on, also if nothing else happens
            told(client, "busy")
        assert stop() == b"stopping\n"
        assert client.receive()["code"] == "cancelled"
        same_as_snapshot(client, Mirror(client.snapshot))
        client.send(**endless)
        told(client, "busy")
        assert server.stop()[0] == 0
    with Server(TOOL, "square.poly", "--journal", "stop.journal") as server:
        client, other = Client(server), Client(server)
        mirror = Mirror(client.snapshot)
        assert stop() == b"nothing is under way\n"
        tag = client.send(**endless)
        assert told(client, "busy")["stops"] is False
        calls = told(other, "busy")["calls"]
        assert told(other, "busy")["calls"] > calls > 0
        for headers in ({"Host": "example.org"}, {"Origin": "http://example.org"}):
            assert server.get("stop", method="POST", headers=headers)[0] == 403
        # A page that is opened, and what others ask for meanwhile.
        for page in ("", "app.js", "style.css"):
            assert server.get(page)[0] == 200, page
        late = Client(server, joins=False)
        told(late, "busy")
        asked = other.send(do="point", at=[.3, .4])
        replies = []
        saving = threading.Thread(target=lambda: replies.append(server.get("save/input.txt")))
        saving.start()
        lost = Client(server, joins=False)
        lost.close()
        time.sleep(.5)
        assert not replies
        assert stop() == b"stopping\n"
        error = client.receive()
        assert (error.get("code"), error.get("tag")) == ("cancelled", tag), error
        told(other, "idle")
        change = other.receive()
        assert change["kind"] == "change" and change["tag"] == asked, change
        assert change["state"]["updates"] == 1
        mirror.apply(client.receive())
        assert Mirror(late.receive()).content() in (mirror.content(),
                                                    Mirror(client.snapshot).content())
        saving.join()
        assert replies[0][0] == 200 and b"limit none" in replies[0][1], replies
        same_as_snapshot(client, mirror)
        # Of a script the batches before stay; one that is posted says so, too.
        script = "+point 20 .5 .5\nlimit size .00001\n+point 21 .6 .5\n"
        tag = client.send(do="script", text=script)
        mirror.apply(client.receive())
        told(client, "busy")
        stop()
        error = client.receive()
        assert (error.get("code"), error.get("tag")) == ("cancelled", tag), error
        posting = threading.Thread(target=lambda: replies.append(
            server.get("edits", method="POST", body="limit size .00001\n")))
        posting.start()
        told(client, "busy")
        stop()
        posting.join()
        assert replies[1][0] == 409 and json.loads(replies[1][1])["code"] == "cancelled", replies
        state = same_as_snapshot(client, mirror)["state"]
        assert (state["updates"], state["undo"], len(mirror.points)) == (2, 2, 6)
        # A drag goes on from where it was.
        mirror.apply(client.ask(do="drag", point=20, at=[.5, .55], drop=True))
        # A fresh run.
        mirror.apply(client.ask(do="limit", size=.01))
        tag, again = client.send(do="fresh"), client.send(do="fresh")
        error = client.receive()
        assert (error["text"], error["tag"]) == ("a fresh run is under way", again), error
        while stop() != b"stopping\n":
            pass
        error = client.receive()
        while error["kind"] != "error":
            error = client.receive()
        assert (error["code"], error["tag"]) == ("cancelled", tag), error
        assert client.ask(do="fresh")["same"] is True
        require_replayed(server, "square.poly", formats=("vtu",))
        # It ends at once while one runs.
        client.send(**endless)
        told(client, "busy")
    edit("square.poly", "--journal", "stop.journal", "-o", "stopped.vtu")
    assert contents("stopped.vtu") == contents("replayed.vtu")


def edits_limits():
    """Limits are given, changed, deleted, undone; also after the server was ended."""
    boxes = {"left": [[0, 0], [.5, 1]], "low": [[0, 0], [1, .25]], "far": [[.75, .75], [1, 1]]}

    def told(limits):
        return [([b["lo"], b["hi"]], b["largest"]) for b in limits["boxes"]]

    with Server(TOOL, "square.poly", "--journal", "limits.journal") as server:
        client = Client(server)
        mirror = Mirror(client.snapshot)
        assert client.snapshot["limits"] == {"everywhere": None, "boxes": []}
        counts = [client.snapshot["state"]["kept"]]

        def do(**command):
            change = client.ask(**command)
            assert change["kind"] == "change", (command, change)
            mirror.apply(change)
            counts.append(change["state"]["kept"])
            return change["limits"]

        assert do(do="limit", largest=.01) == {"everywhere": .01, "boxes": []}
        assert counts[1] > counts[0]
        assert told(do(do="limit", box=boxes["left"], largest=.001)) == [(boxes["left"], .001)]
        assert counts[2] > counts[1]
        assert told(do(do="limit", box=boxes["left"], largest=.004)) == [(boxes["left"], .004)]
        assert counts[1] < counts[3] < counts[2]
        assert len(told(do(do="limit", box=boxes["low"], size=.02))) == 2
        assert len(told(do(do="limit", box=boxes["far"], size=.01))) == 3
        # Alone in its place, and over another one.
        assert len(told(do(do="unlimit", box=boxes["far"]))) == 2
        assert counts[-1] == counts[-3]
        assert told(do(do="unlimit", box=boxes["left"]))[0][0] == boxes["low"]
        assert len(told(do(do="limit", box=boxes["left"]))) == 2, "any size is a limit there, too"
        assert do(do="limit") == {"everywhere": None, "boxes": []}
        assert counts[-1] == counts[0]
        same_as_snapshot(client, mirror)
        done = len(counts) - 1
        for i in range(1, 4):
            limits = do(do="undo")
            assert counts[-1] == counts[done - i], i
        assert told(limits)[0][0] == boxes["left"] and len(limits["boxes"]) == 2
        do(do="redo")
        last = do(do="script", text="begin\nlimit area .005 in 0 0 .3 .3\n+point 50 .9 .9\ncommit\n")
        require_replayed(server, "square.poly")
        assert client.ask(do="fresh")["same"] is True
        content = mirror.content()
    with Server(TOOL, "square.poly", "--journal", "limits.journal") as server:
        client = Client(server)
        assert client.snapshot["limits"] == last
        assert Mirror(client.snapshot).content()[0] == content[0]
        before = client.snapshot["state"]
        assert before["undo"] == done - 1
        change = client.ask(do="undo")
        assert change["limits"] != last and change["state"]["undo"] == before["undo"] - 1
        while change["state"]["undo"] > 0:
            change = client.ask(do="undo")
            assert change["kind"] == "change", change
        assert change["limits"] == {"everywhere": None, "boxes": []}
        assert change["state"]["kept"] == counts[0]
    # What came from a background, or a function, cannot be given again: no undo over it.
    write("sizes.csv", b"x,y,h\n0,0,.1\n1,0,.1\n1,1,.3\n0,1,.3\n")
    with Server(TOOL, "square.poly", "--sizes", "sizes.csv", "--journal", "ground.journal") as server:
        client = Client(server)
        assert client.snapshot["limits"] == {"everywhere": "background", "boxes": []}
        client.ask(do="point", at=[.5, .5])
        change = client.ask(do="limit", size=.05, box=boxes["left"])
        assert change["state"]["undo"] == 0
        assert change["limits"]["boxes"][0]["largest"] > 0
        assert client.ask(do="unlimit", box=boxes["left"])["code"] == "bad_edit"
    # In space, volumes.
    with Server(TOOL, "cube.poly", "--journal", "space_limits.journal") as server:
        client = Client(server)
        before = client.snapshot["state"]["kept"]
        change = client.ask(do="limit", largest=.002, box=[[0, 0, 0], [.5, .5, .5]])
        assert change["limits"]["boxes"][0]["hi"] == [.5, .5, .5]
        assert change["state"]["kept"] > before
        require_replayed(server, "cube.poly", formats=("vtu",))
        assert client.ask(do="undo")["state"]["kept"] == before


def saves_pictures_of_the_last_update():
    """An .svg has the bytes of `mesher edit`: what the last update brought is orange."""
    with Server(TOOL, "square.poly", "--journal", "picture.journal") as server:
        client = Client(server)
        plain = server.get("save/mesh.svg")[1]
        seen = [plain]
        for command in ({"do": "point", "at": [.3, .4]},
                        {"do": "line", "through": [[.2, .2], [.8, .25]]}, {"do": "undo"},
                        {"do": "redo"}, {"do": "limit", "largest": .01}):
            assert client.ask(**command)["kind"] == "change"
            require_replayed(server, "square.poly", formats=("svg",))
            seen.append(server.get("save/mesh.svg")[1])
        # All that a drag did is one update, also what it brought and took away again.
        for x in (.35, .6, .42):
            client.ask(do="drag", point=5, at=[x, .45])
        client.ask(do="drag", point=5, at=[.4, .45], drop=True)
        script = require_replayed(server, "square.poly", formats=("svg",))
        assert script.endswith(b"move 5 0.4 0.45\n")
        seen.append(server.get("save/mesh.svg")[1])
        # A drag that ends where it began is no update.
        client.ask(do="drag", point=5, at=[.5, .5])
        client.ask(do="drag", point=5, at=[.4, .45], drop=True)
        assert server.get("save/mesh.svg")[1] == seen[-1]
        assert seen[4] == seen[2] and len(set(seen)) == len(seen) - 1, "redo is as doing it"
    with Server(TOOL, "square.poly", "--journal", "picture.journal") as server:
        assert server.get("save/mesh.svg")[1] == seen[-1]
    with Server(TOOL, "cube.poly", "--journal", "space_picture.journal") as server:
        client = Client(server)
        client.ask(do="point", at=[.5, .5, .5])
        client.ask(do="drag", point=9, at=[.5, .6, .5])
        client.ask(do="drag", point=9, at=[.5, .55, .5], drop=True)
        require_replayed(server, "cube.poly", formats=("svg",))


def comes_back_where_it_was():
    """A server that is started again has the address of its journal, which is its user's alone."""
    file = "back.journal.page"
    server = Server(TOOL, "square.poly", "--journal", "back.journal")
    address, run = server.address, Client(server).snapshot["run"]
    assert contents(file).decode() == address + "\n"
    assert os.stat(file).st_mode & 0o777 == 0o600
    server.kill()
    with Server(TOOL, "square.poly", "--journal", "back.journal") as server:
        assert server.address == address
        assert Client(server).snapshot["run"] != run
    with Server(TOOL, "square.poly", "--journal", "other_back.journal") as server:
        assert server.token not in address
    # Another port that is asked for; one that is taken; another address that is asked for.
    with socket.socket() as taken:
        taken.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        taken.bind(("127.0.0.1", int(address.split(":")[2].split("/")[0])))
        taken.listen()
        with Server(TOOL, "square.poly", "--journal", "back.journal") as server:
            assert server.address != address and server.token not in address
            second = server.address
    with Server(TOOL, "square.poly", "--journal", "back.journal", "--new-address") as server:
        assert server.token not in second
        third = server.address
    # What others can read, or what is no address, is not used.
    os.chmod(file, 0o644)
    with Server(TOOL, "square.poly", "--journal", "back.journal") as server:
        assert server.token not in third
    good = contents(file)
    for wrong in (b"", b"x\n", good.replace(b"127.0.0.1", b"127.0.0.2"), good[:-4] + b"/\n",
                  good.replace(b"/\n", b"z\n"), good[:30].upper() + b"G" * 40 + b"/\n"):
        write(file, wrong)
        os.chmod(file, 0o600)
        with Server(TOOL, "square.poly", "--journal", "back.journal") as server:
            assert server.token not in good.decode()
            assert contents(file).decode() == server.address + "\n"


def begins_with_a_script():
    """Edits that a new journal begins with; a page cannot undo them."""
    write("start.txt", b"begin\n+point 7 .25 .25\n+point 8 .75 .25\n+segment 9 7 8 marker 4\n"
          b"commit\nlimit sizes sizes.csv in 0 0 1 .5\n+hole 3 .9 .9\n")
    for life in range(2):
        with Server(TOOL, "square.poly", "--journal", "start.journal", "--script",
                    "start.txt") as server:
            client = Client(server)
            mirror = Mirror(client.snapshot)
            state = client.snapshot["state"]
            assert mirror.points[8] == (.75, .25)
            assert (state["updates"], state["undo"]) == (3 + life, life)
            if life == 0:
                client.ask(do="point", at=[.5, .9])
            require_replayed(server, "square.poly", formats=("vtu", "svg"))
            script = server.get("save/input.txt")[1].decode()
            assert "+segment 9 7 8 marker 4" in script and "+hole 3 0.9 0.9" in script
            assert "background" in script
    # A kill may have left a part of it.
    records = contents("start.journal").split(b"upd\n")
    write("part.journal", b"upd\n".join(records[:3]))
    with Server(TOOL, "square.poly", "--journal", "part.journal", "--script",
                "start.txt") as server:
        state = Client(server).snapshot["state"]
        assert (state["updates"], state["undo"]) == (3, 0)
    edit("square.poly", "--journal", "part.journal", "-o", "part.vtu")
    edit("square.poly", "--script", "start.txt", "-o", "whole.vtu")
    assert contents("part.vtu") == contents("whole.vtu")


def takes_posted_scripts():
    """For programs: a script is posted, and what pages did is read, without a web socket."""
    with Server(TOOL, "square.poly", "--journal", "post.journal") as server:
        client = Client(server)
        mirror = Mirror(client.snapshot)

        def post(text, path="edits", headers=None):
            connection = http.client.HTTPConnection(server.host, server.port, timeout=60)
            try:
                connection.request("POST", server.path + path, body=text, headers=headers or {})
                answer = connection.getresponse()
                return answer.status, answer.read()
            except (OSError, http.client.HTTPException):
                return 0, b""
            finally:
                connection.close()

        status, body = post("begin\n+point 20 .5 .5\n+point 21 .6 .5\n+segment 20 20 21\ncommit\n"
                            "limit area .01\n")
        assert status == 200 and json.loads(body)["updates"] == 2, body
        for _ in range(2):
            mirror.apply(client.receive())
        same_as_snapshot(client, mirror)
        lines = server.get("save/input.txt")[1].decode().splitlines()
        assert lines[0] == "begin" and lines[-1] == "commit" and lines[-2] == "limit area 0.01"
        assert "+segment 20 20 21" in lines and "+point 21 0.6 0.5" in lines
        # Refused: nothing is changed.
        for text, code in (("hello", "bad_edit"), ("", "bad_edit"), ("limit sizes x", "bad_edit"),
                           ("-point 20", "point_in_use"), ("+point 22 9 9", "outside_domain")):
            status, body = post(text)
            assert status == 409 and json.loads(body)["code"] == code, (text, body)
        # To nobody else, and nowhere else.
        assert post("+point 30 .1 .1", headers={"Host": "example.org"})[0] in (0, 403)
        assert post("+point 30 .1 .1", headers={"Origin": "http://example.org"})[0] in (0, 403)
        assert post("+point 30 .1 .1", path="edit")[0] in (0, 405)
        assert post("+point 30 .1 .1", path="../edits")[0] in (0, 405)
        # 3 MB, which no message of a page may have.
        big = "begin\n" + "".join(f"+point {i} {(i % 200) / 200 + .0025:.4f} "
                                  f"{(i // 200) / 200 + .0025:.4f}\n"
                                  for i in range(1000, 3000)) + "# " + "x" * 3000000 + "\ncommit\n"
        assert post(big)[0] == 200
        assert server.get("save/input.txt")[1].count(b"+point") == 2006
        assert client.ask(do="snapshot")["state"]["updates"] == 3
    # What it says makes the same mesh of nothing.
    write("nothing.poly", b"0 2 0 0\n0 0\n0\n")
    with Server(TOOL, "square.poly", "--journal", "post.journal") as server:
        write("input.txt", server.get("save/input.txt")[1])
        write("edits.txt", server.get("save/edits.txt")[1])
    box = ("--domain", "0", "0", "1", "1")
    edit("nothing.poly", *box, "--script", "input.txt", "-o", "a.vtu")
    edit("square.poly", *box, "--script", "edits.txt", "-o", "b.vtu")
    assert contents("a.vtu") == contents("b.vtu")


def ends_with_its_parent():
    """Also if that ends before the page is there."""
    subprocess.run([TOOL, "gen", "uniform", "--n", "20000", "-o", "slow.node"], check=True)
    for source, waits, seconds in (("square.poly", True, 10), ("slow.node", False, 60)):
        starter = ("import subprocess, sys\n"
                   "p = subprocess.Popen(sys.argv[2:], stdout=subprocess.PIPE if sys.argv[1] == 'True'"
                   " else subprocess.DEVNULL, text=True)\n"
                   "if p.stdout: p.stdout.readline()\n"
                   "print(p.pid, flush=True)\n"
                   "sys.stdin.read()\n")
        parent = subprocess.Popen([sys.executable, "-c", starter, str(waits), TOOL, "view", source,
                                   "--quiet", "--journal", f"{source}.parent", "--with-parent"],
                                  stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        pid = int(parent.stdout.readline())
        os.kill(pid, 0)
        for _ in range(2000):  # the journal is there before the mesh
            if os.path.exists(f"{source}.parent"):
                break
            time.sleep(.005)
        parent.kill()
        parent.communicate()
        require_end(pid, seconds)


def require_end(pid, seconds):
    for _ in range(20 * seconds):
        try:
            os.kill(pid, 0)
            with open(f"/proc/{pid}/stat") as stat:
                if stat.read().rsplit(")", 1)[1].split()[0] == "Z":
                    return
        except OSError:
            return
        time.sleep(.05)
    raise AssertionError("the view goes on without its parent")


def refuses_options():
    def refuse(code, text, *arguments):
        done = subprocess.run([TOOL, "view", *arguments], capture_output=True, text=True, timeout=60)
        assert done.returncode == code and text in done.stderr, (arguments, done)
    refuse(2, "--port", "square.poly", "--port", "70000")
    refuse(2, "--port", "square.poly", "--port", "x")
    known = subprocess.run([TOOL, "view", "--help"], capture_output=True, text=True).stdout
    for option in ("-o", "--static", "--stats"):
        refuse(2, option, "square.poly", option, "x")
        assert f" {option} " not in known, option
    assert " --order " in known and " --script " in known
    refuse(2, "cannot be read", "nowhere.poly")
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        refuse(2, "cannot listen", "square.poly", "--port", str(taken.getsockname()[1]))
    with Server(TOOL, "square.poly", "--journal", "taken.journal"):
        refuse(2, "in use by another process", "square.poly", "--journal", "taken.journal")
    write("huge.node", b"2 2 0 0\n9007199254740993 0 0\n2 1 1\n")
    refuse(2, "ids beyond 2^53", "huge.node")


def main():
    global TOOL
    TOOL = os.path.abspath(sys.argv[1])
    seed, mutants, lives = (sys.argv[4:7] + ["random", "150", "4"][len(sys.argv[4:7]):])
    seed = int(time.time()) if seed == "random" else int(seed)
    print(f"seed {seed}", flush=True)
    scratch = os.path.join(sys.argv[3], "view_test")
    shutil.rmtree(scratch, ignore_errors=True)
    os.makedirs(scratch)
    os.chdir(scratch)
    write("square.poly", b"4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 1\n1 1 2 1\n2 2 3 2\n3 3 4 3\n"
          b"4 4 1 4\n0\n")
    subprocess.run([TOOL, "gen", "cube", "-o", "cube.poly"], check=True)
    for test in (refuses_strangers, shows_edits_to_all, tells_of_full_disks, follows_in_space,
                 drags_lines_and_polygons, says_where_errors_are, draws_calls, stops_on_request,
                 edits_limits, saves_pictures_of_the_last_update, comes_back_where_it_was,
                 begins_with_a_script, takes_posted_scripts, ends_with_its_parent, refuses_options):
        test()
    refuses_nonsense(seed)
    survives_kills(seed)
    survives_mutants(seed, int(mutants))
    compacts_and_survives_kills(seed, int(lives))
    print("ok")
    os.chdir("..")
    shutil.rmtree(scratch)


main()
