"""Where the program and the library are."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path
from typing import Iterator

__all__ = ["choose_python", "missing", "prefix", "program"]


def choose_python() -> None:
    """By which stride reads tables in Parquet and MCAP files: this one, unless STRIDE_PYTHON names another."""
    if sys.executable:
        os.environ.setdefault("STRIDE_PYTHON", sys.executable)


def _places() -> Iterator[Path]:
    """Where stride may be installed: in this package, as a wheel has it; around it, as `cmake --install` puts it into
    share/stride/python, or as scripts/run.sh builds the repository; or around the program in PATH."""
    package = Path(__file__).resolve().parent
    yield package / "_prefix"
    if package.parts[-4:-1] == ("share", "stride", "python"):
        yield package.parents[3]
    if (package.parents[1] / "CMakeLists.txt").is_file():
        yield package.parents[1] / "build" / "release"
    found = shutil.which("stride")
    if found:
        yield Path(found).resolve().parents[1]


def prefix() -> Path:
    """Where stride is installed: what the environment variable STRIDE_PREFIX says, or else the first place with its
    program."""
    given = os.environ.get("STRIDE_PREFIX")
    if given:
        return Path(given)
    places = list(_places())
    return next((place for place in places if _is_program(place / "bin" / "stride")), places[0])


def _is_program(file: Path) -> bool:
    """Whether it is the program itself: a wheel's is a script of Python, which calls this package."""
    try:
        with file.open("rb") as opened:
            return opened.read(4) == b"\x7fELF"
    except OSError:
        return False


def missing(what: str) -> FileNotFoundError:
    """Of a file that is not in prefix()."""
    return FileNotFoundError(
        f"there is no {what}: set STRIDE_PREFIX to the folder that stride is installed or built in, the one with"
        " bin/stride, put that bin/ into PATH, or install the package from a wheel"
    )


def program(name: str = "stride") -> Path:
    """The file of the program `stride`, or of another one that comes with it: `stride-robot`.

    Raises FileNotFoundError where it is not in prefix().
    """
    file = prefix() / "bin" / name
    if not file.is_file():
        raise missing(f"program {file}")
    choose_python()
    return file
