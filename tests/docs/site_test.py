"""site_test.py BUILD_DOCS FOLDER: the documentation as a site is built without a warning (Sphinx checks the links of its
sources), and what is made is whole and needs no network:

- no page loads anything from elsewhere: scripts, styles, fonts, images, frames; nor does a style sheet;
- each link within the site leads to a file, and to a place in it;
- each page can be reached from index.html;
- each name of the Python package and of the C interface is in the reference.
"""

import ast
import pathlib
import re
import subprocess
import sys
import urllib.parse
from html.parser import HTMLParser

ROOT = pathlib.Path(__file__).resolve().parents[2]
# attributes by which a page loads something; href of a link does so unless it only names another page
LOADS = {"src", "srcset", "poster", "data", "action", "background"}
NAMES_ONLY = {"next", "prev", "index", "search", "canonical", "author", "genindex"}
ELSEWHERE = re.compile(r"\s*(?:[a-z]+:)?//", re.IGNORECASE)
IN_STYLE = re.compile(r"(?:url\(\s*['\"]?|@import\s+['\"])(?:https?:)?//", re.IGNORECASE)


class Page(HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.loaded, self.links, self.anchors, self._tag = [], [], set(), ""
        self.styles = []
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        self._tag = tag
        values = dict(attributes)
        for name, value in attributes:
            if name in LOADS or name.endswith(":href") or (tag == "use" and name == "href"):
                self.loaded.append(value or "")
            elif name == "style":
                self.styles.append(value or "")
        if tag == "link" and values.get("rel") not in NAMES_ONLY:
            self.loaded.append(values.get("href") or "")
        elif tag in ("a", "area", "link") and values.get("href"):
            self.links.append(values["href"])
        self.anchors.update(value for name, value in attributes if name in ("id", "name") and value)

    handle_startendtag = handle_starttag

    def handle_data(self, data):
        if self._tag == "style":
            self.styles.append(data)


def target_of(file, link):
    """The file and the anchor that a link leads to, or None if it leads elsewhere."""
    parts = urllib.parse.urlsplit(link)
    if parts.scheme or parts.netloc:
        return None
    path = urllib.parse.unquote(parts.path)
    return ((file.parent / path).resolve() if path else file), urllib.parse.unquote(parts.fragment)


def mistakes_of(site):
    pages = {file: Page(file) for file in sorted(site.rglob("*.html"))}
    for file, page in pages.items():
        place = file.relative_to(site)
        for loaded in page.loaded:
            if ELSEWHERE.match(loaded):
                yield f"{place} loads {loaded}"
            elif not loaded.startswith(("data:", "#")) and not target_of(file, loaded)[0].exists():
                yield f"{place} loads {loaded}, which is not there"
        if any(IN_STYLE.search(style) for style in page.styles):
            yield f"{place} has a style that loads something from elsewhere"
        for link in page.links:
            target = target_of(file, link)
            if target is None:
                continue
            if not target[0].is_file():
                yield f"{place}: the link to {link} leads nowhere"
            elif target[1] and target[0] in pages and target[1] not in pages[target[0]].anchors:
                yield f"{place}: {link} has no such place in it"
    for style in site.rglob("*.css"):
        if IN_STYLE.search(style.read_text(encoding="utf-8")):
            yield f"{style.relative_to(site)} loads something from elsewhere"
    reached, ahead = set(), [(site / "index.html").resolve()]
    while ahead:
        file = ahead.pop()
        if file in reached or file not in pages:
            continue
        reached.add(file)
        ahead += [target[0] for link in pages[file].links if (target := target_of(file, link))]
    for file in pages.keys() - reached:
        yield f"{file.relative_to(site)} cannot be reached from index.html"
    yield from missing_names(pages[site / "docs/site/python-api.html"], pages[site / "docs/site/c-api.html"])


def missing_names(python, c):
    package = ast.parse((ROOT / "python/stride/__init__.py").read_text(encoding="utf-8"))
    names = next(ast.literal_eval(each.value) for each in package.body
                 if isinstance(each, ast.Assign) and each.targets[0].id == "__all__")
    for name in names:
        if f"stride.{name}" not in python.anchors:
            yield f"the Python reference has no {name}"
    header = (ROOT / "interfaces/stride/master.h").read_text(encoding="utf-8")
    code = re.sub(r"/\*.*?\*/", "", header, flags=re.DOTALL)
    functions = set(re.findall(r"^[\w ]+[ *](stride_\w+)\(", code, flags=re.MULTILINE))
    constants = set(re.findall(r"^\s+(STRIDE_[A-Z0-9_]+)\b", code, flags=re.MULTILINE))
    if len(functions) < 20 or len(constants) < 20:
        yield f"master.h: {len(functions)} functions and {len(constants)} constants were found, expected more"
    described = {anchor.rpartition(".")[2] for anchor in c.anchors}
    for name in sorted((functions | constants) - described):
        yield f"the C reference has no {name}"


def main(build_docs, folder):
    built = subprocess.run([build_docs, folder], stdout=subprocess.PIPE, text=True)
    print(built.stdout, end="")
    if built.returncode != 0:
        return built.returncode
    site = pathlib.Path(folder).resolve()
    mistakes = list(mistakes_of(site))
    print("\n".join(mistakes) if mistakes else f"{len(list(site.rglob('*.html')))} pages are right")
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
