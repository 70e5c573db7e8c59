#!/usr/bin/env python3
"""The site is built without a warning, and all its links and pictures are there.

    site_test.py BUILD OUTPUT
"""
import html.parser
import pathlib
import shutil
import subprocess
import sys
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ("index", "mesher/docs/start", "mesher/docs/gallery", "mesher/docs/from_triangle",
         "mesher/docs/from_tetgen", "mesher/docs/from_gmsh", "mesher/docs/bad_input",
         "mesher/docs/solvers/calculix", "mesher/docs/paper_map", "sac/docs/dynamize",
         "reference/cpp/mesher", "reference/c", "reference/python", "reference/engine/scope")
TEXTS = {"reference/cpp/mesher": "insert_polygon", "reference/c": "lm_live_update",
         "reference/python": "add_polyline", "reference/cpp/meshing": "RunReport",
         "reference/cpp/read": "read_mesh", "mesher/docs/gallery": "pump.svg"}


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.links, self.ids = [], set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, _, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.links.append(value)
            elif name == "id":
                self.ids.add(value)


def broken_links(folder):
    pages = {path: Page(path) for path in folder.rglob("*.html")}
    for path, page in pages.items():
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = path
            if parts.path:
                target = (path.parent / urllib.parse.unquote(parts.path)).resolve()
            if not target.exists():
                yield f"{path}: {link} is not there"
            elif parts.fragment and target in pages:
                if urllib.parse.unquote(parts.fragment) not in pages[target].ids:
                    yield f"{path}: {link}: no such place"


def main(build, output):
    if not shutil.which("doxygen") or subprocess.run(
            ["/usr/bin/python3", "-c", "import sphinx, breathe, myst_parser, furo"],
            capture_output=True, check=False).returncode != 0:
        print("doxygen, sphinx, breathe, myst-parser or furo is not installed")
        return 77
    made = subprocess.run(["/usr/bin/python3", "-B", str(ROOT / "mesher/docs/site/build.py"), build,
                           output], capture_output=True, text=True, check=False)
    if made.returncode != 0 or "WARNING" in made.stderr:
        print(made.stdout + made.stderr)
        return 1
    faults = []
    site = pathlib.Path(output).resolve() / "html"
    faults += [f"no page {page}" for page in PAGES if not (site / f"{page}.html").exists()]
    faults += [f"{page} does not have {text}" for page, text in TEXTS.items()
               if text not in (site / f"{page}.html").read_text(encoding="utf-8")]
    faults += broken_links(site)
    print(*faults[:40], f"{len(list(site.rglob('*.html')))} pages, {len(faults)} faults", sep="\n")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
