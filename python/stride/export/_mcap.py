"""The results of a run as one MCAP file."""

from __future__ import annotations

import csv
import heapq
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any, Literal, Union

from .._errors import InputError
from .._options import PathLike, path_of
from ..results import Run
from ._film import film_events
from ._log import Log, activity_events, failure_events, message_events, write_end
from ._output import Output, new_file
from ._scene import world_events
from ._signals import Event, signal_events
from ._times import date_of, picoseconds_of, since_1970

__all__ = ["Epoch", "McapFile", "export_mcap"]


#: The date of the simulated 0 s: "run", when the run was made; a date as text of ISO 8601, or as an object.
Epoch = Union[None, Literal["run"], str, datetime]


@dataclass(frozen=True)
class McapFile:
    """What was written.

    Attributes:
        file: The file.
        topics: In the order in which they are in it.
        messages: How many there are.
    """

    file: Path
    topics: list[str]
    messages: int


def export_mcap(run: Union[Run, PathLike], file: PathLike, *, epoch: Epoch = None) -> McapFile:
    """Writes the results of a run as an MCAP file, which Foxglove, PlotJuggler and Rerun open.

    >>> stride.export_mcap("results/nfc_approach", "nfc_approach.mcap")

    Args:
        run: A run, or its folder, also that of a run that has failed or was killed.
        file: Is replaced if it exists, once the new one is complete.
        epoch: The date of the simulated 0 s. None: there is none, times are simulated time.

    Raises:
        ImportError: The packages of the extra `stride-cosim[mcap]` are missing.
        InputError: The folder has no results, a file of them is malformed, or the file cannot be there.
        RunError: The file cannot be written.
    """
    run = run if isinstance(run, Run) else Run(run)  # type: ignore[arg-type]  # which looks at it
    target = Path(path_of(file, "the MCAP file"))
    _refuse_results(run.folder, target)
    begin = _begin(run.info, epoch)
    limit = csv.field_size_limit(sys.maxsize)  # a Binary value may be long
    try:
        with new_file(target) as stream:
            output = Output(stream, begin)
            _write(run.folder, run.info, output)
            output.finish()
    finally:
        csv.field_size_limit(limit)
    return McapFile(target, output.topics, output.messages)


def _refuse_results(folder: Path, file: Path) -> None:
    """A file of the results must not be replaced."""
    inside = folder.resolve() in file.resolve().parents
    if inside and file.exists() and file.resolve().suffix != ".mcap":
        raise InputError(f"{file} is one of the results, and not replaced", file=str(file), hint="name a file .mcap")


def _begin(info: dict[str, Any], epoch: Epoch) -> int:
    """The time in the file [ns] of the simulated 0 s."""
    if epoch is None:
        return 0
    if isinstance(epoch, datetime):
        return since_1970(epoch)
    text = info.get("provenance", {}).get("date") if epoch == "run" else epoch
    hint = "epoch is 'run' or a date such as 2026-11-27T04:09:51Z"
    if not isinstance(epoch, str):
        raise InputError(f"{epoch!r:.80} is no date", hint=hint)
    if text is None:
        raise InputError("these results do not say when the run was made", hint="name a date")
    try:
        return since_1970(date_of(text))
    except ValueError as error:
        raise InputError(f"'{text}' is no date", hint=hint) from error


def _write(folder: Path, info: dict[str, Any], output: Output) -> None:
    start = picoseconds_of(info.get("start", 0))
    output.add_metadata("stride", _summary(info))
    for name in ("run.json", info["files"].get("coverage")):
        if name and (folder / name).is_file():
            output.attach(start, name, "application/json", (folder / name).read_bytes())
    log = Log(output, info["scenario"])
    signals = signal_events(folder, info, output)
    sources: list[Iterator[Event]] = [
        signals,
        *film_events(folder, output),
        *world_events(folder, output),
        message_events(folder, info, output, log),
        activity_events(folder, info, log),
        failure_events(info, log),
    ]
    for time, write in heapq.merge(*sources, key=lambda event: event[0]):
        write(time)
    end = picoseconds_of(info["reached"]) if "reached" in info else start
    write_end(info, log, max(end, start if output.last is None else output.last))


def _summary(info: dict[str, Any]) -> dict[str, str]:
    provenance = info.get("provenance", {})
    commands = [command["text"] for command in provenance.get("commands", [])]
    entries = {
        "scenario": info["scenario"],
        "system": info["system"],
        "outcome": info["outcome"],
        "error": info.get("error"),
        "version": provenance.get("version"),
        "date": provenance.get("date"),
        "host": provenance.get("host"),
        "command": "\n".join(commands) or None,
    }
    return {key: value for key, value in entries.items() if value is not None}
