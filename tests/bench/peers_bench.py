#!/usr/bin/env python3
"""Nanoseconds per unit step of `stride run` beside those of other masters, on the same FMU.

Usage: peers_bench.py PROGRAM UNITS [--short]

PROGRAM is stride, UNITS the folder with `kit_relay.fmu`. The units form a ring, in which each feeds the next one.
The others are what this Python can import: FMPy, by the loop of its calls that its users write for more than one FMU,
and libcosim, by libcosimpy, with the fixed-step algorithm and the threads that are its defaults. libcosim knows FMI 2.0
alone; it is measured on the Reference-FMU Feedthrough, if the environment variable STRIDE_REFERENCE_FMUS names their
folder. All take turns, and each is measured at two lengths, whose difference leaves
out what happens once; the medians are printed. `--short` makes a few steps only, and tests that all of this runs.
"""

import argparse
import importlib.util
import os
import statistics
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

from run_bench import STEP, wall_time, write_ring

SIZES = (1, 2, 10)
UNIT_STEPS = 200_000
ROUNDS = 3
PEERS = {"FMPy": "fmpy", "libcosim": "libcosimpy"}  # by what is imported


class Unit:
    """An FMU with an input and an output of 64 bits; `references` are those of the two."""

    def __init__(self, fmu, input_name, output_name):
        self.fmu, self.input, self.output, self.name = fmu.resolve(), input_name, output_name, fmu.stem
        with zipfile.ZipFile(fmu) as archive:
            description = ElementTree.fromstring(archive.read("modelDescription.xml"))
        variables = {v.get("name"): int(v.get("valueReference")) for v in description.find("ModelVariables")}
        self.references = [variables[input_name], variables[output_name]]


# ---- Each peer in a process of its own: peers_bench.py --peer NAME FMU INPUT OUTPUT SIZE STEPS prints seconds ----


def fmpy_unit(description, folder, name):
    """The unit, in Step Mode, and its functions that get and set values."""
    from fmpy.fmi2 import FMU2Slave
    from fmpy.fmi3 import FMU3Slave
    is_fmi3 = description.fmiVersion.startswith("3")
    unit = (FMU3Slave if is_fmi3 else FMU2Slave)(
        guid=description.guid, unzipDirectory=folder, modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName=name)
    unit.instantiate()
    if not is_fmi3:
        unit.setupExperiment(startTime=0)
    unit.enterInitializationMode()
    unit.exitInitializationMode()
    return (unit, unit.getFloat64, unit.setFloat64) if is_fmi3 else (unit, unit.getReal, unit.setReal)


def run_fmpy(fmu, input_reference, output_reference, size, steps):
    from fmpy import extract, read_model_description
    description = read_model_description(fmu)
    folder = extract(fmu)
    units, getters, setters = zip(*(fmpy_unit(description, folder, f"u{i}") for i in range(size)))
    began = time.perf_counter()
    for step in range(steps):
        for unit in units:
            unit.doStep(step * STEP, STEP)
        values = [get([output_reference]) for get in getters]
        for i, value in enumerate(values):
            setters[(i + 1) % size]([input_reference], value)
    return time.perf_counter() - began


def run_libcosim(fmu, input_reference, output_reference, size, steps):
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimSlave import CosimLocalSlave
    nanoseconds = round(STEP * 1e9)
    execution = CosimExecution.from_step_size(nanoseconds)
    units = [execution.add_local_slave(CosimLocalSlave(fmu, f"u{i}")) for i in range(size)]
    for i in range(size):
        execution.connect_real_variables(units[i], output_reference, units[(i + 1) % size], input_reference)
    execution.step()
    began = time.perf_counter()
    execution.simulate_until((steps + 1) * nanoseconds)
    return time.perf_counter() - began


RUNS = {"FMPy": run_fmpy, "libcosim": run_libcosim}


def peer_time(peer, unit, size, steps):
    arguments = [sys.executable, __file__, "--peer", peer, unit.fmu, *unit.references, size, steps]
    output = subprocess.run(list(map(str, arguments)), check=True, capture_output=True, text=True).stdout
    return float(output.splitlines()[-1])


def per_step(seconds_of, size, unit_steps):
    """[ns]; `seconds_of(steps)` makes a run."""
    few = max(1, unit_steps // size // 10)
    many = few + max(1, unit_steps // size)
    return 1e9 * (seconds_of(many) - seconds_of(few)) / ((many - few) * size)


def measure(program, unit, peers, size, unit_steps, rounds, folder):
    system = folder / f"{unit.name}_{size}.ssd"
    write_ring(unit, system, size)
    runs = {"stride": lambda steps: wall_time(program, system, steps, folder)}
    for peer in peers:
        runs[peer] = lambda steps, peer=peer: peer_time(peer, unit, size, steps)
    times = {name: [] for name in runs}
    for _ in range(rounds):
        for name, seconds_of in runs.items():
            times[name].append(per_step(seconds_of, size, unit_steps))
    medians = {name: statistics.median(values) for name, values in times.items()}
    for peer in peers:
        print(f"| {unit.name} | {size} | {medians['stride']:.0f} | {peer} | {medians[peer]:.0f} "
              f"| {medians[peer] / medians['stride']:.1f} |", flush=True)


def cases(units):
    """Each unit with the peers that take it."""
    yield Unit(units / "kit_relay.fmu", "u", "y"), ["FMPy"]
    reference = os.environ.get("STRIDE_REFERENCE_FMUS")
    if reference is not None:
        yield Unit(Path(reference) / "2.0" / "Feedthrough.fmu", "Float64_continuous_input",
                   "Float64_continuous_output"), list(PEERS)


def main():
    if sys.argv[1:2] == ["--peer"]:
        peer, fmu, *numbers = sys.argv[2:]
        print(RUNS[peer](fmu, *map(int, numbers)))
        return
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program", type=Path)
    arguments.add_argument("units", type=Path)
    arguments.add_argument("--short", action="store_true")
    request = arguments.parse_args()
    unit_steps, rounds = (100, 1) if request.short else (UNIT_STEPS, ROUNDS)
    present = [peer for peer, module in PEERS.items() if importlib.util.find_spec(module)]
    for peer in PEERS.keys() - set(present):
        print(f"skipped: {peer}, since this Python has no {PEERS[peer]}")
    print("| unit | units in the ring | stride run [ns] | other | other [ns] | ratio |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as temporary:
        for unit, peers in cases(request.units):
            chosen = [peer for peer in peers if peer in present]
            for size in SIZES[:1] if request.short else SIZES:
                measure(request.program.resolve(), unit, chosen, size, unit_steps, rounds, Path(temporary))


if __name__ == "__main__":
    main()
