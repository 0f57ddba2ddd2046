"""The files of a folder of results. What is below units/ was written by a unit, so nothing about it is certain."""

from __future__ import annotations

import os
import stat
from pathlib import Path


def is_regular(file: Path) -> bool:
    """Whether it is a file, and no link, pipe or device that a unit has put in its place."""
    try:
        return stat.S_ISREG(os.lstat(file).st_mode)
    except OSError:
        return False


def unit_folders(results: Path) -> list[tuple[str, Path]]:
    """Component and folder of what units have written, by name."""
    units = results / "units"
    if units.is_symlink() or not units.is_dir():
        return []
    found = []
    for folder in sorted(units.iterdir()):
        if folder.is_dir() and not folder.is_symlink():
            # a name that was too long for a folder is cut, and has a hash
            whole = "%~" not in folder.name
            name = folder.name.replace("%2F", "/").replace("%25", "%") if whole else folder.name
            found.append((name, folder))
    return found
