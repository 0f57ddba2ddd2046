"""The examples of docs/python.md and docs/export.md: blocks of ```pycon, one after another, in a folder with the files
of the pages, and sessions with the commands of the package."""

import doctest
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

_DOCS = Path(os.environ["STRIDE_DOCS"])
_FILE = re.compile(r"<!-- test: (?:file|scenario) (\S+) -->\n+```\w*\n(.*?)^```$", re.DOTALL | re.MULTILINE)
_SESSION = re.compile(r"^<!-- test: session \S+ -->\n+```console\n(.*?)^```$", re.DOTALL | re.MULTILINE)
_BLOCK = re.compile(r"^```pycon\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def write_files(page, folder):
    for name, text in _FILE.findall(page.read_text(encoding="utf-8")):
        (folder / (name if "." in name else f"{name}.ssd")).write_text(text, encoding="utf-8")


@pytest.mark.parametrize("name", ["python.md", "export.md"])
def test_blocks(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    page = _DOCS / name
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


def test_the_sessions_of_export_md(tmp_path, monkeypatch):
    write_files(_DOCS / "scenario.md", tmp_path)
    programs = tmp_path / "bin"
    programs.mkdir()
    (programs / "stride").write_text(f'#!/bin/sh\nexec "{sys.executable}" -m stride "$@"\n')
    (programs / "stride").chmod(0o755)
    monkeypatch.setenv("PATH", f"{programs}{os.pathsep}{os.environ['PATH']}")
    text = "".join(_SESSION.findall((_DOCS / "export.md").read_text(encoding="utf-8")))
    commands = text.removeprefix("$ ").split("\n$ ")
    assert len(commands) == 3
    for each in commands:
        command, _, expected = each.partition("\n")
        done = subprocess.run(
            ["bash", "-c", command], cwd=tmp_path, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
        )
        assert done.stdout.strip() == expected.strip(), command
