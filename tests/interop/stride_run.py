"""Runs of stride as tests see them: a system as units and wires, written as an SSP file, and the table that comes out."""

import csv
import dataclasses
import math
import os
import pathlib
import shutil
import subprocess
from fractions import Fraction
from xml.sax.saxutils import quoteattr

HEAD = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription version="1.0" name="system"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssd:System name="system">
"""


@dataclasses.dataclass
class System:
    """Units by name, wires from "a.y" to "b.u", start values by "a.parameter"; times in seconds as decimals."""
    units: dict
    wires: list = dataclasses.field(default_factory=list)
    start_values: dict = dataclasses.field(default_factory=dict)
    step: str = "0.1"
    stop: str = "1"
    types: dict = dataclasses.field(default_factory=dict)  # "Real" for "a.y": its connector is declared
    transformations: dict = dataclasses.field(default_factory=dict)  # functions of values by "b.u"; not in the file

    def points(self):
        """The communication points, exact."""
        step, stop = Fraction(self.step), Fraction(self.stop)
        return [min(k * step, stop) for k in range(math.ceil(stop / step) + 1)]

    def ssd(self, portable=False):
        """The system as an SSP 1.0 file without any annotation. A portable one has the sources as they are, and the start
        values in it."""
        lines = ["    <ssd:Elements>"]
        for name, path in self.units.items():
            source = str(path) if portable else pathlib.Path(path).resolve().as_uri()
            lines += [f"      <ssd:Component name={quoteattr(name)} source={quoteattr(source)}",
                      '          type="application/x-fmu-sharedlibrary" implementation="CoSimulation">']
            lines += self._connectors(name)
            lines += self._values(name) if portable else []
            lines.append("      </ssd:Component>")
        lines.append("    </ssd:Elements>")
        if self.wires:
            lines.append("    <ssd:Connections>")
            for source, target in self.wires:
                start, end = source.split(".", 1), target.split(".", 1)
                lines.append(f"      <ssd:Connection startElement={quoteattr(start[0])} startConnector={quoteattr(start[1])}"
                             f" endElement={quoteattr(end[0])} endConnector={quoteattr(end[1])}/>")
            lines.append("    </ssd:Connections>")
        return HEAD + "\n".join(lines) + "\n  </ssd:System>\n</ssd:SystemStructureDescription>\n"

    def _connectors(self, component):
        inputs = {target for _, target in self.wires}
        lines = [f'          <ssd:Connector name={quoteattr(name.split(".", 1)[1])} '
                 f'kind="{"input" if name in inputs else "output"}"><ssc:{kind}/></ssd:Connector>'
                 for name, kind in self.types.items() if name.split(".", 1)[0] == component]
        return ["        <ssd:Connectors>", *lines, "        </ssd:Connectors>"] if lines else []

    def _values(self, component):
        """The start values of a component, as a set in the file."""
        kinds = {bool: "Boolean", int: "Integer", float: "Real", str: "String"}
        parameters = [f"<ssv:Parameter name={quoteattr(name.split('.', 1)[1])}>"
                      f"<ssv:{kinds[type(value)]} value={quoteattr(text_of(value))}/></ssv:Parameter>"
                      for name, value in self.start_values.items() if name.split(".", 1)[0] == component]
        if not parameters:
            return []
        return ["        <ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues>",
                '          <ssv:ParameterSet version="1.0" name="values"',
                '              xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues"><ssv:Parameters>',
                *(f"            {parameter}" for parameter in parameters),
                "          </ssv:Parameters></ssv:ParameterSet>",
                "        </ssd:ParameterValues></ssd:ParameterBinding></ssd:ParameterBindings>"]


class RunFailed(Exception):
    """What stride printed when it did not end well."""


def read_table(path):
    """signals.csv as columns of texts by "component.variable", without the units; strings without quotation marks."""
    with open(path, encoding="utf-8", newline="") as file:
        names, *rows = csv.reader(file)
    names = [name.partition(" [")[0] for name in names]
    return {name: [row[i] for row in rows] for i, name in enumerate(names)}


def run_file(program, ssd, folder, *options, environment=None):
    """The results of a run of an SSP file. Raises RunFailed."""
    result = subprocess.run([program, "run", str(ssd), "--quiet", "--out", str(folder), *options], text=True, check=False,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, env={**os.environ, **(environment or {})})
    if result.returncode != 0:
        raise RunFailed(f"exit code {result.returncode}: {result.stderr.strip()}")
    return read_table(pathlib.Path(folder) / "signals.csv")


def text_of(value):
    """A start value as stride reads it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return " ".join(map(text_of, value)) if isinstance(value, list) else str(value)


def run_system(program, system, folder, *options, environment=None):
    """The results of a run of a System, whose file is left in the folder for whoever looks into a failure."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    ssd = pathlib.Path(folder) / "system.ssd"
    ssd.write_text(system.ssd(), encoding="utf-8")
    settings = [f"--set={name}={text_of(value)}" for name, value in system.start_values.items()]
    return run_file(program, ssd, folder, "--step", system.step, "--stop", system.stop, *settings, *options,
                    environment=environment)


def same(ours, expected, tolerance):
    """Whether a text of the table stands for the value; numbers may differ by the tolerance, relative beyond 1."""
    if isinstance(expected, bool):
        return ours == ("true" if expected else "false")
    if isinstance(expected, bytes):
        return ours == expected.hex()
    if isinstance(expected, str):
        return ours == expected
    if isinstance(expected, int):
        return int(ours) == expected
    return abs(float(ours) - expected) <= tolerance * max(1.0, abs(expected))


def differences(ours, expected, tolerance=0.0):
    """What is wrong with our table, as texts: expected = {"time": [...], "a.y": [...]} at some of our times."""
    times = [float(time) for time in ours["time"]]
    rows = []
    for time in expected["time"]:
        near = min(range(len(times)), key=lambda i, time=time: abs(times[i] - time))
        if abs(times[near] - time) > 1e-9:
            return [f"there is no row at {time} s, the nearest is at {times[near]} s"]
        rows.append(near)
    found = [f"there is no column '{name}'" for name in expected if name not in ours]
    for name in expected.keys() & ours.keys() - {"time"}:
        for row, time, value in zip(rows, expected["time"], expected[name]):
            if not same(ours[name][row], value, tolerance):
                found.append(f"{name} at {time} s is {ours[name][row]}, expected {value!r}")
                break
    return sorted(found)
