#!/usr/bin/env python3
"""Builds the site: HTML from the documents of the repository, with pictures and reference pages.

    build.py BUILD OUTPUT      BUILD has bin/mesher, bin/traces and lib/liblivemesh.so

The documents stay in the folders that they belong to; this copies them, with what they link, to
OUTPUT/source, at the same paths, so that links work on the site as in the repository. It runs the
commands in the gallery and adds their pictures, makes reference pages of the headers (doxygen, breathe),
and runs Sphinx, whose warnings are errors: a broken link is one. ./run site calls this.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
from xml.etree import ElementTree

import commands

ROOT = pathlib.Path(__file__).resolve().parents[3]
HERE = pathlib.Path(__file__).resolve().parent
REPOSITORY = ("sac", "mesher", "traces", ".github", "README.md", "LICENSE", "tests")
SHOWN = {".md", ".svg", ".png"}  # beside what they link
HEADERS = {"mesher": "mesher", "sac": "sac", "traces": "traces"}
# What is in headers for the library itself, or for both sides of a template.
LEFT_OUT = {"all.hpp", "sac.hpp", "arena.hpp", "huge_pages.hpp", "presence.hpp"}

LINK = re.compile(r"(?<!\!)\[(?P<text>[^\[\]]*(?:\[[^\]]*\][^\[\]]*)*)\]\((?P<to>[^)\s]+)\)")


def listed():
    """Paths of the repository's files, relative to ROOT."""
    if (ROOT / ".git").exists():
        names = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard",
                                *REPOSITORY], cwd=ROOT, capture_output=True, text=True,
                               check=True).stdout.splitlines()
        return [pathlib.Path(n) for n in names if (ROOT / n).is_file()]
    return [p.relative_to(ROOT) for part in REPOSITORY for p in sorted((ROOT / part).rglob("*"))
            if p.is_file()]


def outside_code(text):
    """Pieces of a document, and whether they are code."""
    for i, piece in enumerate(re.split(r"(^```.*?^```[^\n]*|`[^`\n]+`)", text, flags=re.M | re.S)):
        yield piece, i % 2 == 1


def linked(path, text):
    """The text with links that Sphinx knows: of a folder to its README, of other files to copies.
    What it links to is told by `linked.files`."""

    def mend(match):
        to, _, anchor = match["to"].partition("#")
        if not to or ":" in to:
            return match[0]
        target = pathlib.Path(os.path.normpath(path.parent / to))
        if (ROOT / target / "README.md").exists():
            to = os.path.join(to, "README.md")
            target = target / "README.md"
        elif (ROOT / target).is_dir():
            return match["text"]  # a folder has no page
        if not (ROOT / target).exists():
            sys.exit(f"{path}: {match['to']} is not there")
        linked.files.add(target)
        return f"[{match['text']}]({to}{'#' + anchor if anchor else ''})"

    return "".join(piece if code else LINK.sub(mend, piece) for piece, code in outside_code(text))


linked.files = set()


def stage(source):
    """The documents, with their pictures and the files that they link."""
    documents = [p for p in listed() if p.suffix == ".md" and p.parts[0] != "tests"
                 and HERE.relative_to(ROOT) not in p.parents]
    for path in documents:
        write(source / path, linked(path, (ROOT / path).read_text(encoding="utf-8")))
    write(source / "index.md", (HERE / "index.md").read_text(encoding="utf-8"))
    pictures = {p for p in listed() if p.suffix in (".svg", ".png")}
    for path in pictures | {p for p in linked.files if p not in documents}:
        (source / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / path, source / path)


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def draw_gallery(tools, source):
    """The gallery, with the pictures behind the commands that make them."""
    path = source / "mesher/docs/gallery.md"
    text, shown, at = path.read_text(encoding="utf-8"), [], 0
    pictures = path.parent / "gallery"
    pictures.mkdir(parents=True, exist_ok=True)
    document = commands.Document(path, ROOT, tools, pictures)
    for part in document.run():
        shown.append(text[at:part.end()])
        at = part.end()
        for name in re.findall(r"-o (\S+\.svg)", part["block"] or ""):
            shown.append(f"\n\n![{name[:-4]}](gallery/{name})\n")
    if document.faults:
        sys.exit("\n".join(document.faults))
    path.write_text("".join(shown) + text[at:], encoding="utf-8")


# --- Reference -----------------------------------------------------------------------------------

DOXYGEN = """
PROJECT_NAME = mesher
INPUT = {input}
FILE_PATTERNS = *.hpp *.h
RECURSIVE = YES
EXCLUDE_PATTERNS = */internal/* */list/*
EXCLUDE_SYMBOLS = *internal* *detail* LM_API LIVEMESH_H
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
OUTPUT_DIRECTORY = {output}
JAVADOC_AUTOBRIEF = YES
MULTILINE_CPP_IS_BRIEF = NO
QUIET = YES
WARN_IF_UNDOCUMENTED = NO
WARN_IF_DOC_ERROR = NO
ENABLE_PREPROCESSING = YES
MACRO_EXPANSION = YES
EXPAND_ONLY_PREDEF = YES
PREDEFINED = LM_API= SAC_NO_INLINE=
FILTER_PATTERNS = "*.h=python3 {here}/c_comments.py"
STRIP_FROM_PATH = {input}
STRIP_FROM_INC_PATH = {input}
"""


