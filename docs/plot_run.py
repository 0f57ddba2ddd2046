#!/usr/bin/env python3
"""Draws a run of the flagship scenario as an SVG picture: docs/plot_run.py RESULTS_FOLDER > docs/images/nfc_approach.svg

Needs nothing but Python. The traces are those of the paper's Figure 6, and the numbers refer to the table in
docs/paper.md. Frames come from events.csv, all else from signals.csv.
"""

import csv
import math
import sys
from bisect import bisect_left
from pathlib import Path

WIDTH, LEFT, RIGHT, TOP = 880, 128, 20, 64
ANALOGUE, DIGITAL, GAP = 84, 16, 26
DARK, LIGHT = "#333", "#999"

# title, column, factor, colour, decades of a logarithmic axis
CURVES = {
    "distance": ("distance [cm]", "channel.distance [m]", 100, "#1b6ca8", None),
    "intake": ("EnergyIntake [W]", "sensor.energy.intake [W]", 1, "#c05621", (-7, -2)),
    "load": ("EnergyLoad [W]", "sensor.energy.load [W]", 1, "#805ad5", (-7, -2)),
    "charge": ("Charge [µC]", "sensor.capacitor.charge [C]", 1e6, "#2f855a", None),
    "voltage": ("Voltage [V]", "sensor.supply.voltage [V]", 1, "#b7791f", None),
}
STATES = {"carrier": ("carrier", "reader.carrier_power [W]"), "powered": ("sensor powered", "sensor.mcu.powered"),
          "led": ("LED", "sensor.led")}
FATES = {"received": ("received", "#2f855a"), "rejected": ("with wrong bits", "#c53030"),
         "no power": ("no power to receive it", "#dd6b20"), "not heard": ("not heard", "#a0aec0")}
# instants of the table: from, to
MARKS = [(6.1, 9.0), (14.2, 14.2), (15.05, 15.05), (20.9, 21.5), (24.0, 24.1), (25.0, 30.0)]


def read(folder):
    with open(folder / "signals.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    with open(folder / "events.csv", newline="") as file:
        events = [event for event in csv.DictReader(file) if event["variable"].endswith(".frame")]
    return rows, events


def number(text):
    return {"true": 1.0, "false": 0.0}.get(text) if text in ("true", "false") else float(text)


def decimated(values, bins):
    """(index, least, most) of each bin, so that no spike is lost."""
    size = max(1, len(values) // bins)
    for first in range(0, len(values), size):
        part = values[first:first + size]
        yield first, min(part), max(part)


def intervals(times, states):
    """(begin, end) of each stretch in which the state holds."""
    begin = None
    for time, state in zip(times, states):
        if state and begin is None:
            begin = time
        if not state and begin is not None:
            yield begin, time
            begin = None
    if begin is not None:
        yield begin, times[-1]


def start_of(event):
    """A frame's start on the air, the first eight bytes, which stays the same on its way."""
    return event["payload"][:16]


def requests(rows, times, events):
    """(time, fate) of each frame of the reader, as its start or its reception."""
    heard = {start_of(event): float(event["time"]) for event in events
             if event["component"] == "sensor" and event["direction"] == "received"}
    for event in events:
        if event["component"] != "reader" or event["direction"] != "sent":
            continue
        if start_of(event) not in heard:
            yield float(event["time"]), "not heard"
            continue
        time = heard[start_of(event)]
        before = rows[bisect_left(times, time) - 1]
        after = rows[min(bisect_left(times, time + 0.001), len(rows) - 1)]
        counted = [name for name in ("received", "rejected")
                   if after[f"sensor.frames.{name}"] != before[f"sensor.frames.{name}"]]
        yield time, counted[0] if counted else "no power"


class Picture:
    def __init__(self, end, height):
        self.end = end
        self.height = height
        self.parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" font-size="12" '
                      'font-family="sans-serif">', f'<rect width="{WIDTH}" height="{height}" fill="#fff"/>']

    def x(self, time):
        return LEFT + (WIDTH - LEFT - RIGHT) * time / self.end

    def line(self, x1, y1, x2, y2, colour, width=1.0):
        self.parts.append(f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" '
                          f'stroke-width="{width}"/>')

    def text(self, x, y, text, anchor="end", colour=DARK):
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}">{text}</text>')

    def box(self, begin, end, y, height, colour, least=0.0):
        width = max(least, self.x(end) - self.x(begin))
        self.parts.append(f'<rect x="{self.x(begin):.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" '
                          f'fill="{colour}"/>')

    def mark(self, index, begin, end):
        middle = (self.x(begin) + self.x(end)) / 2
        self.line(self.x(begin), TOP - 14, self.x(end), TOP - 14, DARK, 2)
        self.line(middle, TOP - 20, middle, TOP - 14, DARK)
        self.parts.append(f'<circle cx="{middle:.1f}" cy="{TOP - 28}" r="9" fill="#fff" stroke="{DARK}"/>')
        self.text(middle, TOP - 24, str(index), "middle")

    def curve(self, times, values, top, colour, decades):
        if decades:
            low, high = decades
            for decade in range(low, high + 1):
                y = top + ANALOGUE * (high - decade) / (high - low)
                self.line(LEFT, y, WIDTH - RIGHT, y, "#e2e8f0")
                self.text(LEFT - 8, y + 4, f"1e{decade}", colour=DARK if decade % 2 else "#fff")
            values = [(math.log10(max(value, 10.0 ** low)) - low) / (high - low) for value in values]
        else:
            most = max(values) or 1.0
            self.text(LEFT - 8, top + 8, f"{most:.3g}")
            self.text(LEFT - 8, top + ANALOGUE + 4, "0")
            values = [value / most for value in values]
        upper, lower = [], []
        for first, least, most in decimated(values, 700):
            x = self.x(times[first])
            upper.append(f"{x:.1f},{top + ANALOGUE * (1 - most):.1f}")
            lower.append(f"{x:.1f},{top + ANALOGUE * (1 - least):.1f}")
        outline = " ".join(upper + lower[::-1])
        self.parts.append(f'<polygon points="{outline}" fill="{colour}" stroke="{colour}" stroke-width="1.2"/>')


