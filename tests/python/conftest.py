"""What the tests of the Python package share: scenarios in a folder of their own."""

import os
from pathlib import Path

import pytest

pytest_plugins = ["pytester"]

_SCENARIO = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription name="test" version="2.0"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
<ssd:System name="root"><ssd:Elements>
{components}
</ssd:Elements><ssd:Connections>
{connections}
</ssd:Connections></ssd:System><ssd:DefaultExperiment stopTime="1"/>
<ssd:Annotations><ssc:Annotation type="org.stride">
<stride:Scenario xmlns:stride="urn:org.stride:scenario:1"><stride:Step size="0.125"/>
{annotation}
</stride:Scenario></ssc:Annotation></ssd:Annotations>
</ssd:SystemStructureDescription>
"""


def scenario(components, connections="", annotation=""):
    """The text of a scenario; components are "name=unit", connections "a.y>b.u"."""
    parts = [each.split("=") for each in components.split()]
    ends = [[end.split(".", 1) for end in each.split(">")] for each in connections.split()]
    return _SCENARIO.format(
        components="\n".join(f'<ssd:Component name="{name}" source="{unit}.fmu"/>' for name, unit in parts),
        connections="\n".join(
            f'<ssd:Connection startElement="{a}" startConnector="{x}" endElement="{b}" endConnector="{y}"/>'
            for (a, x), (b, y) in ends
        ),
        annotation=annotation,
    )


CHECKS = """<stride:Checks>
<stride:Always name="it does not overshoot" signal="second.y" min="0" max="1"/>
<stride:Eventually signal="second.y" min="0.2"/>
</stride:Checks>"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A working folder with two filters in a row, test.ssd, whose first input is 0."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "test.ssd").write_text(
        scenario("first=minimal second=minimal", "first.y>second.u", CHECKS), encoding="utf-8"
    )
    return tmp_path


@pytest.fixture
def types(tmp_path, monkeypatch):
    """A working folder with a unit that echoes all types, types.ssd."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "types.ssd").write_text(scenario("types=types"), encoding="utf-8")
    return tmp_path


def processes_below(pid=None):
    """The processes whose ancestor is this one."""
    below = {pid or os.getpid()}
    parents = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                fields = (entry / "stat").read_text().rpartition(")")[2].split()
            except OSError:
                continue
            parents[int(entry.name)] = int(fields[1])
    found = set()
    while more := {child for child, parent in parents.items() if parent in below | found} - found:
        found |= more
    return found
