"""The results of a run, as they are in its folder."""

from __future__ import annotations

import functools
import html
import itertools
import json
import math
import os
import shutil
import tempfile
import weakref
import webbrowser
from collections.abc import Iterator, Mapping
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from ._errors import InputError
from ._options import path_of
from ._rows import rows, signal_header
from .simulation import TYPES, Message, Verdict

if TYPE_CHECKING:
    from .export import McapFile

__all__ = ["Run", "Signals"]

_BOOLEANS = {"true": True, "false": False, "1": True, "0": False}


class Signals(Mapping[str, np.ndarray]):
    """The recorded signals by their names; `time` are the instants [s] of all of them.

    A signal is an array of numbers, of bool, or of objects (str, bytes), which cannot be written to. There may be
    several rows at one instant, one for each event at it. Names are those of `stride inspect`; `units` are their units
    of measure.
    """

    def __init__(self, file: Path, signals: list[dict[str, Any]], keeper: Any = None) -> None:
        """`signals` are those of run.json."""
        self._keeper = keeper  # of the file
        self._file = file
        self._header = signal_header(signals)
        self._types = {each["name"]: each["type"] for each in signals}
        self._made: dict[str, np.ndarray] = {}

    @functools.cached_property
    def _columns(self) -> dict[str, Any]:
        if not self._file.is_file():
            raise InputError(f"the signals of this run are gone: there is no {self._file}")
        with self._file.open("rb") as content:
            if not content.readline().endswith(b"\n"):
                raise InputError(f"{self._file} is empty: the run was ended before its first line was written")
        columns: list[Any] = list(zip(*(row for _, row in self._rows()))) or [()] * len(self._header)
        return dict(zip(["time", *self._types], columns))

    def _rows(self) -> Iterator[tuple[int, list[str]]]:
        return rows(self._file, self._header)

    @functools.cached_property
    def time(self) -> np.ndarray:
        """[s], not falling."""
        times = self._column("time", "Float64")
        wrong = np.flatnonzero(~((np.diff(times, prepend=times[:1]) >= 0) & np.isfinite(times)))
        if wrong.size > 0:
            line, row = next(itertools.islice(self._rows(), int(wrong[0]), None))
            text = f"{self._file}:{line}: the time goes back, or is none: '{row[0]}'"
            raise InputError(text, file=str(self._file), line=line)
        return times

    def _column(self, name: str, type_: str) -> np.ndarray:
        try:
            return _read_only(_array(self._columns[name], type_))
        except (ValueError, KeyError, OverflowError):
            raise self._mistake(name, type_) from None

    def _mistake(self, name: str, type_: str) -> InputError:
        """The first value that is none."""
        index = ["time", *self._types].index(name)
        for line, row in self._rows():
            try:
                _array([row[index]], type_)
            except (ValueError, KeyError, OverflowError):
                text = f"{self._file}:{line}: '{row[index]}' is no value of '{name}', which is {type_}"
                return InputError(text, file=str(self._file), line=line)
        return InputError(f"{self._file} was changed while it was read", file=str(self._file))

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._types:
            raise KeyError(f"no signal '{name}' was recorded; there are: {', '.join(self._types) or 'none'}")
        if name not in self._made:
            self.time  # noqa: B018 - where it goes back, the rows are not those of a run
            self._made[name] = self._column(name, self._types[name])
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._types)

    def __len__(self) -> int:
        return len(self._types)

    def __repr__(self) -> str:
        return f"<stride.Signals: {', '.join(self._types)}>"


def _read_only(array: np.ndarray) -> np.ndarray:
    """One run may be looked at by many tests."""
    array.setflags(write=False)
    return array


def _array(texts: Any, type_: str) -> np.ndarray:
    if type_ == "Boolean":
        return np.array([_BOOLEANS[text] for text in texts], dtype=bool)
    if type_ in ("Float64", "Float32"):
        return np.array(texts, dtype=type_.lower())
    if type_ in ("String", "Binary"):
        values = texts if type_ == "String" else [bytes.fromhex(text) for text in texts]
        array = np.empty(len(values), dtype=object)
        array[:] = values
        return array
    dtype = "int64" if type_ == "Enumeration" else type_.lower()
    return np.array([int(text) for text in texts], dtype=dtype)


_EVENTS = ["time", "index", "component", "variable", "direction", "payload", "content"]
_DIRECTIONS = ("sent", "received", "intervention")


