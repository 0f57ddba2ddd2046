#!/usr/bin/env python3
"""Draws a run of the flagship scenario as an SVG picture: docs/plot_run.py RESULTS_FOLDER > docs/images/nfc_approach.svg

Needs nothing but Python. The panels are those of the paper's Figure 6: distance, power, charge, what the device does.
"""

import csv
import sys
from pathlib import Path

WIDTH, LEFT, RIGHT, PANEL, GAP, TOP = 880, 126, 24, 84, 28, 44
PANELS = [
    ("distance [cm]", [("channel.distance [m]", 100, "#1b6ca8")]),
    ("power at the tag [mW]", [("channel.tag_power [W]", 1000, "#c05621")]),
    ("capacitor [V]", [("sensor.capacitor.voltage [V]", 1, "#2f855a")]),
    ("supply [V]", [("sensor.supply.voltage [V]", 1, "#b7791f")]),
    ("load [mW]", [("sensor.energy.load [W]", 1000, "#805ad5")]),
]
STATES = [("antenna on", "reader.carrier_power [W]"), ("sensor powered", "sensor.mcu.powered"),
          ("control unit awake", "sensor.mcu.awake"), ("LED", "sensor.led")]


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


class Picture:
    def __init__(self, end, height):
        self.end = end
        self.parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" font-size="12" '
                      'font-family="sans-serif">', f'<rect width="{WIDTH}" height="{height}" fill="#fff"/>']

    def x(self, time):
        return LEFT + (WIDTH - LEFT - RIGHT) * time / self.end

    def line(self, x1, y1, x2, y2, colour, width=1):
        self.parts.append(f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" '
                          f'stroke-width="{width}"/>')

    def text(self, x, y, text, anchor="end", colour="#333"):
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}">{text}</text>')

    def curve(self, times, values, top, colour):
        most = max(values) or 1.0
        low = []
        points = []
        for first, least, largest in decimated(values, 700):
            x = self.x(times[first])
            points.append(f"{x:.1f},{top + PANEL * (1 - largest / most):.1f}")
            low.append(f"{x:.1f},{top + PANEL * (1 - least / most):.1f}")
        outline = " ".join(points + low[::-1])
        self.parts.append(f'<polygon points="{outline}" fill="{colour}" stroke="{colour}" stroke-width="1.2"/>')
        self.text(LEFT - 8, top + 10, f"{most:.3g}")
        self.text(LEFT - 8, top + PANEL, "0")


def start_of(event):
    """A frame's start on the air, the first eight bytes, which stays the same on its way."""
    return event["payload"][:16]


def messages(rows):
    """(time, colour) of each frame that a reader or sensor sends; grey where nothing of it is heard."""
    heard = {start_of(event) for event in rows if event["component"] == "channel" and event["direction"] == "sent"}
    for event in rows:
        if event["direction"] != "sent" or event["component"] == "channel":
            continue
        sender = "#c53030" if event["component"] == "reader" else "#2f855a"
        yield float(event["time"]), sender if start_of(event) in heard else "#a0aec0"


def main(folder):
    rows, events = read(folder)
    times = [float(row["time"]) for row in rows]
    bottom = TOP + len(PANELS) * (PANEL + GAP) - 10
    height = bottom + 18 * len(STATES) + 34
    picture = Picture(times[-1], height)
    for time, colour in messages(events):
        picture.line(picture.x(time), TOP - 18, picture.x(time), height - 30, colour, 1)
    for label, x, colour in (("reader's frame", 200, "#c53030"), ("sensor's answer", 340, "#2f855a"),
                             ("not heard", 480, "#a0aec0")):
        picture.line(LEFT + x - 24, 14, LEFT + x - 6, 14, colour, 3)
        picture.text(LEFT + x, 18, label, "start")
    for index, (title, curves) in enumerate(PANELS):
        top = TOP + index * (PANEL + GAP)
        picture.line(LEFT, top + PANEL, WIDTH - RIGHT, top + PANEL, "#999")
        picture.text(LEFT, top - 5, title, "start", "#000")
        for column, scale, colour in curves:
            picture.curve(times, [scale * number(row[column]) for row in rows], top, colour)
    for index, (title, column) in enumerate(STATES):
        y = bottom + 18 * index
        picture.text(LEFT - 8, y + 9, title)
        for begin, end in intervals(times, [number(row[column]) > 0 for row in rows]):
            width = max(0.8, picture.x(end) - picture.x(begin))
            picture.parts.append(f'<rect x="{picture.x(begin):.1f}" y="{y}" width="{width:.1f}" height="10" fill="#4a5568"/>')
    for second in range(0, int(times[-1]) + 1, 5):
        picture.text(picture.x(second), height - 10, f"{second} s", "middle")
        picture.line(picture.x(second), height - 28, picture.x(second), height - 24, "#999")
    print("\n".join(picture.parts + ["</svg>"]))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
