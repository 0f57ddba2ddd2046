#!/usr/bin/env python3
"""Draws a trace with advanceTime as an SVG picture, before and after `stride trace expand`: kernel time above, true
time below, as in the paper's Figure 4.

    docs/plot_trace.py TRACE.vcd [SIGNAL …] > picture.svg

A SIGNAL is a name with its scopes ("sensor.state"), or the end of one; all numbers in the trace are drawn if there is
none. --program names the program stride, build/release/bin/stride unless given. Needs nothing but Python.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path
from xml.sax.saxutils import escape

WIDTH, LEFT, RIGHT, ROW, GAP, TOP, AXIS = 880, 150, 30, 30, 12, 34, 44
ADVANCE, COLOURS, SKIPPED = "#c53030", ("#1b6ca8", "#2f855a", "#805ad5", "#b7791f"), "#fde8e8"
UNITS = {"fs": 1e-15, "ps": 1e-12, "ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
SECTIONS = ("$dumpvars", "$dumpall", "$dumpon", "$dumpoff", "$end")


def section(words):
    """The words up to $end."""
    return list(iter(lambda: next(words), "$end"))


def tick_of(text):
    """Seconds of "10ns"."""
    number = text.rstrip("fpnums")
    return int(number) * UNITS[text[len(number):]]


def number(word):
    """The value of a change, or None for a text and for what is not known."""
    try:
        return float(word[1:]) if word[0] in "rR" else float(int(word.lstrip("bB"), 2))
    except ValueError:
        return None


class Trace:
    """The changes of each signal, (time [s], value), by its name with scopes."""

    def __init__(self, file):
        words = iter(file.read_text(encoding="utf-8").split())
        self.signals, self.end, self.tick = {}, 0.0, 1e-12
        scopes, codes = [], {}
        for word in words:
            inside = section(words)
            if word == "$enddefinitions":
                break
            if word == "$timescale":
                self.tick = tick_of("".join(inside))
            elif word == "$scope":
                scopes.append(inside[1])
            elif word == "$upscope":
                scopes.pop()
            elif word == "$var":
                name = ".".join([*scopes, inside[3].split("[")[0]])
                codes.setdefault(inside[2], []).append(self.signals.setdefault(name, []))
        self.read_changes(words, codes)

    def read_changes(self, words, codes):
        for word in words:
            if word[0] == "#":
                self.end = int(word[1:]) * self.tick
            elif word[0] == "$":
                if word not in SECTIONS:
                    section(words)
            else:
                value, code = (word, next(words)) if word[0] in "bBrRsS" else (word[0], word[1:])
                for changes in codes[code]:
                    changes.append((self.end, number(value)))

    def name_of(self, wanted):
        found = [name for name in self.signals if name == wanted or name.endswith("." + wanted)]
        if len(found) != 1:
            sys.exit(f"expected one signal '{wanted}', there are {len(found)}: {', '.join(found or self.signals)}")
        return found[0]


def prefixed(seconds):
    """A time in the unit that suits it."""
    for unit, scale in reversed(UNITS.items()):
        if abs(seconds) >= scale * 0.9995:
            return f"{seconds / scale:.4g} {unit}"
    return "0 s"


class Picture:
    def __init__(self, height):
        self.parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" font-size="12" '
                      'font-family="sans-serif">', f'<rect width="{WIDTH}" height="{height}" fill="#fff"/>']

    def text(self, x, y, text, anchor="end", colour="#333"):
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}">{escape(text)}</text>')

    def line(self, x1, y1, x2, y2, colour):
        self.parts.append(f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}"/>')

    def box(self, x1, y1, x2, y2, colour):
        self.parts.append(f'<rect x="{x1:.1f}" y="{y1:.1f}" width="{max(x2 - x1, 0.5):.1f}" height="{y2 - y1:.1f}" '
                          f'fill="{colour}"/>')

    def steps(self, changes, end, x, top, colour):
        """A value that holds until its next change; nothing is drawn where it is not known."""
        known = [value for _, value in changes if value is not None]
        if not known:
            return
        least, most = min(known + [0.0]), max(known + [0.0])
        scale = (ROW - 8) / (most - least or 1.0)
        path, last, drawn = [], None, None
        for (time, value), (until, _) in zip(changes, [*changes[1:], (end, None)]):
            if value is not None:
                y = f"{top + ROW - 4 - (value - least) * scale:.1f}"
                place = (f"{x(time):.1f}", y, f"{x(until):.1f}")
                if last is None or place != drawn:  # what looks the same is drawn once
                    path.append(f'{"M" if last is None else "L"}{place[0]},{y}H{place[2]}')
                drawn = place
            last = value
        self.parts.append(f'<path d="{"".join(path)}" fill="none" stroke="{colour}" stroke-width="1.3"/>')


def merged(intervals):
    """The intervals in order, joined where they are closer than a pixel."""
    joined = []
    for begin, end in intervals:
        if joined and begin - joined[-1][1] < 0.3:
            joined[-1] = (joined[-1][0], max(end, joined[-1][1]))
        else:
            joined.append((begin, end))
    return joined


def draw_panel(picture, top, title, trace, rows, skips):
    """Rows of (label, changes, colour) over the time of this trace; returns where the next panel begins."""
    def x(time):
        return LEFT + (WIDTH - LEFT - RIGHT) * time / (trace.end or 1.0)

    bottom = top + TOP + len(rows) * (ROW + GAP)
    picture.text(LEFT, top + 18, title, "start", "#000")
    for begin, end in merged([(x(begin), x(end)) for begin, end in skips]):
        picture.box(begin, top + TOP - 6, end, bottom, SKIPPED)
    for index, (label, changes, colour) in enumerate(rows):
        y = top + TOP + index * (ROW + GAP)
        picture.text(LEFT - 10, y + ROW - 8, label)
        picture.steps(changes, trace.end, x, y, colour)
    picture.line(LEFT, bottom, WIDTH - RIGHT, bottom, "#999")
    for part in range(5):
        time = trace.end * part / 4
        picture.line(x(time), bottom, x(time), bottom + 4, "#999")
        picture.text(x(time), bottom + 18, prefixed(time), "middle")
    return bottom + AXIS


def skips_of(trace, advance):
    """(begin, end) in kernel time and in true time of each skip; it begins with the last change before it."""
    instants = sorted({time for changes in trace.signals.values() for time, _ in changes})
    before = dict(zip(instants[1:], instants))
    kernel, true, total = [], [], 0.0
    for time, ticks in advance:
        if ticks > total:
            kernel.append((before.get(time, time), time))
            true.append((before.get(time, time) + total, time + ticks))
        total = ticks
    return kernel, true


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("trace", type=Path)
    parser.add_argument("signals", nargs="*")
    parser.add_argument("--program", default=Path(__file__).parents[1] / "build/release/bin/stride")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        expanded = Path(folder) / "expanded.vcd"
        command = [arguments.program, "trace", "expand", arguments.trace, expanded]
        if subprocess.run(command, check=False).returncode != 0:
            sys.exit(1)
        before, after = Trace(arguments.trace), Trace(expanded)
    advance = before.name_of("advanceTime")
    chosen = [before.name_of(signal) for signal in arguments.signals] or list(after.signals)
    names = [name for name in chosen if any(value is not None for _, value in after.signals.get(name, []))]
    colours = {name: COLOURS[index % len(COLOURS)] for index, name in enumerate(names)}
    kernel, true = skips_of(before, [(time, value * before.tick) for time, value in before.signals[advance]])
    height = 2 * (TOP + AXIS + len(names) * (ROW + GAP)) + ROW + GAP
    picture = Picture(height)
    picture.box(WIDTH - RIGHT - 172, 10, WIDTH - RIGHT - 148, 22, SKIPPED)
    picture.text(WIDTH - RIGHT, 20, "time was skipped here")

    def rows(trace):
        return [(name.split(".")[-1], trace.signals[name], colours[name]) for name in names]

    top = draw_panel(picture, 0, "kernel time", before,
                     [("advanceTime", before.signals[advance], ADVANCE), *rows(before)], kernel)
    draw_panel(picture, top, "true time", after, rows(after), true)
    print("\n".join(picture.parts + ["</svg>"]))


if __name__ == "__main__":
    main()
