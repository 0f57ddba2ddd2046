"""Two runs side by side, as `stride compare` does it."""

from __future__ import annotations

import json
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Optional, Union

from ._options import PathLike, file_word, words
from ._program import answer_of
from .results import Run

__all__ = ["Comparison", "Difference", "Extreme", "InputDifference", "compare"]


@dataclass(frozen=True)
class Extreme:
    """The greatest difference of a signal: where it is [s], and what each run has there."""

    value: float
    time: float
    a: str
    b: str


@dataclass(frozen=True)
class Difference:
    """All that differs of one signal, one stream of messages, one verdict.

    Attributes:
        kind: "message", "event", "signal", "coverage", "check", "verdict", "outcome" or "file".
        name: Of the signal and so on.
        time: Of the first difference [s]; None for what is of the run as a whole.
        a: What the first run has there, as text.
        b: Likewise, the second one.
        count: How many places differ.
        absolute: The greatest absolute difference, of numbers.
        relative: The greatest one relative to `b`.
    """

    kind: str
    name: str
    time: Optional[float]
    a: str
    b: str
    count: int
    absolute: Optional[Extreme]
    relative: Optional[Extreme]


@dataclass(frozen=True)
class InputDifference:
    """What the runs were made from: a file, an option and so on that only one has, or has otherwise."""

    kind: str
    name: str
    a: str
    b: str


@dataclass(frozen=True)
class Comparison:
    """How two runs differ.

    Attributes:
        equal: Whether they do not.
        differences: The first one first, those without a time last.
        inputs: What can explain them; None where a run says nothing about them.
        notes: Warnings, such as of a last line that was cut off.
        summary: The tables that the program prints.
    """

    equal: bool
    differences: list[Difference]
    inputs: Optional[list[InputDifference]]
    notes: list[str]
    summary: str = field(repr=False)

    def __bool__(self) -> bool:
        """Whether they are equal: `assert stride.compare(a, b)`."""
        return self.equal

    @property
    def first(self) -> Optional[Difference]:
        """What differs first; None where they are equal."""
        return self.differences[0] if self.differences else None


def compare(a: Union[Run, PathLike], b: Union[Run, PathLike], **options: Any) -> Comparison:
    """Compares two runs: where they differ first, in what, and what they were made from.

    >>> comparison = stride.compare(before, after, absolute=1e-9, tolerance={"tank.*": "1e-6,1e-3"})
    >>> comparison.equal or comparison.first.name

    Args:
        a: A run, or its folder.
        b: The one that it is compared with, to which relative differences are.
        options: Those of `stride compare`, with "_" for "-": `absolute`, `relative`, `tolerance`, `time_tolerance`,
            `only`, `ignore`, `golden`.

    Raises:
        InputError: One of them is no folder of results, a file is malformed, or an option is wrong.
    """
    folders = [file_word(each.folder if isinstance(each, Run) else each, "a folder of results") for each in (a, b)]
    with tempfile.TemporaryDirectory(prefix="stride-") as folder:
        file = Path(folder, "comparison.json")
        output = answer_of(["compare", *folders, f"--json={file}", *words(options)], file)
        found = json.loads(file.read_text(encoding="utf-8"))
    return Comparison(
        equal=found["equal"],
        differences=[_difference(each) for each in found["differences"]],
        inputs=None if found["inputs"] is None else [InputDifference(**each) for each in found["inputs"]],
        notes=found["notes"],
        summary=output,
    )


def _difference(entry: dict[str, Any]) -> Difference:
    extremes = {name: entry[name] and Extreme(**entry[name]) for name in ("absolute", "relative")}
    return Difference(**{**entry, **extremes})
