"""A live mesh in a browser: the page of `mesher view`, and what is carried to it and back.

The page has an engine of its own, in a process of its own, on the same input. An input is a map of
features; what both sides had when they last met is kept, so that each side's edits are known.
"""
from __future__ import annotations

import http.client
import json
import os
import shutil
import signal
import subprocess
import tempfile
import urllib.parse
import webbrowser
import weakref
from collections.abc import Iterable
from ctypes import byref, c_int64
from types import TracebackType
from typing import TYPE_CHECKING, Any, Dict, List, NamedTuple, Optional, Tuple, Type

import numpy as np

from ._c import c
from ._errors import Cancelled, Error, Feature, GeometryError
from ._graph import Graph, polygon_struct
from ._sizes import Sizes

if TYPE_CHECKING:
    from ._live import Change as _Change, LiveMesh as _LiveMesh

_Key = Tuple[str, int]  # kind and id
_Input = Dict[_Key, Tuple[Any, ...]]
_KINDS = ("point", "line", "polygon", "hole", "region")


class Limit(NamedTuple):
    """A limit of size, everywhere or in a box (the corners, one after the other)."""

    largest: float
    sizes: Optional[Sizes]
    box: Optional[Tuple[float, ...]]


# --- Inputs as maps ------------------------------------------------------------------------------
#
# point: (position, marker); line: (ids, marker); polygon: (loops, inner points, inner edges,
# marker); hole: (position,); region: (position, attribute, limit; 0: none).


def _input_of(graph: Graph) -> _Input:
    found: _Input = {}
    ids = {name: graph._array(field).tolist() for name, field in
           (("points", 1), ("segments", 4), ("polylines", 8), ("polygons", 13), ("holes", 16),
            ("regions", 18))}
    for i, at, marker in zip(ids["points"], graph.points.tolist(), graph.point_markers.tolist()):
        found["point", i] = (tuple(at), marker)
    for i, ends, marker in zip(ids["segments"], graph.segments.tolist(),
                               graph.segment_markers.tolist()):
        found["line", i] = (tuple(ends), marker)
    for i, line, marker in zip(ids["polylines"], graph.polylines,
                               graph.polyline_markers.tolist()):
        found["line", i] = (tuple(line.tolist()), marker)
    edge_ends, edges = graph._array(21).tolist(), graph._array(22).reshape(-1, 2).tolist()
    inner_ends, inner = graph._array(23).tolist(), graph._array(24).tolist()
    for k, (i, loops, marker) in enumerate(zip(ids["polygons"], graph.polygons,
                                               graph.polygon_markers.tolist())):
        found["polygon", i] = (tuple(tuple(loop.tolist()) for loop in loops),
                               tuple(inner[inner_ends[k]:inner_ends[k + 1]]),
                               tuple(map(tuple, edges[edge_ends[k]:edge_ends[k + 1]])), marker)
    for i, at in zip(ids["holes"], graph.holes.tolist()):
        found["hole", i] = (tuple(at),)
    d = graph.dimension
    for i, row in zip(ids["regions"], graph.regions.tolist()):
        found["region", i] = (tuple(row[:d]), row[d], row[d + 1])
    return found


def _input_of_script(text: str, dimension: int) -> Tuple[_Input, List[str]]:
    """What a script makes of nothing, and its lines of limits."""
    found: _Input = {}
    limits = []
    for line in text.splitlines():
        words = line.split()
        if not words or words[0] in ("begin", "commit") or words[0].startswith("#"):
            continue
        if words[0] == "limit":
            limits.append(line)
            continue
        marker = 0
        if "marker" in words:
            marker = int(words[-1])
            words = words[:-2]
        kind, number = words[0][1:], int(words[1])
        if kind == "point":
            found[kind, number] = (tuple(map(float, words[2:])), marker)
        elif kind in ("segment", "polyline"):
            found["line", number] = (tuple(map(int, words[2:])), marker)
        elif kind == "polygon":
            found[kind, number] = (*_polygon_of(words[2:]), marker)
        elif kind == "hole":
            found[kind, number] = (tuple(map(float, words[2:])),)
        else:
            numbers = [float(word) for word in words[2:]] + [0.]
            found[kind, number] = (tuple(numbers[:dimension]), numbers[dimension],
                                   numbers[dimension + 1])
    return found, limits


def _polygon_of(words: List[str]) -> Tuple[Any, ...]:
    loops: List[List[int]] = [[]]
    parts: Dict[str, List[int]] = {"on": [], "along": []}
    into = loops[0]
    for word in words:
        if word == "/":
            into = []
            loops.append(into)
        elif word in parts:
            into = parts[word]
        else:
            into.append(int(word))
    along = parts["along"]
    return (tuple(map(tuple, loops)), tuple(parts["on"]),
            tuple(zip(along[::2], along[1::2])))


