"""The rows of a file of results."""

from __future__ import annotations

import csv
import logging
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ._errors import InputError

_log = logging.getLogger("stride")


def signal_header(signals: list[dict[str, Any]]) -> list[str]:
    """That of signals.csv; the signals are those of run.json."""
    return ["time", *(f"{each['name']} [{each['unit']}]" if each["unit"] else each["name"] for each in signals)]


def rows(file: Path, header: list[str]) -> Iterator[tuple[int, list[str]]]:
    """The number of the line, and the fields, of each row below the header.

    A last line that was cut off, as a run that was killed leaves it, is left out with a warning; that may be the
    header, or all that there was. Raises InputError where the header or the number of fields is another one.
    """
    found = _whole_lines(file)
    _, first = next(found, (0, header))
    if first != header:
        text = f"its columns are {', '.join(first)}; expected {', '.join(header)}"
        raise InputError(f"{file}:1: {text}", file=str(file), line=1)
    yield from _of_width(file, found, len(header))


def _of_width(file: Path, lines: Iterator[tuple[int, list[str]]], width: int) -> Iterator[tuple[int, list[str]]]:
    for line, row in lines:
        if len(row) != width:
            text = f"there are {len(row)} fields; expected {width}"
            raise InputError(f"{file}:{line}: {text}", file=str(file), line=line)
        yield line, row


def read_table(file: Path) -> tuple[list[str], list[list[str]]]:
    """The header, whatever it is, and the rows below it; likewise."""
    found = _whole_lines(file)
    _, header = next(found, (0, []))
    return header, [row for _, row in _of_width(file, found, len(header))]


def _whole_lines(file: Path) -> Iterator[tuple[int, list[str]]]:
    if file.stat().st_size == 0:
        _log.warning("%s is empty: its run was ended before it was written, or it is damaged", file)
    with file.open(newline="", encoding="utf-8", errors="replace") as lines:
        yield from _without_cut_end(file, csv.reader(lines, strict=True))


def _without_cut_end(file: Path, reader: Any) -> Iterator[tuple[int, list[str]]]:
    ends_well = _ends_with_a_newline(file)
    pending = None
    try:
        for row in reader:
            if pending is not None:
                yield pending
            pending = reader.line_num, row
    except csv.Error as error:
        if "unexpected end" not in str(error):
            raise InputError(f"{file}:{reader.line_num}: {error}", file=str(file), line=reader.line_num) from error
        ends_well = True  # the line before the one that is cut off in quotation marks
        _warn_of_cut_end(file)
    if pending is not None and ends_well:
        yield pending
    elif pending is not None:
        _warn_of_cut_end(file)


def _warn_of_cut_end(file: Path) -> None:
    _log.warning("%s: its last line is cut off, and left out", file)


def _ends_with_a_newline(file: Path) -> bool:
    with file.open("rb") as content:
        if content.seek(0, os.SEEK_END) == 0:
            return True
        content.seek(-1, os.SEEK_END)
        return content.read(1) == b"\n"