def _message(file: Path, line: int, row: list[str]) -> Message:
    time, index, component, variable, direction, payload, content = row
    try:
        if direction not in _DIRECTIONS:
            raise ValueError(f"'{direction}' is none of {', '.join(_DIRECTIONS)}")
        if not math.isfinite(float(time)):
            raise ValueError(f"'{time}' is no time")
        is_received = direction == "received"
        return Message(float(time), f"{component}.{variable}", is_received, payload or None, content, int(index))
    except ValueError as error:
        raise InputError(f"{file}:{line}: a value is wrong: {error}", file=str(file), line=line) from None


def _damaged(file: Path, why: str, line: Optional[int] = None) -> InputError:
    hint = f"'stride report {file.parent}' shows what there is"
    place = f"{file}:{line}" if line else f"{file}"
    return InputError(f"{place}: the account is not whole: {why}", file=str(file), line=line, hint=hint)


_NOTHING = type(None)
_NUMBER = (int, float, _NOTHING)
_PASSED = (bool, _NOTHING)

#: What run.json is for this package: the type of each member, and those of the members of the entries of a list.
_ACCOUNT: dict[str, Any] = {
    "system": str,
    "outcome": str,
    "error": (str, _NOTHING),
    "reached": _NUMBER,
    "files": dict,
    "signals": {"name": str, "unit": str, "type": str},
    "verdicts": {"component": str, "passed": _PASSED, "text": str},
    "checks": {"name": str, "passed": _PASSED, "text": str, "time": _NUMBER, "margin": (dict, _NOTHING)},
}


def _require_account(file: Path, info: Any) -> None:
    """Raises InputError where it is not what a run writes."""
    if not isinstance(info, dict):
        raise _damaged(file, "it is no object of JSON")
    for name, kind in _ACCOUNT.items():
        is_list = isinstance(kind, dict)
        if not isinstance(info.get(name), list if is_list else kind):
            raise _damaged(file, f"there is no '{name}', or it is another one than a run writes")
        for entry in info[name] if is_list else ():
            _require_members(file, name, entry, kind)
    for name, path in info["files"].items():
        if not isinstance(path, str) or "\0" in path:
            raise _damaged(file, f"'{name}' of its files is none")
    unknown = [each["type"] for each in info["signals"] if each["type"] not in TYPES]
    if unknown:
        raise _damaged(file, f"a signal has the type '{unknown[0]}', which is not known")


def _require_members(file: Path, name: str, entry: Any, kinds: dict[str, Any]) -> None:
    if not isinstance(entry, dict):
        raise _damaged(file, f"an entry of '{name}' is none")
    for member, kind in kinds.items():
        if member not in entry or not isinstance(entry[member], kind):
            raise _damaged(file, f"an entry of '{name}' lacks '{member}', or has another one than a run writes")


