#!/usr/bin/env python3
"""How many cases a search needs for a failure that was planted in nfc_approach, by method, over many seeds.

Usage: search_bench.py PROGRAM SCENARIOS UNITS [--seeds N] [--runs N] [--methods NAME...] [--jobs N] [--short]

PROGRAM is stride, SCENARIOS the folder of the project's scenarios, UNITS that of their units. The approach is that of
nfc_approach within 3 s instead of 30 s, with its units, arm and poses: at 1.3 s the sensor is told to light its LED, at
1.5 s it is asked for its temperature. The second command may come late, the arm may be turned beside its place, and
hold the reader askew. Each of the three is harmless by itself, and so are two of them: the failure needs a turn and a
tilt that add up, so that little power arrives, and nearly the longest delay, so that the LED empties the capacitor.

What counts is the number of cases, which depends neither on the machine nor on its load. Of a search that has found
nothing with --runs cases, that number counts, which flatters the method.
"""

import argparse
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import zipfile

MOTION = """<motion>
    <waypoint at="0" pose="start"/>
    <waypoint at="1" pose="at_6_cm"/>
    <waypoint at="1.6" pose="at_5_cm"/>
  </motion>
  <antenna on="1.1" off="3" power="0.5"/>
  <command at="1.3" name="set_led" led="on"/>
  <command at="1.5" name="read_temperature" timeout="1"/>
</reader-program>"""
CHECKS = """<stride:Checks>
          <stride:Until name="it has power until it has answered" signal="sensor.capacitor.voltage" min="1.92" from="1.1">
            <stride:Condition signal="reader.measured.temperature" min="10"/>
          </stride:Until>
        </stride:Checks>"""
CAMPAIGN = """<?xml version="1.0" encoding="UTF-8"?>
<OpenSCENARIO>
  <FileHeader revMajor="1" revMinor="1" date="2026-01-01T00:00:00" author="stride" description="A planted failure"/>
  <ParameterValueDistribution>
    <ScenarioFile filepath="nfc_approach.ssd"/>
    <Stochastic numberOfTestRuns="1000" randomSeed="1">
      <StochasticDistribution parameterName="reader.waypoint_offset.base">
        <UniformDistribution><Range lowerLimit="-0.04" upperLimit="0.04"/></UniformDistribution>
      </StochasticDistribution>
      <StochasticDistribution parameterName="reader.waypoint_offset.wrist_2">
        <UniformDistribution><Range lowerLimit="-0.1" upperLimit="0.1"/></UniformDistribution>
      </StochasticDistribution>
      <StochasticDistribution parameterName="late.time">
        <UniformDistribution><Range lowerLimit="0" upperLimit="0.28"/></UniformDistribution>
      </StochasticDistribution>
    </Stochastic>
  </ParameterValueDistribution>
  <stride:Campaign xmlns:stride="urn:org.stride:campaign:1">
    <stride:Keep results="none"/>
    <stride:Intervention name="late">
      <stride:Delay variable="channel.from_reader.clock" time="0.001" from="1.45" until="1.6"/>
    </stride:Intervention>
  </stride:Campaign>
</OpenSCENARIO>
"""


def replaced(pattern, by, text):
    text, count = re.subn(pattern, lambda _: by, text, flags=re.DOTALL)
    if count != 1:
        sys.exit(f"search_bench: '{pattern}' is {count} times in a file of nfc_approach, and not once")
    return text


def pack_reader(packed, folder, program):
    """The reader of nfc_approach with another program."""
    with zipfile.ZipFile(packed) as before, zipfile.ZipFile(folder / "hasty_reader.fmu", "w") as after:
        for name in before.namelist():
            after.writestr(name, program if name == "resources/program.xml" else before.read(name))


def write_campaign(scenarios, units, folder):
    source = scenarios / "nfc_approach"
    program = (source / "reader" / "program.xml").read_text(encoding="utf-8")
    pack_reader(units / "nfc_approach_reader.fmu", folder, replaced("<motion>.*</reader-program>", MOTION, program))
    text = (source / "nfc_approach.ssd").read_text(encoding="utf-8")
    text = replaced('"nfc_approach_reader.fmu"', '"hasty_reader.fmu"', text)
    text = replaced('stopTime="30"', 'stopTime="2.8"', text)
    text = replaced("<stride:Checks>.*</stride:Coverage>", CHECKS, text)
    (folder / "nfc_approach.ssd").write_text(text, encoding="utf-8")
    for name in ("sensor.ssv", "ground_truth.ssv"):
        (folder / name).write_bytes((source / name).read_bytes())
    (folder / "planted.xosc").write_text(CAMPAIGN, encoding="utf-8")


def search(arguments, folder, method, seed):
    """How many cases it has run, and whether it has found the failure."""
    command = [arguments.program.resolve(), "campaign", "search", "planted.xosc", "--out", f"{method}_{seed}",
               "--method", method, "--seed", seed, "--runs", arguments.runs, "--progress", "none"]
    if arguments.jobs:
        command += ["--jobs", arguments.jobs]
    result = subprocess.run([str(word) for word in command], cwd=folder, text=True, check=False, capture_output=True,
                            env={**os.environ, "STRIDE_UNITS": str(arguments.units.resolve())})
    line = re.search(r": (no|\d+) failures? found in (\d+) cases", result.stdout)
    if not line or result.returncode != (line.group(1) != "no"):
        sys.exit(f"search_bench: {method}, seed {seed}: exit code {result.returncode}\n{result.stdout}{result.stderr}")
    return int(line.group(2)), line.group(1) != "no"


def row(method, lengths, runs):
    counts = [count for count, _ in lengths]
    missed = sum(not is_found for _, is_found in lengths)
    text = f"{method:8}{statistics.median(counts):8g}{statistics.mean(counts):8.1f}{min(counts):6} to {max(counts)}"
    return text + (f", {missed} of {len(lengths)} found nothing in {runs}" if missed else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("scenarios", type=pathlib.Path)
    parser.add_argument("units", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--runs", type=int, default=800)
    parser.add_argument("--methods", nargs="+", default=["cma-es", "random"])
    parser.add_argument("--jobs", type=int)
    parser.add_argument("--short", action="store_true", help="one seed and few cases, to see that it works")
    arguments = parser.parse_args()
    if arguments.short:
        arguments.seeds, arguments.runs = 1, 10
    lengths = {method: [] for method in arguments.methods}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_campaign(arguments.scenarios, arguments.units, folder)
        for seed in range(1, arguments.seeds + 1):
            for method, counts in lengths.items():
                counts.append(search(arguments, folder, method, seed))
                print(f"seed {seed}: {method} {counts[-1][0]}{'' if counts[-1][1] else ', nothing found'}",
                      file=sys.stderr, flush=True)
    print(f"{'method':8}{'median':>8}{'mean':>8}  range of cases over {arguments.seeds} seeds")
    for method, counts in lengths.items():
        print(row(method, counts, arguments.runs))


if __name__ == "__main__":
    main()