def draw(picture, rows, times, events):
    """Yields each trace's title, height, and what draws it below a given ordinate."""
    def column(name):
        return [number(row[name]) for row in rows]

    def curve(name):
        title, signal, factor, colour, decades = CURVES[name]
        values = [factor * value for value in column(signal)]
        return title, ANALOGUE, lambda top: picture.curve(times, values, top, colour, decades)

    def state(name):
        title, signal = STATES[name]

        def boxes(top):
            for begin, end in intervals(times, [value > 0 for value in column(signal)]):
                picture.box(begin, end, top + 3, DIGITAL - 6, "#4a5568", 0.8)
        return title, DIGITAL, boxes

    def ticks(title, instants):
        def lines(top):
            for time, colour in instants:
                picture.line(picture.x(time), top, picture.x(time), top + DIGITAL, colour, 1.6)
        return title, DIGITAL, lines

    sent = [(float(event["time"]), FATES["received"][1]) for event in events
            if event["component"] == "sensor" and event["direction"] == "sent"]
    heard = [(time, FATES[fate][1]) for time, fate in requests(rows, times, events)]
    return [curve("distance"), state("carrier"), ticks("recData", heard), ticks("DataUCToTrm", sent), curve("intake"),
            curve("load"), curve("charge"), curve("voltage"), state("powered"), state("led")]


def main(folder):
    rows, events = read(folder)
    times = [float(row["time"]) for row in rows]
    height = TOP + 5 * (ANALOGUE + GAP + 6) + 5 * (DIGITAL + 8) + 50
    picture = Picture(times[-1], height)
    bottom = height - 34
    for begin, end in intervals(times, [number(row["reader.carrier_power [W]"]) > 0 for row in rows]):
        picture.box(begin, end, TOP - 6, bottom - TOP + 6, "#fefcea")
    for index, (begin, end) in enumerate(MARKS, 1):
        picture.mark(index, begin, end)
    picture.text(LEFT, 14, "frames of the reader, at the sensor:", "start", "#000")
    for x, (text, colour) in zip((350, 446, 572, 740), FATES.values()):
        picture.line(x, 10, x + 16, 10, colour, 3)
        picture.text(x + 22, 14, text, "start")
    top = TOP + 14
    for title, size, below in draw(picture, rows, times, events):
        if size == ANALOGUE:
            top += 6
            picture.text(LEFT + 4, top - 4, title, "start", "#000")
            picture.line(LEFT, top + size, WIDTH - RIGHT, top + size, LIGHT)
        else:
            picture.text(LEFT - 8, top + 12, title, "end", "#000")
        below(top)
        top += size + (GAP if size == ANALOGUE else 8)
    for second in range(0, int(times[-1]) + 1, 5):
        picture.line(picture.x(second), bottom, picture.x(second), bottom + 5, LIGHT)
        picture.text(picture.x(second), height - 12, f"{second} s", "middle")
    print("\n".join(picture.parts + ["</svg>"]))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
