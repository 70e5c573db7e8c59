"""A server `mesher view`, and a web socket client that needs nothing but the standard library."""

import atexit
import base64
import http.client
import json
import os
import signal
import socket
import struct
import subprocess
import urllib.parse

TYPES = {"f64": ("d", 8), "u32": ("I", 4), "u8": ("B", 1)}


class Server:
    """The program, on a free port."""

    def __init__(self, tool, *arguments, cwd=None, limit=None):
        def set_limit():
            if limit is not None:
                import resource
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        self.process = subprocess.Popen([tool, "view", *arguments], stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True, cwd=cwd,
                                        preexec_fn=set_limit)
        atexit.register(lambda: self.process.poll() is None and self.process.kill())
        self.address = self.process.stdout.readline().strip()
        if not self.address:
            raise AssertionError("no address: " + self.process.stderr.read())
        parts = urllib.parse.urlparse(self.address)
        self.host, self.port, self.path = parts.hostname, parts.port, parts.path
        self.token = self.path.strip("/")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    def get(self, path, method="GET", headers=None, whole=False, body=None):
        """Status, body, headers; `path` behind the token, or, if `whole`, all of it."""
        connection = http.client.HTTPConnection(self.host, self.port, timeout=60)
        connection.request(method, path if whole else self.path + path, body=body,
                           headers=headers or {})
        answer = connection.getresponse()
        body = answer.read()
        connection.close()
        return answer.status, body, answer.headers

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()
        self.process.stdout.close()
        self.process.stderr.close()

    def stop(self):
        """Its exit code, and what it said."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        if self.process.stdout.closed:
            return self.process.returncode, ""
        said = self.process.communicate(timeout=60)[1]
        return self.process.returncode, said


class Refused(Exception):
    pass


class Client:
    """A web socket of a page."""

    def __init__(self, server, path=None, host=None, origin="own", joins=True):
        self.socket = socket.create_connection((server.host, server.port), timeout=60)
        self.buffer = b""
        own = f"127.0.0.1:{server.port}"
        if origin == "own":
            origin = "http://" + own
        lines = [f"GET {path or server.path + 'socket'} HTTP/1.1", f"Host: {host or own}",
                 "Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Version: 13",
                 "Sec-WebSocket-Key: " + base64.b64encode(os.urandom(16)).decode()]
        if origin is not None:
            lines.append(f"Origin: {origin}")
        self.socket.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
        while b"\r\n\r\n" not in self.buffer:
            part = self.socket.recv(65536)
            if not part:
                raise Refused("closed")
            self.buffer += part
        head, self.buffer = self.buffer.split(b"\r\n\r\n", 1)
        status = head.split(b" ", 2)[1].decode()
        if status != "101":
            self.socket.close()
            raise Refused(status)
        self.tag = 0
        self.skips = {"busy", "idle"}  # what may come at any time
        self.snapshot = self.receive() if joins else None

    def close(self):
        self.socket.close()

    def _bytes(self, count):
        while len(self.buffer) < count:
            part = self.socket.recv(1 << 20)
            if not part:
                raise EOFError("the server has closed the connection")
            self.buffer += part
        taken, self.buffer = self.buffer[:count], self.buffer[count:]
        return taken

    def send_frame(self, payload, opcode=1, fin=True, masked=True):
        head = bytes([(0x80 if fin else 0) | opcode])
        bit = 0x80 if masked else 0
        if len(payload) < 126:
            head += bytes([bit | len(payload)])
        elif len(payload) < 65536:
            head += bytes([bit | 126]) + struct.pack(">H", len(payload))
        else:
            head += bytes([bit | 127]) + struct.pack(">Q", len(payload))
        if masked:
            mask = os.urandom(4)
            head += mask
            payload = bytes(b ^ mask[i % 4] for i, b in enumerate(payload))
        self.socket.sendall(head + payload)

    def send(self, **command):
        self.tag += 1
        self.send_frame(json.dumps({**command, "tag": self.tag}).encode())
        return self.tag

    def receive(self):
        """The next message: its head, with its arrays under their names."""
        payload, opcode = b"", None
        while True:
            first, second = self._bytes(2)
            size = second & 0x7f
            if size == 126:
                size = struct.unpack(">H", self._bytes(2))[0]
            elif size == 127:
                size = struct.unpack(">Q", self._bytes(8))[0]
            part = self._bytes(size)
            kind = first & 0x0f
            if kind == 8:
                raise EOFError("the server has closed the web socket")
            if kind == 9:
                self.send_frame(part, opcode=10)
                continue
            if kind == 10:
                continue
            opcode = kind or opcode
            payload += part
            if first & 0x80:
                break
        if opcode == 1:
            head = json.loads(payload)
            return self.receive() if head["kind"] in self.skips else head
        length = struct.unpack_from("<I", payload)[0]
        head = json.loads(payload[4:4 + length])
        for array in head.pop("arrays", []):
            letter, size = TYPES[array["type"]]
            at = 4 + length + array["at"]
            assert array["at"] % 8 == 0 and at + size * array["length"] <= len(payload)
            head[array["name"]] = list(struct.unpack_from(f"<{array['length']}{letter}", payload, at))
        return head

    def ask(self, **command):
        """Sends it; the answer."""
        tag = self.send(**command)
        while True:
            message = self.receive()
            if message.get("tag") == tag or message["kind"] == "snapshot":
                return message


class Mirror:
    """The mesh that a page would have: a snapshot, and changes by slot."""

    def __init__(self, snapshot):
        self.d = snapshot["dimension"]
        n = self.d + 1
        self.places = {}
        self.put_places(range(len(snapshot["places"]) // self.d), snapshot["places"])
        self.simplices = {}
        for s, label in enumerate(snapshot["labels"]):
            if label != 255:
                self.simplices[s] = (tuple(snapshot["simplices"][n * s:n * s + n]), label)
        self.edges = {}
        for e, line in enumerate(snapshot["edge_lines"]):
            if line == line:
                self.edges[e] = (tuple(snapshot["edges"][2 * e:2 * e + 2]), line)
        self.points = {}
        self.put_points(snapshot)

    def put_places(self, slots, places):
        for i, v in enumerate(slots):
            self.places[v] = tuple(places[self.d * i:self.d * i + self.d])

    def put_points(self, message):
        for i, p in enumerate(message["point_ids"]):
            self.points[int(p)] = tuple(message["point_places"][self.d * i:self.d * i + self.d])

    def apply(self, change):
        n = self.d + 1
        for s in change["simplices_removed"]:
            del self.simplices[s]
        for e in change["edges_removed"]:
            del self.edges[e]
        self.put_places(change["vertices_added"], change["places"])
        for i, s in enumerate(change["simplices_added"]):
            assert s not in self.simplices
            self.simplices[s] = (tuple(change["simplices"][n * i:n * i + n]), change["labels"][i])
        for s, label in zip(change["relabelled"], change["new_labels"]):
            self.simplices[s] = (self.simplices[s][0], label)
        for i, e in enumerate(change["edges_added"]):
            assert e not in self.edges
            self.edges[e] = (tuple(change["edges"][2 * i:2 * i + 2]), change["edge_lines"][i])
        for p in change["points_removed"]:
            del self.points[p]
        self.put_points(change)

    def content(self):
        """All of it by places: what does not depend on slots."""
        return (sorted((tuple(self.places[v] for v in corners), label)
                       for corners, label in self.simplices.values()),
                sorted((tuple(self.places[v] for v in ends), line)
                       for ends, line in self.edges.values()),
                sorted(self.points.items()))
