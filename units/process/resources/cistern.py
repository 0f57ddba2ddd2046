#!/usr/bin/env python3
"""A cistern with an overflow, as a unit of stride. What it reads and writes: docs/process-protocol.md."""

import math
import os
import sys
from xml.etree import ElementTree

answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
os.dup2(2, 1)  # what is printed from here on goes to stride's log
unit = 1  # of all times in the lines, in picoseconds


def tell(tag, **attributes):
    element = ElementTree.Element(tag, {name: str(value) for name, value in attributes.items()})
    answers.write(ElementTree.tostring(element, encoding="unicode") + "\n")


def counts(*times):
    """Instants in units of time, which become picoseconds where they have to."""
    global unit
    if any(time % unit for time in times):
        unit = 1
        tell("time-unit", picoseconds=unit)
    return [time // unit for time in times]


class Cistern:
    """All times in picoseconds."""

    def __init__(self):
        self.capacity = 1.0
        self.report_period = 0.5
        self.inflow = 0.0
        self.volume = 0.0
        self.alarms = 0

    def start(self, now):
        self.now = now
        self.period = round(self.report_period * 1e12)
        self.next_report = now + self.period

    def full_at(self):
        """When it will be full, as things are."""
        if self.volume >= self.capacity or self.inflow <= 0:
            return math.inf
        return self.now + math.ceil((self.capacity - self.volume) / self.inflow * 1e12)

    def step(self, to, may_stop):
        """Goes from one happening to the next, until `to`, or until the first if it may stop there."""
        while True:
            full_at = self.full_at()
            at = min(to, full_at, self.next_report)
            is_full = at == full_at
            self.volume = self.capacity if is_full else self.volume_at(at)
            self.now = at
            if is_full:
                self.alarms += 1
                self.send("alarm.text", f"full with {self.capacity!r} m3")
            is_reported = at == self.next_report
            if is_reported:
                self.next_report += self.period
                self.send("report.text", f"{self.volume!r} m3")
            if at == to or (may_stop and (is_full or is_reported)):
                return

    def send(self, name, text):
        [time] = counts(self.now)
        tell("message", name=name, time=time, value=text)

    def volume_at(self, time):
        return min(max(self.volume + self.inflow * ((time - self.now) / 1e12), 0.0), max(self.capacity, self.volume))

    def receive(self, order):
        if order != "empty":
            tell("log", level="warning", text=f"what is '{order}'? Expected 'empty'")
            return
        self.volume = 0.0


def main():
    global unit
    cistern = Cistern()
    for line in sys.stdin:
        command = ElementTree.fromstring(line)
        if command.tag == "time-unit":
            unit = int(command.get("picoseconds"))
        elif command.tag in ("parameter", "input"):
            setattr(cistern, command.get("name"), float(command.get("value")))
        elif command.tag == "message":
            cistern.receive(command.get("value"))
        elif command.tag == "start":
            cistern.start(int(command.get("time")) * unit)
            answer(cistern)
        elif command.tag == "step":
            cistern.step(cistern.now + int(command.get("size")) * unit, command.get("may-stop") == "true")
            answer(cistern)
        elif command.tag == "end":
            break


def answer(cistern):
    tell("output", name="volume", value=cistern.volume)
    tell("output", name="alarms", value=cistern.alarms)
    now, following = counts(cistern.now, cistern.next_report)
    tell("sync", time=now, next=following)
    answers.flush()


if __name__ == "__main__":
    main()