def _words(numbers: Iterable[Any]) -> str:
    return " ".join(map(repr, numbers))


def _coming(key: _Key, what: Tuple[Any, ...]) -> str:
    kind, number = key
    if kind == "point":
        text = f"+point {number} {_words(what[0])}"
    elif kind == "line":
        text = ("+segment" if len(what[0]) == 2 else "+polyline") + f" {number} {_words(what[0])}"
    elif kind == "polygon":
        loops, on, along, _ = what
        text = f"+polygon {number} " + " / ".join(map(_words, loops))
        text += f" on {_words(on)}" if on else ""
        text += (" along " + " ".join(map(_words, along))) if along else ""
    elif kind == "hole":
        return f"+hole {number} {_words(what[0])}"
    else:
        at, attribute, limit = what
        return f"+region {number} {_words(at)} {attribute!r}" + (f" {limit!r}" if limit else "")
    return text + (f" marker {what[-1]}" if what[-1] else "")


def _going(key: _Key, what: Tuple[Any, ...]) -> str:
    kind, number = key
    if kind == "line":
        kind = "segment" if len(what[0]) == 2 else "polyline"
    return f"-{kind} {number}"


def _is_move(key: _Key, was: Tuple[Any, ...], what: Tuple[Any, ...]) -> bool:
    return key[0] == "point" and was[1] == what[1]


def _edit_lines(before: _Input, after: _Input) -> List[str]:
    """The lines of one batch that make `after` of `before`."""
    lines = []
    for key in sorted(before.keys() | after.keys()):
        was, what = before.get(key), after.get(key)
        if was == what:
            continue
        if was is not None and what is not None and _is_move(key, was, what):
            lines.append(f"move {key[1]} {_words(what[0])}")
            continue
        if was is not None:
            lines.append(_going(key, was))
        if what is not None:
            lines.append(_coming(key, what))
    return lines


def _merged(base: _Input, mine: _Input, other: _Input) -> Tuple[_Input, List[_Key]]:
    """`mine` with what the other side has done since `base`, and what both did, differently."""
    target, conflicts = dict(mine), []
    for key in sorted(base.keys() | other.keys()):
        was, theirs, ours = base.get(key), other.get(key), mine.get(key)
        if theirs == was:
            continue
        if ours not in (was, theirs):
            conflicts.append(key)
        if theirs is None:
            target.pop(key, None)
        else:
            target[key] = theirs
    return target, conflicts


def _script_of(lines: List[str]) -> str:
    return "\n".join(["begin", *lines, "commit", ""])


# --- Edits of a live mesh ------------------------------------------------------------------------


def _announce(live: "_LiveMesh", before: _Input, after: _Input) -> None:
    """Announces the edits that make `after` of `before`."""
    keys = [key for key in sorted(before.keys() | after.keys())
            if before.get(key) != after.get(key)]
    moves = [key for key in keys
             if key in before and key in after and _is_move(key, before[key], after[key])]
    moved = set(moves)

    def going(kind: str) -> List[int]:
        return [key[1] for key in keys if key[0] == kind and key in before and key not in moved]

    def coming(kind: str) -> List[_Key]:
        return [key for key in keys if key[0] == kind and key in after and key not in moved]

    for kind, remove in (("polygon", live.remove_polygons), ("line", live.remove_lines),
                         ("point", live.remove_points), ("hole", live.remove_holes),
                         ("region", live.remove_regions)):
        if going(kind):
            remove(going(kind))
    if moves:
        live.move([key[1] for key in moves], [after[key][0] for key in moves])
    points = coming("point")
    if points:
        live.add_points([after[key][0] for key in points], [key[1] for key in points],
                        [after[key][1] for key in points])
    for key in coming("line"):
        live.add_polyline(after[key][0], after[key][1], key[1])
    for key in coming("polygon"):
        _add_polygon(live, key[1], after[key])
    holes, regions = coming("hole"), coming("region")
    if holes:
        live.add_holes([after[key][0] for key in holes], [key[1] for key in holes])
    if regions:
        live.add_regions([(*after[key][0], *after[key][1:]) for key in regions],
                         [key[1] for key in regions])


def _add_polygon(live: "_LiveMesh", number: int, polygon: Tuple[Any, ...]) -> None:
    loops, on, along, marker = polygon
    keep, struct = polygon_struct(loops, marker, along, on)
    live._call(c.live_add_polygon, byref(struct), byref(c_int64(number)), byref(c_int64()))
    del keep


# --- The page ------------------------------------------------------------------------------------


def _end(process: "subprocess.Popen[str]", folder: "tempfile.TemporaryDirectory[str]") -> None:
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
    assert process.stdout is not None
    process.stdout.close()
    folder.cleanup()


