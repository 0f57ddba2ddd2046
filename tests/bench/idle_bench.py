#!/usr/bin/env python3
"""What idle skipping saves: the same runs with and without it, in turn, in one go.

Usage: idle_bench.py PROGRAM SCENARIOS [--short] [--hour]

PROGRAM is stride, SCENARIOS the folder of the project's scenarios in the build or source tree whose units PROGRAM
finds. The device's clock of 50 MHz runs whenever it has power (control_unit.clock_gating=false), as in the paper. What
counts is the ratio. A trace without skipping would have gigabytes, so its size is scaled from its first milliseconds.
"""

import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

DEVICE = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon"
    xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues" version="1.0" name="idle_device">
  <ssd:System name="idle_device">
    <ssd:Elements>
      <ssd:Component name="sensor" source="sensor.fmu" type="application/x-fmu-sharedlibrary"/>
    </ssd:Elements>
    <ssd:ParameterBindings>
      <ssd:ParameterBinding>
        <ssd:ParameterValues>
          <ssv:ParameterSet version="1.0" name="charged">
            <ssv:Parameters>
              <ssv:Parameter name="sensor.power.initial_voltage"><ssv:Real value="4.5"/></ssv:Parameter>
            </ssv:Parameters>
          </ssv:ParameterSet>
        </ssd:ParameterValues>
      </ssd:ParameterBinding>
    </ssd:ParameterBindings>
  </ssd:System>
</ssd:SystemStructureDescription>
"""
BOOT = 0.0012  # [s]
FREE_RUNNING = ["--set", "sensor.control_unit.clock_gating=false"]


class Run:
    """One run of a scenario: wall-clock time [s], peak memory [bytes], statistics, and its results."""

    def __init__(self, program, scenario, folder, stop, skips, trace=None, further=()):
        command = [program, "run", str(scenario), "--quiet", "--no-trace", "--out", str(folder), *FREE_RUNNING, *further]
        if stop is not None:
            command += ["--stop", repr(stop)]
        if not skips:
            command.append("--no-idle-skip")
        if trace is not None:
            command += ["--set", f"sensor.trace.file={trace}"]
        began = time.monotonic()
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        self.seconds = time.monotonic() - began
        if status != 0:
            sys.exit(f"failed with status {status}: {' '.join(command)}")
        self.memory = usage.ru_maxrss * 1024
        self.statistics = json.loads((folder / "run.json").read_text())
        self.wall = self.statistics["wall_time"]
        self.folder = folder

    def sensor(self):
        return next(unit for unit in self.statistics["units"] if unit["name"] == "sensor")

    def last_row(self):
        with open(self.folder / "signals.csv", newline="") as file:
            rows = list(csv.reader(file))
        return dict(zip(rows[0], rows[-1]))

    def messages(self):
        return (self.folder / "events.csv").read_text()


def ratio(a, b):
    return f"{a / b:.3g}" if b > 0 else "-"


def charge_error(skipped, full):
    column = next(name for name in full if name.startswith("sensor.capacitor.charge"))
    reference = float(full[column])
    return abs(float(skipped[column]) - reference) / abs(reference)


def compare(name, program, scenario, stop, work, further=()):
    full = Run(program, scenario, work / "full", stop, False, further=further)
    skipped = Run(program, scenario, work / "skipped", stop, True, further=further)
    print(f"{name}")
    print(f"  wall-clock time of the run  {full.wall:.4g} s : {skipped.wall:.4g} s = {ratio(full.wall, skipped.wall)}")
    print(f"  ... of the whole program    {full.seconds:.4g} s : {skipped.seconds:.4g} s"
          f" = {ratio(full.seconds, skipped.seconds)}")
    print(f"  peak memory                 {full.memory / 1e6:.4g} MB : {skipped.memory / 1e6:.4g} MB"
          f" = {ratio(full.memory, skipped.memory)}")
    idle = skipped.sensor().get("idle", {"rests": 0, "skipped": 0, "longest": 0})
    print(f"  sensor left alone           {idle['rests']} times, {idle['skipped']:.6g} s in all,"
          f" {idle['longest']:.6g} s at most")
    print(f"  error of the charge         {charge_error(skipped.last_row(), full.last_row()):.2g}, relative, at the end")
    print(f"  messages                    {'the same' if skipped.messages() == full.messages() else 'DIFFERENT'}")
    return skipped.messages() == full.messages()


def traced(program, scenario, stop, skips, work):
    """A run with all the device's signals traced: its wall-clock time, the trace's size, its kernel and true time."""
    trace = work / "device.vcd"
    run = Run(program, scenario, work / "traced", stop, skips, trace=trace)
    info = subprocess.run([program, "trace", "info", str(trace)], check=True, capture_output=True, text=True).stdout
    times = dict(line.split("  ", 2)[1:] for line in info.splitlines() if line.endswith(" s"))
    kernel, true = (float(times[name].split()[0]) for name in ("kernel time", "true time"))
    return run.wall, trace.stat().st_size, kernel, true


def compare_traces(program, scenario, idle, sample, work):
    """The device boots when the run begins; what that costs is taken off."""
    boot = traced(program, scenario, BOOT, True, work)
    whole = traced(program, scenario, BOOT + idle, True, work)
    full_boot = traced(program, scenario, BOOT, False, work)
    full = traced(program, scenario, BOOT + sample, False, work)
    scale = idle / sample
    print(f"trace of {idle} s of idle time, without that of the boot; without skipping scaled from {sample} s")
    size = (full[1] - full_boot[1]) * scale
    print(f"  bytes                       {size:.4g} : {whole[1] - boot[1]} = {ratio(size, whole[1] - boot[1])}")
    kernel = whole[2] - boot[2]
    print(f"  trace time                  {idle} s : {kernel:.3g} s = {ratio(idle, max(kernel, 1e-12))}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("scenarios", type=Path)
    parser.add_argument("--short", action="store_true", help="milliseconds only, to see that it works")
    parser.add_argument("--hour", action="store_true", help="an hour of idle time, too, with skipping")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        device = work / "idle_device.ssd"
        device.write_text(DEVICE)
        idle, whole, sample = (0.02, 0.02, 0.001) if options.short else (7.1, None, 0.01)
        same = compare(f"{idle} s of idle time, the device alone", options.program, device, idle, work)
        compare_traces(options.program, device, idle, sample, work)
        flagship = options.scenarios / "nfc_approach" / "nfc_approach.ssd"
        # in milliseconds there is nothing yet to judge
        further = ("--set", "ground_truth.minimum_measurements=0") if options.short else ()
        same &= compare("nfc_approach", options.program, flagship, whole, work, further)
        if options.hour:
            hour = Run(options.program, device, work / "hour", 3600.0, True)
            print(f"an hour of idle time\n  wall-clock time of the run  {hour.wall:.4g} s")
    sys.exit(0 if same else 1)


main()
