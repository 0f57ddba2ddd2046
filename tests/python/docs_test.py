"""The examples of docs/python.md: blocks of ```pycon, one after another, in a folder with the files of the pages."""

import doctest
import os
import re
from pathlib import Path

_DOCS = Path(os.environ["STRIDE_DOCS"])
_FILE = re.compile(r"<!-- test: (?:file|scenario) (\S+) -->\n+```\w*\n(.*?)^```$", re.DOTALL | re.MULTILINE)
_BLOCK = re.compile(r"^```pycon\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def write_files(page, folder):
    for name, text in _FILE.findall(page.read_text(encoding="utf-8")):
        (folder / (name if "." in name else f"{name}.ssd")).write_text(text, encoding="utf-8")


def test_python_md(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    page = _DOCS / "python.md"
    for source in ("scenario.md", "campaigns.md", "python.md"):
        write_files(_DOCS / source, tmp_path)
    blocks = _BLOCK.findall(page.read_text(encoding="utf-8"))
    assert blocks
    flags = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
    parsed = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, page.name, str(page), 0)
    failed, tried = doctest.DocTestRunner(optionflags=flags).run(parsed)
    assert tried and not failed


def test_its_tests_pass(pytester):
    """Those of the page's chapter about pytest."""
    for source in ("scenario.md", "campaigns.md", "python.md"):
        write_files(_DOCS / source, pytester.path)
    result = pytester.runpytest("-p", "stride.pytest_plugin", "test_filters.py")
    result.assert_outcomes(passed=9)