class View:
    """The page of `mesher view` on a live mesh; made by `LiveMesh.view()`.

    The page has a mesh of its own, with the same input and options. `pull` takes what was edited in
    the page since the last pull or push, as one batch; `push` shows what the live mesh has done
    since. Neither happens by itself. A view ends with `close()`, with its `with` block, when nobody
    refers to it, or with the interpreter; edits that were not pulled are then lost. The live mesh
    does not depend on it. For one thread at a time.

        with d.view() as v:          # opens a browser
            input("edit, then press Enter")
            change = v.pull()        # a Change, or None
    """

    def __init__(self, live: "_LiveMesh", tool: str, port: int, browser: bool) -> None:
        program = shutil.which(tool)
        if program is None:
            raise FileNotFoundError(
                f"{tool!r} is not in PATH: a view needs the command line tool of the repository "
                "(Debian package mesher, or ./run build); view(tool=...) says where it is")
        self._live = live
        self._dimension = live.dimension
        self._base = _input_of(live.graph())
        self._limits_of_live = live._limits_now()
        folder = tempfile.TemporaryDirectory(prefix="livemesh-view-")
        try:
            command = [program, "view", *self._start_files(folder.name), "--port", str(port),
                       "--with-parent", "--quiet"]
            self._errors = os.path.join(folder.name, "errors.txt")
            with open(self._errors, "w", encoding="utf-8") as errors:
                process = subprocess.Popen(command, stdin=subprocess.DEVNULL, text=True,
                                           stdout=subprocess.PIPE, stderr=errors,
                                           start_new_session=True)
        except BaseException:
            folder.cleanup()
            raise
        self._process = process
        self._close = weakref.finalize(self, _end, process, folder)
        try:
            assert process.stdout is not None
            self.address: str = process.stdout.readline().strip()
            if not self.address:
                raise Error(f"{tool} view: {self._said()}", "view")
            self._limits_of_page = self._read()[1]
            if browser:
                webbrowser.open(self.address)
        except BaseException:
            self._close()
            raise

    # --- Start ---------------------------------------------------------------------------------

    def _start_files(self, folder: str) -> List[str]:
        """Writes what the program reads; its arguments."""
        limits = self._limits_of_live
        source, script = os.path.join(folder, "livemesh.poly"), os.path.join(folder, "start.txt")
        with open(source, "w", encoding="ascii") as file:
            file.write(f"0 {self._dimension} 0 0\n0 0\n0\n")
        lines = _edit_lines({}, self._base)
        for i, limit in enumerate(limits[1:]):
            name = f"sizes{i}.csv"
            if limit.sizes is not None:
                _write_sizes(limit.sizes, os.path.join(folder, name))
            lines.append(_limit_line(limit, self._dimension, name))
        arguments = [source, "--domain", *map(repr, self._live.bounds.ravel().tolist()),
                     *self._live._tool_options]
        if lines:
            with open(script, "w", encoding="ascii") as file:
                file.write(_script_of(lines))
            arguments += ["--script", script]
        if limits[0].largest:
            arguments += ["--max-area" if self._dimension == 2 else "--max-volume",
                          repr(limits[0].largest)]
        if limits[0].sizes is not None:
            background = os.path.join(folder, "sizes.csv")
            _write_sizes(limits[0].sizes, background)
            arguments += ["--sizes", background]
        return arguments

    # --- Speaking to the page ------------------------------------------------------------------

    def _said(self) -> str:
        with open(self._errors, encoding="utf-8", errors="replace") as file:
            return file.read().strip() or "it has ended without a message"

    def _ask(self, method: str, path: str, body: Optional[str] = None) -> Tuple[int, bytes]:
        if not self._close.alive:
            raise ValueError("the view is closed")
        place = urllib.parse.urlsplit(self.address)
        connection = http.client.HTTPConnection(str(place.hostname), place.port)
        try:
            connection.request(method, place.path + path,
                               body=None if body is None else body.encode())
            answer = connection.getresponse()
            return answer.status, answer.read()
        except (OSError, http.client.HTTPException) as error:
            if self._process.poll() is None:
                raise
            raise Error(f"the program of the view has ended: {self._said()}", "view") from error
        finally:
            connection.close()

    def _read(self) -> Tuple[_Input, List[str]]:
        status, text = self._ask("GET", "save/input.txt")
        if status != 200:
            raise Error(f"the page cannot be read: {text.decode(errors='replace')}", "view")
        return _input_of_script(text.decode("ascii"), self._dimension)

    def _post(self, lines: List[str]) -> None:
        status, text = self._ask("POST", "edits", _script_of(lines))
        if status == 200:
            return
        answer = json.loads(text)
        if answer["code"] == "cancelled":
            raise Cancelled(answer["text"], "cancelled")
        at = np.array(answer["places"], float).reshape(-1, 3)[:, :self._dimension]
        raise GeometryError(answer["text"], answer["code"],
                            [Feature(kind, number) for kind, number in answer["features"]], at)

    # --- Both ways -----------------------------------------------------------------------------

    def pull(self, force: bool = False) -> Optional["_Change"]:
        """Takes what was edited in the page since the last pull or push into the live mesh, as one
        batch; returns its change, or None if nothing was edited.

        Raises: GeometryError with the code "conflict" if something was edited here, too, in another
        way; with `force` the page prevails. ValueError if edits are announced. As
        `LiveMesh.update`. Nothing is taken then.
        """
        live = self._live
        page, limits = self._read()
        now = _input_of(live.graph())
        target, conflicts = _merged(self._base, now, page)
        limits_edited = limits != self._limits_of_page
        self._require_agreement(conflicts,
                                limits_edited and live._limits_now() != self._limits_of_live, force)
        if limits_edited and not limits:
            raise ValueError("limits of size with a background cannot be taken from the page")
        if target == now and not limits_edited:
            self._base = page
            return None
        with live.edit() as change:
            _announce(live, now, target)
            if limits_edited:
                self._announce_limits(limits)
        self._base = page
        if limits_edited:
            self._limits_of_page, self._limits_of_live = limits, live._limits_now()
        return change

    def push(self, force: bool = False) -> bool:
        """Shows the page what the updates of the live mesh have changed since the last pull or
        push, as one update there. Returns whether anything has.

        Raises: GeometryError with the code "conflict" if something was edited in the page, too, in
        another way; with `force` the live mesh prevails. GeometryError if the page's mesh refuses
        the edits. Cancelled if it is stopped in the page. ValueError for limits of size that a
        script cannot have.
        """
        page, page_limits = self._read()
        now, limits = _input_of(self._live.graph()), self._live._limits_now()
        target, conflicts = _merged(self._base, page, now)
        limits_edited = limits != self._limits_of_live
        self._require_agreement(conflicts, limits_edited and page_limits != self._limits_of_page,
                                force)
        lines = _edit_lines(page, target)
        if limits_edited:
            lines += [_limit_line(limit, self._dimension, "") for limit in limits]
        if lines:
            self._post(lines)
        self._base = now
        if limits_edited:
            self._limits_of_page, self._limits_of_live = self._read()[1], limits
        return bool(lines)

    def _announce_limits(self, lines: List[str]) -> None:
        for line in lines:
            words = line.split()
            largest = {} if words[1] == "none" else {"max_" + words[1]: float(words[2])}
            box = words[words.index("in") + 1:] if "in" in words else None
            self._live.limit(**largest, box=None if box is None else np.array(
                [float(word) for word in box]).reshape(2, -1))

    def _require_agreement(self, keys: List[_Key], of_limits: bool, force: bool) -> None:
        if force or not (keys or of_limits):
            return
        what = [f"{kind} {number}" for kind, number in keys[:5]]
        what += ["limits of size"] if of_limits else []
        more = f" and {len(keys) - 5} more" if len(keys) > 5 else ""
        raise GeometryError(
            f"{', '.join(what)}{more}: edited both in the page and here; with force=True the side "
            "that gives prevails", "conflict", [Feature(*key) for key in keys])

    # --- Its life ------------------------------------------------------------------------------

    @property
    def closed(self) -> bool:
        """Whether the page has no server: it was closed, or its program has ended."""
        return not self._close.alive or self._process.poll() is not None

    def close(self) -> None:
        """Ends the page's server. What was not pulled is lost."""
        self._close()

    def __enter__(self) -> "View":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<View: {'closed' if self.closed else self.address}>"


def _write_sizes(sizes: Sizes, path: str) -> None:
    if sizes._samples is None:
        raise ValueError("sizes by Sizes.function or Sizes.read cannot be shown: "
                         "only those of samples can")
    at, h = sizes._samples
    with open(path, "w", encoding="ascii") as file:
        file.write("x,y,h\n" if sizes.dimension == 2 else "x,y,z,h\n")
        for place, size in zip(at.tolist(), h.tolist()):
            file.write(",".join(map(repr, [*place, size])) + "\n")


def _limit_line(limit: Limit, dimension: int, name: str) -> str:
    """name: that of the file with its background, beside the script."""
    if limit.sizes is not None and (limit.largest or not name):
        raise ValueError("a page that is open cannot be given sizes by samples or by a function, "
                         "nor a largest area or volume with them: close it, and open another")
    if limit.sizes is not None:
        text = f"limit sizes {name}"
    elif limit.largest:
        text = f"limit {'area' if dimension == 2 else 'volume'} {limit.largest!r}"
    else:
        text = "limit none"
    return text + ("" if limit.box is None else f" in {_words(limit.box)}")