def doxygen(output):
    folders = " ".join(str(ROOT / f"{name}/include") for name in HEADERS)
    settings = DOXYGEN.format(input=f"{folders} {ROOT}/mesher/c/include", output=output, here=HERE)
    output.mkdir(parents=True, exist_ok=True)
    subprocess.run(["doxygen", "-"], input=settings, text=True, check=True,
                   stderr=subprocess.DEVNULL)  # of symbols that nobody sees


def by_header(xml):
    """Moves functions, types and constants from the namespaces, where doxygen has them, to the headers
    that declare them, for breathe shows a header at a time."""
    headers = {}
    for path in xml.glob("*_8hpp.xml"):
        tree = ElementTree.parse(path)
        compound = tree.find("compounddef")
        for inner in compound.findall("innernamespace"):
            compound.remove(inner)
        headers[compound.find("location").get("file")] = (path, tree, compound)
    for path in xml.glob("namespace*.xml"):
        for section in ElementTree.parse(path).iter("sectiondef"):
            for member in section.findall("memberdef"):
                file = member.find("location").get("file")
                if file not in headers:
                    continue
                compound = headers[file][2]
                kind = section.get("kind")
                own = compound.find(f"sectiondef[@kind='{kind}']")
                if own is None:
                    own = ElementTree.Element("sectiondef", kind=kind)
                    compound.insert(list(compound).index(compound.find("briefdescription")), own)
                own.append(member)
    for path, tree, _ in headers.values():
        tree.write(path, encoding="utf-8", xml_declaration=True)


def introduction(header):
    """The first comment of a header, as Markdown. What is indented there is code, or a list of
    items that begin with (1), (2), ..."""
    text = header.read_text(encoding="utf-8")
    if text.startswith("/*"):
        lines = text[:text.index("*/")].removeprefix("/*").splitlines()
        lines = [line.removeprefix(" *") for line in lines]
    else:
        lines = [line.removeprefix("//") for line in re.match(r"(//.*\n)*", text)[0].splitlines()]
    lines = [line.removeprefix(" ") for line in lines]
    shown, kind = [], "text"
    for line in lines:
        before, kind = kind, kind_of(line, kind)
        if before == "code" != kind:
            shown.append("```")
        if before != kind:
            shown.append("```cpp" if kind == "code" else "")
        if kind == "code":
            shown.append(line.removeprefix("  "))
        else:
            mended = line.strip().replace("<", "\\<").replace("*", "\\*")
            item = re.match(r"\(\d+\) ", mended) if kind == "list" else None
            shown.append(("\n- " if item else "  " if kind == "list" else "") + mended)
    return "\n".join(shown + (["```"] if kind == "code" else []))


def kind_of(line, before):
    if not line.startswith("  "):
        return "text" if line or before == "text" else before
    if re.match(r"  \(\d+\) ", line):
        return "list"
    return before if before != "text" else "code"


def reference_pages(source):
    for page, name, title in (("cpp", "mesher", "The mesher in C++"),
                              ("engine", "sac", "The engine in C++"),
                              ("traces", "traces", "Traces in C++")):
        folder = ROOT / f"{name}/include/{name}"
        entries = []
        for header in sorted(folder.rglob("*.hpp")):
            if header.name in LEFT_OUT or {"internal", "list"} & set(header.parts):
                continue
            short = header.relative_to(folder.parent)
            link = f"{page}/{'_'.join(short.parts[1:])[:-4]}"
            entries.append(link)
            write(source / f"reference/{link}.md",
                  f"# {short}\n\n{introduction(header)}\n\n"
                  f"```{{doxygenfile}} {short}\n:sections: innerclass func define "
                  "enum typedef var user-defined public-func public-attrib public-static-func "
                  "public-type public-static-attrib\n```\n")
        listing = "\n".join(entries)
        write(source / f"reference/{page}.md",
              f"# {title}\n\n```{{toctree}}\n:maxdepth: 1\n\n{listing}\n```\n")
    write(source / "reference/c.md", f"# livemesh.h\n\n{introduction(ROOT / 'mesher/c/include/livemesh.h')}\n\n"
          "```{doxygenfile} livemesh.h\n:sections: define enum innerclass typedef func public-attrib"
          "\n```\n")
    write(source / "reference/python.md",
          "# livemesh\n\n```{eval-rst}\n.. automodule:: livemesh\n   :members:\n   :undoc-members:\n"
          "   :imported-members:\n\n.. automodule:: livemesh.compat.triangle\n   :members:\n\n"
          ".. automodule:: livemesh.compat.pyvista\n   :members:\n```\n")


def sphinx(build, source, output, version):
    environment = {**os.environ, "SITE_VERSION": version, "SITE_XML": str(output / "doxygen/xml"),
                   "PYTHONPATH": str(ROOT / "mesher/python"), "PYTHONDONTWRITEBYTECODE": "1",
                   "LIVEMESH_LIBRARY": str(build / "lib/liblivemesh.so")}
    subprocess.run(["/usr/bin/python3", "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html",
                    "-c", str(HERE), "-d", str(output / "cache"), str(source),
                    str(output / "html")], env=environment, check=True)


def main(build, output):
    build, output = pathlib.Path(build).resolve(), pathlib.Path(output).resolve()
    source = output / "source"
    shutil.rmtree(source, ignore_errors=True)
    shutil.rmtree(output / "html", ignore_errors=True)
    stage(source)
    draw_gallery(build / "bin", source)
    doxygen(output / "doxygen")
    by_header(output / "doxygen/xml")
    reference_pages(source)
    version = re.search(r"^project\(.* VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(),
                        re.M)[1]
    sphinx(build, source, output, version)
    print(output / "html/index.html")


if __name__ == "__main__":
    main(*sys.argv[1:])