class Run:
    """A run that is over, with what it has left in its folder.

    Attributes:
        folder: The results, which `stride run` has written.
        summary: The tables that the program prints.
        info: run.json: settings, statistics of each unit, provenance and so on.
    """

    def __init__(self, folder: Union[str, Path], summary: str = "", keeper: Any = None) -> None:
        """Reads the results in this folder. Raises InputError if there are none.

        `keeper` is whatever removes the folder when this object goes.
        """
        self.folder = Path(path_of(folder, "a folder of results")).absolute()
        self.summary = summary
        self._keeper = keeper
        file = self.folder / "run.json"
        if not file.is_file():
            is_there = self.folder.is_dir()
            raise InputError(
                f"{self.folder} is no folder of results: there is no {'run.json' if is_there else 'such folder'}",
                file=str(file),
                hint=f"'stride report {self.folder}' shows what else there is" if is_there else None,
            )
        try:
            self.info: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
        except (ValueError, RecursionError) as error:
            raise _damaged(file, f"{error}", getattr(error, "lineno", None)) from None
        _require_account(file, self.info)

    # ---- What happened ----

    @functools.cached_property
    def signals(self) -> Signals:
        """The recorded signals. Raises InputError if none were recorded."""
        name = self.info["files"].get("signals")
        if not name:
            raise InputError("this run has recorded no signals: its scenario names no file for them")
        return Signals(self.folder / name, self.info["signals"], self._keeper)

    @property
    def time(self) -> np.ndarray:
        """The instants of the signals [s]."""
        return self.signals.time

    @property
    def units(self) -> dict[str, str]:
        """The unit of measure of each signal."""
        return {each["name"]: each["unit"] for each in self.info["signals"]}

    @functools.cached_property
    def events(self) -> list[Message]:
        """The messages that were sent and received, in order."""
        name = self.info["files"].get("events")
        if not name:
            return []
        if not (self.folder / name).is_file():
            raise InputError(f"the messages of this run are gone: there is no {self.folder / name}")
        return [_message(self.folder / name, line, row) for line, row in rows(self.folder / name, _EVENTS)]

    @property
    def verdicts(self) -> list[Verdict]:
        """Of the units and the scenario's checks."""
        of_units = [Verdict(each["component"], each["passed"], each["text"]) for each in self.info["verdicts"]]
        return of_units + [
            Verdict(
                each["name"],
                each["passed"],
                each["text"],
                each["time"],
                (each["margin"] or {}).get("value"),
            )
            for each in self.info["checks"]
        ]

    @property
    def passed(self) -> bool:
        """Whether it came to its end, and no verdict is a bad one."""
        return self._came_to_its_end and all(verdict.passed is not False for verdict in self.verdicts)

    @property
    def _came_to_its_end(self) -> bool:
        return self.error is None and self.info["outcome"] in ("completed", "ended by a unit")

    @property
    def error(self) -> Optional[str]:
        """What has ended the run, if it did not come to its end."""
        return self.info.get("error")

    @property
    def reached(self) -> float:
        """The simulated time at its end [s]; NaN where it has been killed before."""
        reached = self.info.get("reached")
        return math.nan if reached is None else float(reached)

    def check(self) -> Run:
        """Raises AssertionError that lists each bad verdict; returns the run if there is none, and it came to its end."""
        bad = [verdict for verdict in self.verdicts if verdict.passed is False]
        if bad or not self._came_to_its_end:
            lines = [] if self._came_to_its_end else [self.error or f"it is {self.info['outcome']}"]
            lines += [f"{verdict.name}: {verdict.text}" for verdict in bad]
            raise AssertionError("the run has failed\n  " + "\n  ".join(lines))
        return self

    # ---- To look at ----

    def to_pandas(self) -> Any:
        """The signals as a pandas DataFrame whose index is the time [s]."""
        import pandas

        return pandas.DataFrame(dict(self.signals), index=pandas.Index(self.time, name="time"))

    def to_mcap(self, file: Union[str, os.PathLike[str]], *, epoch: Union[None, str, datetime] = None) -> McapFile:
        """Writes all of it as an MCAP file, for Foxglove, PlotJuggler and Rerun; see `stride.export_mcap`."""
        from .export import export_mcap

        return export_mcap(self, file, epoch=epoch)

    def report(self) -> Path:
        """The page with the report. Raises InputError if there is none."""
        name = self.info["files"].get("report")
        if not name or not (self.folder / name).is_file():
            raise InputError(f"there is no report in {self.folder}", hint=f"stride report {self.folder}")
        return Path(self.folder, name)

    def show(self) -> None:
        """Opens the report in a browser."""
        webbrowser.open(self.report().resolve().as_uri())

    def __repr__(self) -> str:
        state = "passed" if self.passed else "failed"
        return f"<stride.Run of {self.info['system']} to {self.reached:.12g} s: {state}, in {self.folder}>"

    def _repr_html_(self) -> str:
        try:
            page = self.report().read_text(encoding="utf-8")
        except InputError:
            return f"<pre>{html.escape(self.summary or repr(self))}</pre>"
        return (
            f'<iframe srcdoc="{html.escape(page)}" width="100%" height="700" style="border: 0"'
            f' title="{html.escape(repr(self))}"></iframe>'
        )


class TemporaryFolder:
    """Is removed with the object, by the process that has made it."""

    def __init__(self) -> None:
        self.name = tempfile.mkdtemp(prefix="stride-")
        weakref.finalize(self, _remove, self.name, os.getpid())

    def __reduce__(self) -> Any:
        raise TypeError("a run whose results are in a temporary folder stays in its process: name a folder, out=")


def _remove(folder: str, owner: int) -> None:
    if os.getpid() == owner:  # and no fork of it
        shutil.rmtree(folder, ignore_errors=True)
