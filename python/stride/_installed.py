"""Where the program and the library are."""

from __future__ import annotations

import os
import sys
from pathlib import Path

__all__ = ["choose_python", "prefix", "program"]


def choose_python() -> None:
    """By which stride reads tables in Parquet and MCAP files: this one, unless STRIDE_PYTHON names another."""
    if sys.executable:
        os.environ.setdefault("STRIDE_PYTHON", sys.executable)


def prefix() -> Path:
    """Where stride is installed: the environment variable STRIDE_PREFIX, or else what is in this package."""
    given = os.environ.get("STRIDE_PREFIX")
    return Path(given) if given else Path(__file__).resolve().parent / "_prefix"


def program(name: str = "stride") -> Path:
    """The file of the program `stride`, or of another one that comes with it: `stride-robot`.

    Raises FileNotFoundError where this package is not one that was installed from a wheel, and the environment
    variable STRIDE_PREFIX does not say where stride is installed.
    """
    file = prefix() / "bin" / name
    if not file.is_file():
        raise FileNotFoundError(
            f"there is no program {file}: install the package from a wheel, or set STRIDE_PREFIX to where stride is"
            " installed"
        )
    choose_python()
    return file
