"""What a run tells in words: messages, interventions, steps that were not ordinary, checks and verdicts."""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from .._errors import InputError
from .._rows import rows
from ._output import Channel, Output
from ._schemas import Schema, message_schema
from ._signals import Event
from ._times import picoseconds, picoseconds_of, seconds, timestamp

_EVENTS = ["time", "index", "component", "variable", "direction", "payload", "content"]
_ACTIVITIES = ["time", "until", "component", "kind"]
_REORDERED = 4096  # rows of activity.csv, which is in the order of their ends


class Log:
    """The topic /log."""

    def __init__(self, output: Output, scenario: str) -> None:
        self._output = output
        self._scenario = scenario
        self._channel = output.known_channel("Log", ("log",))

    def write(self, time: int, level: str, name: str, text: str, line: int = 0) -> None:
        """`line` is one of the scenario."""
        entry = self._channel.make(name=name, message=text, line=line, file=self._scenario if line else "")
        entry.level = entry.Level.Value(level)
        entry.timestamp.CopyFrom(timestamp(type(entry.timestamp), self._output.time(time)))
        self._channel.write(time, entry.SerializeToString(deterministic=True))


class _Messages:
    """A topic for each variable that sends or receives them, made when its first one comes."""

    def __init__(self, output: Output, log: Log) -> None:
        self._output = output
        self._log = log
        self._schema: Schema = message_schema()
        self._channels: dict[tuple[str, str], Channel] = {}

    def write(self, time: int, row: list[str]) -> None:
        _, index, component, variable, direction, payload, content = row
        if direction == "intervention":
            self._log.write(time, "WARNING", component, f"{variable}: {content}")
            return
        entry = self._schema.make(direction=direction, index=int(index), payload=payload, content=content)
        if content:  # only a Binary payload has one
            entry.data = bytes.fromhex(payload)
        entry.number = math.nan if content else _number(payload)
        self._channel(component, variable).write(time, entry.SerializeToString(deterministic=True))
        meaning = content or payload
        self._log.write(time, "INFO", component, f"{variable} {direction}{': ' if meaning else ''}{meaning}")

    def _channel(self, component: str, variable: str) -> Channel:
        key = component, variable
        if key not in self._channels:
            self._channels[key] = self._output.channel(
                self._schema, ("messages", component, variable), component=component, variable=variable
            )
        return self._channels[key]


def _number(payload: str) -> float:
    try:
        return float(payload == "true") if payload in ("true", "false") else float(payload)
    except ValueError:
        return math.nan


def message_events(folder: Path, info: dict[str, Any], output: Output, log: Log) -> Iterator[Event]:
    """events.csv."""
    name = info["files"].get("events")
    if not name:
        return
    file = folder / name
    if not file.is_file():
        raise InputError(f"the messages of this run are gone: there is no {file}")
    messages = _Messages(output, log)
    for line, row in rows(file, _EVENTS):

        def write(at: int, line: int = line, row: list[str] = row) -> None:
            try:
                messages.write(at, row)
            except ValueError as error:
                raise InputError(f"{file}:{line}: a value is wrong: {error}", file=str(file), line=line) from error

        yield _time(file, line, row[0]), write


def _time(file: Path, line: int, text: str) -> int:
    try:
        return picoseconds(text)
    except ValueError as error:
        raise InputError(f"{file}:{line}: {error}", file=str(file), line=line) from error


def activity_events(folder: Path, info: dict[str, Any], log: Log) -> Iterator[Event]:
    """Early returns, rejected steps and undone ones of activity.csv, in the order of their instants."""
    name = info["files"].get("activity")
    if not name or not (folder / name).is_file():
        return
    file = folder / name
    waiting: list[tuple[int, int, str, str, str]] = []
    for line, (begin, end, component, kind) in rows(file, _ACTIVITIES):
        if kind in ("idle", "event"):
            continue
        start, until = _time(file, line, begin), _time(file, line, end)
        if kind == "early return":
            entry = (until, line, "DEBUG", component, f"early return from its step of {seconds(start)} s")
        elif kind == "rejection":
            entry = (start, line, "WARNING", component, f"it rejected the step to {seconds(until)} s")
        else:
            entry = (start, line, "DEBUG", component, f"its step to {seconds(until)} s was rolled back")
        heapq.heappush(waiting, entry)
        if len(waiting) > _REORDERED:
            yield _entry_event(log, heapq.heappop(waiting))
    while waiting:
        yield _entry_event(log, heapq.heappop(waiting))


def _entry_event(log: Log, entry: tuple[int, int, str, str, str]) -> Event:
    time, _, level, component, text = entry
    return time, lambda at: log.write(at, level, component, text)


def failure_events(info: dict[str, Any], log: Log) -> Iterator[Event]:
    """The instants at which checks have failed."""
    failed = [check for check in info["checks"] if check["passed"] is False and check.get("time") is not None]
    for check in sorted(failed, key=lambda each: float(each["time"])):

        def write(at: int, check: dict[str, Any] = check) -> None:
            log.write(at, "ERROR", check["name"], f"the check fails: {check['text']}", check.get("line", 0))

        yield picoseconds_of(check["time"]), write


_PASSED = {True: ("INFO", "passed"), False: ("ERROR", "failed"), None: ("WARNING", "undecided")}
_OUTCOMES = {"completed": "INFO", "ended by a unit": "INFO", "failed": "FATAL"}


def write_end(info: dict[str, Any], log: Log, time: int) -> None:
    """Verdicts, checks and outcome, at the end of the run."""
    for verdict in info["verdicts"]:
        level, word = _PASSED[verdict["passed"]]
        log.write(time, level, verdict["component"], f"{word}: {verdict['text']}")
    for check in info["checks"]:
        level, word = _PASSED[check["passed"]]
        log.write(time, level, check["name"], f"{word}: {check['text']}", check.get("line", 0))
    outcome = info["outcome"]
    text = "the run was killed" if outcome == "running" else f"the run is {outcome}"
    error = info.get("error")
    log.write(time, _OUTCOMES.get(outcome, "ERROR"), info["system"], f"{text}: {error}" if error else text)
