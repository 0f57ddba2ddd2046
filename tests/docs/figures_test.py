#!/usr/bin/env python3
"""Numbers in the documentation are those of a run: figures_test.py PROGRAM SOURCE_DIR [--update]

Runs the flagship scenario and renders the sentences of figures.py with its results; each must be in its page. The list
of messages that a page shows must be what the program prints; with --update it is written into the page first."""

import csv
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import figures

SCENARIO = "scenarios/nfc_approach/nfc_approach.ssd"
PAGE = "docs/paper.md"  # that shows the messages
BLOCK = re.compile(r"```console\n\$ stride run " + re.escape(SCENARIO) + r"[^\n]*\n(Messages\n.*?)```", re.DOTALL)


def number(text):
    return {"true": 1.0, "false": 0.0}[text] if text in ("true", "false") else float(text)


class Run:
    """The results of a run: its signals without their units of measure, at communication points [s]."""

    def __init__(self, folder):
        with open(folder / "signals.csv", newline="", encoding="utf-8") as file:
            header, *rows = csv.reader(file)
        self.times = [float(row[0]) for row in rows]
        self.signals = {name.split(" [")[0]: [number(row[i]) for row in rows] for i, name in enumerate(header) if i}
        with open(folder / "events.csv", newline="", encoding="utf-8") as file:
            self.events = list(csv.DictReader(file))

    def _indices(self, begin, end):
        return (i for i, time in enumerate(self.times) if begin - 1e-9 <= time <= end + 1e-9)

    def at(self, time, signal):
        """After what happens at that instant."""
        return self.signals[signal][max(i for i in self._indices(0, time))]

    def between(self, begin, end, signal):
        """The least and the greatest value."""
        values = [self.signals[signal][i] for i in self._indices(begin, end)]
        return min(values), max(values)

    def first(self, begin, signal, condition):
        """The first communication point from `begin` on at which the signal satisfies the condition."""
        return next(self.times[i] for i in self._indices(begin, float("inf")) if condition(self.signals[signal][i]))

    def sent(self, component, begin=0.0):
        """When the component hands its next frame over."""
        return next(float(event["time"]) for event in self.events
                    if event["component"] == component and event["direction"] == "sent"
                    and event["variable"] == "transmit.frame" and float(event["time"]) >= begin)

    def wrong_bits(self, time):
        """Of the reader's frame that begins then, as the channel hands it on."""
        def bits(component, variable):
            payload = next(event["payload"] for event in self.events
                           if (event["component"], event["variable"], event["direction"]) == (component, variable, "sent")
                           and time <= float(event["time"]) < time + 0.001)
            return int.from_bytes(bytes.fromhex(payload)[16:], "little")
        return bin(bits("reader", "transmit.frame") ^ bits("channel", "to_tag.frame")).count("1")


def mistakes(root, run, printed):
    pages = {}
    for page, template, values in figures.FIGURES:
        text = pages.setdefault(page, (root / page).read_text(encoding="utf-8"))
        sentence = template.format(**{name: value(run) for name, value in values.items()})
        if sentence not in text:
            yield f"{page} does not have\n    {sentence}"
    shown = BLOCK.search((root / PAGE).read_text(encoding="utf-8"))
    if not shown or shown.group(1) != messages_in(printed):
        yield f"{PAGE} does not show these messages:\n{messages_in(printed)}"


def messages_in(printed):
    return re.search(r"^Messages\n.*?\n(?=\n)", printed, re.DOTALL | re.MULTILINE).group(0)


def update(page, messages):
    text = page.read_text(encoding="utf-8")
    begin, end = BLOCK.search(text).span(1)
    page.write_text(text[:begin] + messages + text[end:], encoding="utf-8")


def main(program, root, *options):
    root = Path(root)
    with tempfile.TemporaryDirectory() as folder:
        printed = subprocess.run([program, "run", SCENARIO, "--no-idle-skip", "--no-trace", "--out", folder], cwd=root,
                                 check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, encoding="utf-8").stdout
        if "--update" in options:
            update(root / PAGE, messages_in(printed))
        found = list(mistakes(root, Run(Path(folder)), printed))
    print("\n".join(found) if found else f"{len(figures.FIGURES)} sentences are right")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
