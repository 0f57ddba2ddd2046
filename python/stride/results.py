"""The results of a run, as they are in its folder."""

from __future__ import annotations

import csv
import functools
import html
import json
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
from .simulation import Message, Verdict

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

    def __init__(self, file: Path, types: Mapping[str, str], keeper: Any = None) -> None:
        self._keeper = keeper  # of the file
        self._file = file
        self._types = types
        self._made: dict[str, np.ndarray] = {}

    @functools.cached_property
    def _columns(self) -> dict[str, Any]:
        if not self._file.is_file():
            raise InputError(f"the signals of this run are gone: there is no {self._file}")
        with self._file.open(newline="", encoding="utf-8") as lines:
            rows = csv.reader(lines)
            header = next(rows, None)
            if header is None:
                raise InputError(f"{self._file} is empty: the run was ended before it was written")
            columns: list[Any] = list(zip(*rows)) or [()] * len(header)
        names = ["time"] + list(self._types)
        if len(names) != len(header):
            raise InputError(f"{self._file} has {len(header)} columns where run.json knows {len(names)}")
        return dict(zip(names, columns))

    @functools.cached_property
    def time(self) -> np.ndarray:
        """[s], not falling."""
        return _read_only(np.array(self._columns["time"], dtype=float))

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._types:
            raise KeyError(f"no signal '{name}' was recorded; there are: {', '.join(self._types) or 'none'}")
        if name not in self._made:
            self._made[name] = _read_only(_array(self._columns[name], self._types[name]))
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
        self.folder = Path(folder).absolute()
        self.summary = summary
        self._keeper = keeper
        file = self.folder / "run.json"
        if not file.is_file():
            raise InputError(f"{self.folder} is no folder of results: there is no run.json", file=str(file))
        try:
            self.info: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
        except ValueError as error:
            raise InputError(
                f"{file} is not whole: {error}",
                file=str(file),
                hint=f"'stride report {self.folder}' shows what there is",
            ) from None

    # ---- What happened ----

    @functools.cached_property
    def signals(self) -> Signals:
        """The recorded signals. Raises InputError if none were recorded."""
        name = self.info["files"].get("signals")
        if not name:
            raise InputError("this run has recorded no signals: its scenario names no file for them")
        return Signals(self.folder / name, {each["name"]: each["type"] for each in self.info["signals"]}, self._keeper)

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
        with (self.folder / name).open(newline="", encoding="utf-8") as lines:
            return [
                Message(
                    float(row["time"]),
                    f"{row['component']}.{row['variable']}",
                    row["direction"] == "received",
                    row["payload"] or None,
                    row["content"],
                    int(row["index"]),
                )
                for row in csv.DictReader(lines)
            ]

    @property
    def verdicts(self) -> list[Verdict]:
        """Of the units and the scenario's checks."""
        of_units = [Verdict(each["component"], each["passed"], each["text"]) for each in self.info["verdicts"]]
        return of_units + [
            Verdict(
                each["name"],
                each["passed"],
                each["text"],
                each.get("time"),
                (each.get("margin") or {}).get("value"),
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
        return float(self.info.get("reached", "nan"))

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

    def to_mcap(self, file: Union[str, "os.PathLike[str]"], *, epoch: Union[None, str, datetime] = None) -> McapFile:
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
