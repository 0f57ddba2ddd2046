#!/usr/bin/env python3
"""Draws what the unit nfc_channel gives over distance, lateral offset and tilt, from the unit itself.

    docs/plot_channel.py > docs/images/nfc_channel.svg
    docs/plot_channel.py --table            # the table in units/nfc_channel/README.md

--program names the program stride, build/release/bin/stride unless given. Each point of a curve is a channel of its own
in one scenario, which is run once. Needs nothing but Python.
"""

import argparse
import csv
import math
import subprocess
import tempfile
from pathlib import Path

CARRIER = 0.5  # W
TABLE = [0.02, 0.025, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.10, 0.14, 0.20]

HEAD = """<ssd:SystemStructureDescription version="2.0" name="sweep"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues">
  <ssd:System name="sweep"><ssd:Elements>
"""
TAIL = """  </ssd:Elements></ssd:System>
  <ssd:DefaultExperiment stopTime="0.001"/>
</ssd:SystemStructureDescription>
"""


def start_value(value):
    if isinstance(value, bool):
        return f'<ssv:Boolean value="{str(value).lower()}"/>'
    return f'<ssv:Enumeration value="{value}"/>' if isinstance(value, str) else f'<ssv:Float64 value="{value!r}"/>'


def component(index, unit, start_values):
    values = "".join(f'<ssv:Parameter name="{name}">{start_value(value)}</ssv:Parameter>'
                     for name, value in start_values.items())
    return (f'<ssd:Component name="p{index}" source="{unit}.fmu"><ssd:ParameterBindings><ssd:ParameterBinding>'
            f'<ssd:ParameterValues><ssv:ParameterSet version="2.0" name="p"><ssv:Parameters>{values}'
            '</ssv:Parameters></ssv:ParameterSet></ssd:ParameterValues></ssd:ParameterBinding>'
            '</ssd:ParameterBindings></ssd:Component>\n')


def pose(distance, lateral=0.0, tilt=0.0):
    """Start values of a tag above the reader's coil, tilted about the axis at right angles to the offset."""
    return {"carrier_power": CARRIER, "tag_coil.position.x": lateral, "tag_coil.position.z": distance,
            "tag_coil.axis.x": math.sin(tilt), "tag_coil.axis.z": math.cos(tilt)}


def run(program, poses, unit="nfc_channel"):
    """For each pose, which is the start values of a channel, its outputs by name."""
    with tempfile.TemporaryDirectory() as folder:
        scenario = Path(folder) / "sweep.ssd"
        scenario.write_text(HEAD + "".join(component(i, unit, p) for i, p in enumerate(poses)) + TAIL)
        subprocess.run([program, "run", scenario, "--out", Path(folder) / "out", "--signals", "*", "--no-trace", "--quiet"],
                       check=True)
        with open(Path(folder) / "out" / "signals.csv", newline="") as file:
            row = next(csv.DictReader(file))
    points = [{} for _ in poses]
    for title, value in row.items():
        name = title.split(" ")[0]
        if name.startswith("p") and "." in name:
            index, variable = name[1:].split(".", 1)
            points[int(index)][variable] = float(value) if value not in ("true", "false") else value == "true"
    return points


def text_of_power(watt):
    for factor, unit in ((1e3, "mW"), (1e6, "µW")):
        if watt * factor >= 0.95:
            return f"{watt * factor:.2g} {unit}" if watt * factor < 9.95 else f"{watt * factor:.0f} {unit}"
    return f"{watt * 1e6:.2f} µW"


def text_of_rate(rate):
    return "< 1e-12" if rate < 1e-12 else f"{rate:.1g}"


def table(program):
    yield "| distance | coupling | field | `tag_power` | `snr.down` | errors down | `snr.up` | errors up |"
    yield "|---|---|---|---|---|---|---|---|"
    for distance, p in zip(TABLE, run(program, [pose(d) for d in TABLE])):
        yield (f"| {distance * 100:g} cm | {p['coupling']:.4f} | {p['field_strength']:.2g} A/m | "
               f"{text_of_power(p['tag_power'])} | {p['snr.down']:.0f} dB | {text_of_rate(p['bit_error_rate.down'])} | "
               f"{p['snr.up']:.0f} dB | {text_of_rate(p['bit_error_rate.up'])} |")


