"""signals.csv: a topic for each component, a message for each row."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, Callable

from .._errors import InputError
from .._rows import rows, signal_header
from ._names import Scope, identifier
from ._output import Channel, Output
from ._schemas import Column, ComponentSignals
from ._times import picoseconds

#: When [ps], and what writes it then.
Event = tuple[int, Callable[[int], None]]


def component_of(name: str, components: list[str]) -> str:
    """Of "system.sensor.voltage", the longest name of a component that it begins with."""
    fitting = [each for each in components if name.startswith(f"{each}.")]
    return max(fitting, key=len, default=name.partition(".")[0])


def _by_component(info: dict[str, Any]) -> dict[str, list[Column]]:
    components = [unit["name"] for unit in info.get("units", [])]
    found: dict[str, list[Column]] = {}
    for index, signal in enumerate(info["signals"], start=1):
        component = component_of(signal["name"], components)
        name = signal["name"][len(component) + 1 :]
        column = Column(index, name, signal["type"], signal["unit"], signal["variability"])
        found.setdefault(component, []).append(column)
    return found


def signal_events(folder: Path, info: dict[str, Any], output: Output) -> Iterator[Event]:
    """Makes the topics, and then a message of each component for each row."""
    name = info["files"].get("signals")
    if not name:
        return iter(())
    scope = Scope()
    writers = []
    for component, columns in _by_component(info).items():
        signals = ComponentSignals(scope.take(identifier(component)), columns)
        units = {f"unit:{name}": unit for name, unit in signals.units.items()}
        channel = output.channel(signals.schema, ("signals", component), component=component, **units)
        writers.append((channel, signals))
    return _rows(folder / name, signal_header(info["signals"]), writers)


def _rows(file: Path, header: list[str], writers: list[tuple[Channel, ComponentSignals]]) -> Iterator[Event]:
    if not file.is_file():
        raise InputError(f"the signals of this run are gone: there is no {file}")
    last = None
    for line, row in rows(file, header):
        try:
            time = picoseconds(row[0])
            if last is not None and time < last:
                raise ValueError(f"the time goes back to {row[0]}")
            last = time
            messages = [(channel, signals.encode(row)) for channel, signals in writers]
        except (ValueError, KeyError) as error:
            raise InputError(f"{file}:{line}: a value is wrong: {error}", file=str(file), line=line) from error

        def write(at: int, messages: list[tuple[Channel, bytes]] = messages) -> None:
            for channel, data in messages:
                channel.write(at, data)

        yield time, write
