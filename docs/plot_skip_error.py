#!/usr/bin/env python3
"""Draws how far a value is off that idle skipping has extrapolated, over the longest skip, as an SVG picture.

    docs/plot_skip_error.py [--program PROGRAM] > docs/images/skip_error.svg

The sensor lies on a table without a field for 20 s; its capacitor leaks and feeds a voltage-dependent load, so its
voltage is not a straight line. Beside it a unit that is never idle makes a communication point each millisecond. Each run
with skipping is compared with one without, for two tolerances. The error must stay below the remainder of a tangent,
max |V''| maxSkip^2 / 2, and below the tolerance, whichever is less; otherwise the program reports it and ends with
status 1. Needs nothing but Python.
"""

import argparse
import csv
import math
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPS = [0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0]  # [s]
TOLERANCES = {1e-3: "#1b6ca8", 1e-5: "#c53030"}  # of the voltage [V]
STOP, CAPACITANCE = 20.0, 100e-6
COLUMN = "sensor.capacitor.voltage [V]"
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 640, 420, 80, 20, 20, 60

SCENARIO = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription version="2.0" name="idle_sensor"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssd:System name="idle_sensor">
    <ssd:Elements>
      <ssd:Component name="sensor" type="application/x-fmu-sharedlibrary" source="sensor.fmu"/>
      <ssd:Component name="busy" type="application/x-fmu-sharedlibrary" source="minimal.fmu"/>
    </ssd:Elements>
    <ssd:Annotations>
      <ssc:Annotation type="org.stride">
        <stride:Scenario xmlns:stride="urn:org.stride:scenario:1">
          <stride:Tolerance variable="sensor.capacitor.voltage" value="{voltage}"/>
          <stride:Tolerance variable="sensor.supply.voltage" value="{voltage}"/>
          <stride:Tolerance variable="sensor.capacitor.charge" value="{charge}"/>
        </stride:Scenario>
      </ssc:Annotation>
    </ssd:Annotations>
  </ssd:System>
</ssd:SystemStructureDescription>
"""


def voltages(program, folder, tolerance, *options):
    """The capacitor's voltage [V] by the instants of the file."""
    scenario = folder / "idle_sensor.ssd"
    scenario.write_text(SCENARIO.format(voltage=tolerance, charge=tolerance * CAPACITANCE))
    subprocess.run([program, "run", scenario, "--quiet", "--no-trace", "--stop", str(STOP), "--out", folder / "out",
                    "--signals", "sensor.capacitor.voltage", "--set", f"sensor.power.capacitance={CAPACITANCE}",
                    "--set", "sensor.power.initial_voltage=3.3", *options], check=True)
    with open(folder / "out" / "signals.csv", newline="") as file:
        rows = csv.DictReader(file)
        return {float(row["time"]): float(row[COLUMN]) for row in rows}


def curvature(full):
    """The greatest second difference quotient while the device sleeps, after the first second."""
    step = 0.5
    times = [step * k for k in range(2, int(STOP / step))]
    return max(abs(full[t + step] - 2 * full[t] + full[t - step]) / step**2 for t in times if t - step >= 0.5)


class Axes:
    """Logarithmic ones."""

    def __init__(self, x_range, y_range):
        self.x_range, self.y_range = x_range, y_range

    def place(self, x, y):
        def share(value, least, most):
            return (math.log10(value) - math.log10(least)) / (math.log10(most) - math.log10(least))
        return (LEFT + (WIDTH - LEFT - RIGHT) * share(x, *self.x_range),
                HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * share(y, *self.y_range))

    def line(self, points, colour, dash=""):
        path = "L".join("{:.1f},{:.1f}".format(*self.place(*point)) for point in points)
        return f'<path d="M{path}" fill="none" stroke="{colour}" stroke-dasharray="{dash}"/>'

    def grid(self):
        parts = []
        for power in range(round(math.log10(self.x_range[0])), round(math.log10(self.x_range[1])) + 1):
            x, y = self.place(10.0**power, self.y_range[0])
            parts.append(f'<path d="M{x:.1f},{y:.1f}V{TOP}" stroke="#eee"/>'
                         f'<text x="{x:.1f}" y="{y + 18:.1f}" text-anchor="middle">{10.0**power:g} s</text>')
        for power in range(round(math.log10(self.y_range[0])), round(math.log10(self.y_range[1])) + 1, 2):
            x, y = self.place(self.x_range[0], 10.0**power)
            parts.append(f'<path d="M{x:.1f},{y:.1f}H{WIDTH - RIGHT}" stroke="#eee"/>'
                         f'<text x="{x - 8:.1f}" y="{y + 4:.1f}" text-anchor="end">{10.0**power:g} V</text>')
        return parts


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=Path(__file__).parents[1] / "build/release/bin/stride")
    program = parser.parse_args().program
    axes = Axes((1e-3, 10.0), (1e-12, 1e-2))
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-size="12" '
             'font-family="sans-serif">', f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>', *axes.grid()]
    exceeded = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        full = voltages(program, folder, 1e-3, "--no-idle-skip")
        bend = curvature(full)
        remainder = [(skip, bend * skip**2 / 2) for skip in SKIPS]
        parts.append(axes.line(remainder, "#999", "5 4"))
        for tolerance, colour in TOLERANCES.items():
            parts.append(axes.line([(SKIPS[0], tolerance), (SKIPS[-1], tolerance)], colour, "2 3"))
            for skip, tangent in remainder:
                skipped = voltages(program, folder, tolerance, "--max-skip", str(skip))
                error = max(abs(value - full[time]) for time, value in skipped.items())
                bound = min(1.05 * tangent + 1e-12, tolerance)  # the quotient is of half a second
                if error > bound:
                    exceeded.append(f"max-skip {skip} s, tolerance {tolerance} V: {error} V, at most {bound} V")
                x, y = axes.place(skip, max(error, 1e-12))
                parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{colour}" fill-opacity="0.7"/>')
            x, y = axes.place(SKIPS[0], tolerance)
            parts.append(f'<text x="{x + 6:.1f}" y="{y - 5:.1f}" fill="{colour}">tolerance {tolerance:g} V</text>')
    x, y = axes.place(0.03, bend * 0.03**2 / 2)
    parts.append(f'<text x="{x + 12:.1f}" y="{y + 12:.1f}" fill="#666">½ |V″| maxSkip²</text>')
    parts.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 14}" text-anchor="middle">maxSkip; dots: the '
                 'greatest error of the capacitor\'s voltage</text></svg>')
    print("\n".join(parts))
    if exceeded:
        sys.exit("the error exceeds its bound:\n  " + "\n  ".join(exceeded))


if __name__ == "__main__":
    main()
