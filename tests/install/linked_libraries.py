"""Which libraries the loader finds for each program and library, in folders and in units (FMUs).

    linked_libraries.py FOLDER UNIT-FOLDER

Fails where one is not found, or where that of a unit is found in another folder than its own and the system's.
"""

import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

LOADER = "/lib64/ld-linux-x86-64.so.2"
SYSTEM = "/lib/"


def is_elf(file: Path) -> bool:
    if file.is_symlink() or not file.is_file():
        return False
    with file.open("rb") as content:
        return content.read(4) == b"\x7fELF"


def mistakes_of(file: Path, top: Path) -> list[str]:
    found = []
    linked = subprocess.run([LOADER, "--list", file], capture_output=True, text=True)
    if linked.returncode != 0:
        found.append(f"{file}: {linked.stdout}{linked.stderr}")
    for line in linked.stdout.splitlines():
        name, arrow, place = line.strip().partition(" => ")
        if arrow and not place.startswith((f"{top}/", SYSTEM)):
            found.append(f"{file}: {name} => {place}")
    return found


def main(folder: Path, units: Path) -> int:
    mistakes, count = [], 0
    with tempfile.TemporaryDirectory() as unpacked:
        tops = [folder.resolve()]
        for unit in sorted(units.glob("*.fmu")):
            tops.append(Path(unpacked).resolve() / unit.stem)
            zipfile.ZipFile(unit).extractall(tops[-1])
        for top in tops:
            for file in filter(is_elf, top.rglob("*")):
                mistakes += mistakes_of(file, top)
                count += 1
    print("\n".join(mistakes) or f"{count} programs and libraries, {len(tops) - 1} units: nothing is missing")
    return 1 if mistakes or len(tops) < 2 else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
