#!/usr/bin/env python3
"""Nanoseconds per unit step of `stride run`, with its defaults, beside a hand-written loop of the same FMI calls.

Usage: run_bench.py PROGRAM BY_HAND UNITS [--short]

PROGRAM is stride, BY_HAND the loop of by_hand.cpp, UNITS the folder with `relay.fmu`, `relay_with_state.fmu` and
`kit_relay.fmu`. Each ring of units, in which each feeds the next one, runs at two lengths without files of results; the
difference of the wall times, divided by that of the unit steps, leaves out what happens once. Both programs take turns,
so that a machine that changes its speed changes it for both; the medians of the ratios and of the times are printed.
What counts is the ratio. The Reference-FMUs for FMI 3.0 are measured, too, if STRIDE_REFERENCE_FMUS names their
folder. A second table compares by hand a unit in C to the same one made with the unit kit. `--short` makes a few steps
only, and tests that all of this runs.
"""

import argparse
import os
import platform
import statistics
import subprocess
import tempfile
import time
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

STEP = 0.1
SIZES = (1, 2, 10, 100, 1000)
UNIT_STEPS = 4_000_000  # of the difference between the two lengths
ROUNDS = 5

SYSTEM = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon" version="1.0" name="ring">
  <ssd:System name="ring">
    <ssd:Elements>
{components}    </ssd:Elements>
    <ssd:Connections>
{connections}    </ssd:Connections>
  </ssd:System>
  <ssd:Annotations>
    <ssc:Annotation type="org.stride">
      <stride:Scenario xmlns:stride="urn:org.stride:scenario:1">
        <stride:Step size="{step}"/>
        <stride:Results signals="none" events="none" trace="none" activity="none" statistics="none" report="none"/>
      </stride:Scenario>
    </ssc:Annotation>
  </ssd:Annotations>
</ssd:SystemStructureDescription>
"""


class Unit:
    """An FMU with an output and, for a ring, an input of type Float64. `parameter`: (name, value)."""

    def __init__(self, fmu, input_name, output_name, folder, parameter=None):
        self.fmu, self.input, self.output = fmu.resolve(), input_name, output_name
        self.name = fmu.stem
        target = folder / self.name
        with zipfile.ZipFile(fmu) as archive:
            archive.extractall(target)
        description = ElementTree.parse(target / "modelDescription.xml").getroot()
        identifier = description.find("CoSimulation").get("modelIdentifier")
        self.token = description.get("instantiationToken")
        self.library = target / "binaries" / f"{platform.machine()}-linux" / f"{identifier}.so"
        references = {v.get("name"): v.get("valueReference") for v in description.find("ModelVariables")}
        self.references = [references.get(input_name, "none"), references[output_name]]
        self.parameter = [] if parameter is None else [f"{references[parameter[0]]}={parameter[1]}"]
        self.settings = [] if parameter is None else [f"--set=u0.{parameter[0]}={parameter[1]}"]


def write_ring(unit, file, size):
    components = "".join(f'      <ssd:Component name="u{i}" source="{unit.fmu.as_uri()}"/>\n' for i in range(size))
    connections = "" if unit.input is None else "".join(
        f'      <ssd:Connection startElement="u{i}" startConnector="{unit.output}" '
        f'endElement="u{(i + 1) % size}" endConnector="{unit.input}"/>\n' for i in range(size))
    file.write_text(SYSTEM.format(components=components, connections=connections, step=STEP))


def time_by_hand(by_hand, unit, size, steps):
    """[ns] a unit step"""
    arguments = [unit.library, unit.token, *unit.references, str(size), str(steps), str(STEP), *unit.parameter]
    return float(subprocess.run([by_hand, *arguments], check=True, capture_output=True, text=True).stdout)


def wall_time(program, system, steps, folder, settings=()):
    stop = f"{steps * STEP:.1f}"
    began = time.perf_counter()
    subprocess.run([program, "run", system, "--stop", stop, "--out", folder / "results", "--quiet", *settings],
                   check=True)
    return time.perf_counter() - began


def measure(program, by_hand, unit, size, unit_steps, rounds, folder):
    system = folder / f"{unit.name}_{size}.ssd"
    write_ring(unit, system, size)
    few = max(1, unit_steps // size // 10)
    many = few + max(1, unit_steps // size)
    pairs = []
    for _ in range(rounds):
        difference = (wall_time(program, system, many, folder, unit.settings) -
                      wall_time(program, system, few, folder, unit.settings))
        stride = 1e9 * difference / ((many - few) * size)
        pairs.append((stride, time_by_hand(by_hand, unit, size, many)))
    ratio = statistics.median(stride / hand for stride, hand in pairs)
    stride, hand = (statistics.median(times) for times in zip(*pairs))
    print(f"| {unit.name} | {size} | {hand:.1f} | {stride:.1f} | {ratio:.2f} |", flush=True)


def measure_kit(by_hand, units, unit_steps, rounds, folder):
    """What the unit kit adds to the three calls of a unit in C, without stride."""
    bare, kit = (Unit(units / f"{name}.fmu", "u", "y", folder) for name in ("relay", "kit_relay"))
    for size in (1, 100):
        steps = max(1, unit_steps // size)
        pairs = [(time_by_hand(by_hand, bare, size, steps), time_by_hand(by_hand, kit, size, steps))
                 for _ in range(rounds)]
        in_c, with_kit = (statistics.median(times) for times in zip(*pairs))
        print(f"| {size} | {in_c:.1f} | {with_kit:.1f} |", flush=True)


def units_of(folder, unpacked):
    yield Unit(folder / "relay.fmu", "u", "y", unpacked), SIZES
    yield Unit(folder / "relay_with_state.fmu", "u", "y", unpacked), SIZES
    reference = os.environ.get("STRIDE_REFERENCE_FMUS")
    if reference is None:
        return
    yield Unit(Path(reference) / "3.0" / "Dahlquist.fmu", None, "x", unpacked, ("k", 0)), SIZES[:1]
    yield Unit(Path(reference) / "3.0" / "Feedthrough.fmu", "Float64_continuous_input", "Float64_continuous_output",
               unpacked), SIZES[1:]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program", type=Path)
    arguments.add_argument("by_hand", type=Path)
    arguments.add_argument("units", type=Path)
    arguments.add_argument("--short", action="store_true")
    request = arguments.parse_args()
    unit_steps, rounds = (100, 1) if request.short else (UNIT_STEPS, ROUNDS)
    print("| unit | units in the ring | by hand [ns] | stride run [ns] | ratio |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for unit, sizes in units_of(request.units, folder):
            for size in sizes[:2] if request.short else sizes:
                measure(request.program.resolve(), request.by_hand.resolve(), unit, size, unit_steps, rounds, folder)
        print("\n| units in the ring | by hand, relay in C [ns] | with the unit kit [ns] |\n|---|---|---|")
        measure_kit(request.by_hand.resolve(), request.units, unit_steps, rounds, folder)


if __name__ == "__main__":
    main()
