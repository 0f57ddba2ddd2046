#!/usr/bin/env python3
"""How the time to load and check a system grows with its size: ten times the size should take ten times as long.

Usage: load_bench.py PROGRAM [--short]

PROGRAM is stride, which finds the unit `minimal`. Each kind of system is measured with n and 10 n parts, in turn, three
times; the ratio of the shortest times is printed. `--short` uses small systems and only tests that they load.
"""

import argparse
import subprocess
import tempfile
import time
from pathlib import Path

HEAD = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues" version="1.0" name="large">
  <ssd:System name="large">
"""
TAIL = """  </ssd:System>
  <ssd:DefaultExperiment startTime="0" stopTime="1"/>
</ssd:SystemStructureDescription>
"""


def elements(names):
    components = "".join(f'<ssd:Component name="{name}" source="minimal.fmu"/>\n' for name in names)
    return f"<ssd:Elements>\n{components}</ssd:Elements>\n"


def ring(count):
    connections = "".join(
        f'<ssd:Connection startElement="c{i}" startConnector="y" endElement="c{(i + 1) % count}" endConnector="u"/>\n'
        for i in range(count))
    return elements(f"c{i}" for i in range(count)) + f"<ssd:Connections>\n{connections}</ssd:Connections>\n"


def parameters(count):
    values = "".join(f'<ssv:Parameter name="c{i}.time_constant"><ssv:Real value="2"/></ssv:Parameter>\n'
                     for i in range(count))
    return ("<ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues>\n"
            f'<ssv:ParameterSet version="1.0" name="p"><ssv:Parameters>\n{values}</ssv:Parameters></ssv:ParameterSet>\n'
            "</ssd:ParameterValues></ssd:ParameterBinding></ssd:ParameterBindings>\n"
            + elements(f"c{i}" for i in range(count)))


KINDS = {"components and connections": ring, "components and parameters": parameters}


def seconds(program, file):
    began = time.perf_counter()
    subprocess.run([program, "check", file], check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - began


def measure(program, folder, kind, sizes):
    files = []
    for size in sizes:
        files.append(Path(folder) / f"{size}.ssd")
        files[-1].write_text(HEAD + KINDS[kind](size) + TAIL)
    return [min(times) for times in zip(*([seconds(program, file) for file in files] for _ in range(3)))]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program", type=Path)
    arguments.add_argument("--short", action="store_true")
    request = arguments.parse_args()
    small = 20 if request.short else 10_000
    with tempfile.TemporaryDirectory() as folder:
        for kind in KINDS:
            few, many = measure(request.program.resolve(), folder, kind, [small, 10 * small])
            print(f"{kind}: {10 * small} of each take {many:.2f} s, {many / few:.1f} times as long as {small}")


if __name__ == "__main__":
    main()
