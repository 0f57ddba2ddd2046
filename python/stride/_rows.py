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


def rows(file: Path, header: list[str]) -> Iterator[tuple[int, list[str]]]:
    """The number of the line, and the fields, of each row below the header.

    A last line that was cut off, as a run that was killed leaves it, is left out with a warning. Raises InputError
    where the header or the number of fields is another one.
    """
    with file.open(newline="", encoding="utf-8", errors="replace") as lines:
        reader = csv.reader(lines, strict=True)
        first = next(reader, None)
        if first is None:
            return  # killed before the header was written
        if len(first) != len(header) or first[:1] != header[:1]:
            raise InputError(
                f"{file}:1: its columns are {', '.join(first)}; expected {', '.join(header)}", file=str(file), line=1
            )
        for line, row in _without_cut_end(file, reader):
            if len(row) != len(header):
                raise InputError(
                    f"{file}:{line}: there are {len(row)} fields; expected {len(header)}", file=str(file), line=line
                )
            yield line, row


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
