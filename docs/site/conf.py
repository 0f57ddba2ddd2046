"""The documentation as a site: see docs/decisions/0050 and scripts/build_docs.sh. Sources are the pages of the
repository, where they are."""

import re
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
root = here.parents[1]
sys.path[:0] = [str(here / "extensions"), str(root / "python")]

project = "stride"
release = re.search(r"project\(stride VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
version = release
html_title = f"stride {release}"
html_show_copyright = False

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "c_header",
    "mermaid_fence",
    "source_pages",
]

# ---- Which pages, and in which order. A page that is not in CONTENTS is a warning, and so an error. ----

root_doc = "README"
include_patterns = [
    "*.md",
    "docs/*.md",
    "docs/decisions/*.md",
    "docs/site/*.rst",
    "units/*/README.md",
    "scenarios/README.md",
    "scenarios/*/README.md",
    "scenarios/*/golden/README.md",
    "tests/test_units/README.md",
]
exclude_patterns = ["build*", "results*", "master", "**/.*", "**/__pycache__"]

CONTENTS = {
    "README": {
        "Start": "All pages <docs/README>",
        "Learn": "docs/first-steps, docs/accelerometer",
        "How-to: install": "docs/wheel, docs/container",
        "How-to: runs": "docs/report, docs/checks, docs/compare, docs/coverage, docs/stimuli, docs/checkpoints, docs/traces, docs/film,"
        " docs/scene, docs/export, docs/hosts, docs/remote",
        "How-to: many runs": "docs/campaigns, docs/search, docs/distil",
        "How-to: models": "docs/unit-guide, docs/python-units, docs/wrap-systemc, docs/wrap-core, docs/bring-your-robot,"
        " docs/units-of-others, docs/verify",
        "How-to: Python and C": "docs/python, docs/library",
        "Reference": "docs/scenario, docs/cli, docs/attributes, docs/units-of-measure, docs/stepping, docs/idle, docs/process-protocol,"
        " docs/site/python-api, docs/site/c-api, scenarios/README, units/*/README, tests/test_units/README",
        "Background": "docs/architecture, docs/decisions/README, docs/paper, docs/variations, docs/performance, docs/python-peers",
        "The project": "CHANGELOG, CONTRIBUTING",
    },
    "scenarios/README": {"": "scenarios/*/README"},
    "scenarios/nfc_approach/README": {"": "scenarios/nfc_approach/golden/README"},
}

# ---- Links ----

nitpicky = True  # each name in a signature leads somewhere, or is one of those below
nitpick_ignore_regex = [
    (r"c:identifier", r"u?int\d+_t|size_t"),  # of the C library
    (r"py:class", r"np\..*|numpy\..*|datetime(\..*)?|pytest\..*|pathlib\..*|collections\.abc\..*|os\..*"),  # of other packages
    (r"py:obj", r".*"),  # in backticks: code, and a link where it is a name
]

# ---- Markdown as a forge shows it ----

myst_heading_anchors = 6
myst_fence_as_directive = ["mermaid"]
suppress_warnings = ["misc.highlighting_failure"]  # a console session is no whole program

# ---- The Python package, as its docstrings have it ----

default_role = "py:obj"
autodoc_mock_imports = ["numpy", "pytest"]
autodoc_member_order = "bysource"
autodoc_typehints_format = "short"
autodoc_default_options = {"members": True}
napoleon_numpy_docstring = False
napoleon_use_ivar = False

# ---- Looks ----

html_theme = "furo"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_copy_source = False
smartquotes = False  # texts of programs are quoted as they are
toc_object_entries_show_parents = "hide"
html_show_sphinx = False


def add_contents(_app, page, source):
    """Puts the table of contents behind the text of a page, which has none where a forge shows it."""
    for caption, entries in CONTENTS.get(page, {}).items():
        lines = [re.sub(r"^(.*<)?", r"\g<0>/", entry) for entry in entries.split(", ")]
        fence = ["", "```{toctree}", ":hidden:", ":glob:", f":caption: {caption}" if caption else "", *lines, "```", ""]
        source[0] += "\n\n" + "\n".join(line for line in fence if line) + "\n"


def leave_out_of_contents(_app, page, source):
    """Each decision, which the page of all of them leads to; with all in it the navigation takes a third longer."""
    if page.startswith("docs/decisions/0"):
        source[0] = "---\norphan: true\n---\n" + source[0]


def setup(app):
    app.connect("source-read", add_contents)
    app.connect("source-read", leave_out_of_contents)