class Panel:
    """Axes with a logarithmic ordinate."""
    WIDTH, HEIGHT = 330, 190

    def __init__(self, parts, left, top, title, x_range, x_step, x_label, decades):
        self.parts, self.left, self.top, self.x_range, self.decades = parts, left, top, x_range, decades
        self.text(left, top - 10, title, "start", "#000")
        for decade in range(decades[0], decades[1] + 1):
            y = self.y(10.0 ** decade)
            self.line(left, y, left + self.WIDTH, y, "#e2e8f0")
            self.text(left - 6, y + 4, f"1e{decade}" if decade else "1", "end")
        value = x_range[0]
        while value <= x_range[1] + 1e-9:
            self.line(self.x(value), top + self.HEIGHT, self.x(value), top + self.HEIGHT + 4, "#999")
            self.text(self.x(value), top + self.HEIGHT + 16, f"{value:g}", "middle")
            value += x_step
        self.line(left, top + self.HEIGHT, left + self.WIDTH, top + self.HEIGHT, "#999")
        self.text(left + self.WIDTH / 2, top + self.HEIGHT + 31, x_label, "middle")

    def x(self, value):
        return self.left + self.WIDTH * (value - self.x_range[0]) / (self.x_range[1] - self.x_range[0])

    def y(self, value):
        low, high = self.decades
        return self.top + self.HEIGHT * (high - math.log10(value)) / (high - low)

    def line(self, x1, y1, x2, y2, colour, dash=""):
        self.parts.append(f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" '
                          f'stroke-dasharray="{dash}"/>')

    def text(self, x, y, text, anchor, colour="#333"):
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}">{text}</text>')

    def level(self, value, text):
        self.line(self.left, self.y(value), self.left + self.WIDTH, self.y(value), "#a0aec0", "5,4")
        self.text(self.left + self.WIDTH - 4, self.y(value) - 4, text, "end", "#718096")

    def curve(self, points, colour, dash=""):
        inside = [(x, y) for x, y in points if y >= 10.0 ** self.decades[0] and self.x_range[0] <= x <= self.x_range[1]]
        shape = " ".join(f"{self.x(x):.1f},{self.y(y):.1f}" for x, y in inside)
        self.parts.append(f'<polyline points="{shape}" fill="none" stroke="{colour}" stroke-width="1.8" '
                          f'stroke-dasharray="{dash}"/>')

    def key(self, row, text, colour, x=None, y=None):
        x = self.left + 14 if x is None else x
        y = self.top + self.HEIGHT - 14 - 16 * row if y is None else y
        self.line(x, y - 4, x + 20, y - 4, colour)
        self.text(x + 26, y, text, "start")


def curves(xs, points, name):
    return [(x, p[name]) for x, p in zip(xs, points)]


def picture(program):
    distances = [0.001 * i for i in range(2, 251)]
    offsets = [0.001 * i for i in range(0, 101)]
    tilts = [math.radians(i) for i in range(0, 91)]
    heights = [(0.025, "#c05621"), (0.06, "#1b6ca8")]
    poses = [pose(d) for d in distances]
    for height, _ in heights:
        poses += [pose(height, lateral=x) for x in offsets] + [pose(height, tilt=t) for t in tilts]
    results = iter(run(program, poses))
    along = [next(results) for _ in distances]
    aside, tilted = {}, {}
    for height, _ in heights:
        aside[height] = [next(results) for _ in offsets]
        tilted[height] = [next(results) for _ in tilts]

    parts = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 860 566" font-size="12" font-family="sans-serif">',
             '<rect width="860" height="566" fill="#fff"/>']
    cm = [100 * d for d in distances]
    power = Panel(parts, 60, 40, "power at the tag [W], on the axis", (0, 25), 5, "distance [cm]", (-7, -1))
    power.level(1e-6, "the tag hears")
    power.level(5.5 ** 2 / 2 / 1500, "voltage limiter")
    power.curve(curves(cm, along, "tag_power"), "#c05621")

    errors = Panel(parts, 490, 40, "bit error rate at 106 kbit/s, on the axis", (0, 25), 5, "distance [cm]", (-10, 0))
    errors.curve(curves(cm, along, "bit_error_rate.up"), "#2f855a")
    errors.curve(curves(cm, along, "bit_error_rate.down"), "#c53030")
    errors.key(1, "tag to reader", "#2f855a", 690, 150)
    errors.key(0, "reader to tag", "#c53030", 690, 166)

    lateral = Panel(parts, 60, 310, "power at the tag [W], moved sideways", (0, 10), 2, "lateral offset [cm]", (-7, -1))
    turned = Panel(parts, 490, 310, "power at the tag [W], on the axis, tilted", (0, 90), 15, "tilt [degrees]", (-7, -1))
    for row, (height, colour) in enumerate(heights):
        lateral.curve(curves([100 * x for x in offsets], aside[height], "tag_power"), colour)
        turned.curve(curves([math.degrees(t) for t in tilts], tilted[height], "tag_power"), colour)
        for panel in (lateral, turned):
            panel.key(row, f"{100 * height:g} cm away", colour)
    return "\n".join(parts + ["</svg>"])


def main(doc, table, picture):
    """What this script and its like do: the picture, or the table, on the standard output."""
    root = Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(root / "build/release/bin/stride"))
    parser.add_argument("--table", action="store_true")
    arguments = parser.parse_args()
    print("\n".join(table(arguments.program)) if arguments.table else picture(arguments.program))


if __name__ == "__main__":
    main(__doc__, table, picture)
