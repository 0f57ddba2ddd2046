#!/usr/bin/env python3
"""Makes a wheel for other machines of one that was built here.

    repair_wheel.py WHEEL FOLDER

auditwheel finds which libraries the wheel needs that a system may lack, puts them into it, and names the systems that
have the rest. It does not look into the archives of units, so their libraries are unpacked for it. Afterwards each
archive gets the libraries that its own need, for an FMU has to bring along what it needs
(docs/decisions/0047-a-wheel-is-the-installed-tree.md).
"""

import hashlib
import json
import re
import shutil
import stat
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

UNITS = "stride/_prefix/lib/stride/units"
LIBRARIES = "stride_cosim.libs"  # where auditwheel puts them
ELF = b"\x7fELF"  # how programs and libraries begin


def run(*command: object) -> str:
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        raise SystemExit(f"repair_wheel: {' '.join(map(str, command[:4]))} … has failed: {done.stdout}")
    return done.stdout


def unpack(wheel: Path, folder: Path) -> Path:
    """The only folder in `folder`, which it makes."""
    run(sys.executable, "-m", "wheel", "unpack", "--dest", folder, wheel)
    (tree,) = folder.iterdir()
    return tree


def is_elf(file: Path) -> bool:
    if not file.is_file():
        return False
    with file.open("rb") as content:
        return content.read(len(ELF)) == ELF


def elf_files(folder: Path) -> list[Path]:
    return sorted(filter(is_elf, folder.rglob("*")))


def unpack_code(fmu: Path) -> str:
    """Beside it, the programs and libraries that it has, some of them maybe in its resources. Returns the name of the
    folder, which units with the same code have in common."""
    with zipfile.ZipFile(fmu) as archive:
        code = {name: archive.read(name) for name in sorted(archive.namelist())}
    code = {name: content for name, content in code.items() if content.startswith(ELF)}
    name = hashlib.sha256(repr(code).encode()).hexdigest() + ".unpacked"
    for file, content in code.items():
        (fmu.parent / name / file).parent.mkdir(parents=True, exist_ok=True)
        (fmu.parent / name / file).write_bytes(content)
    return name


def pack(tree: Path, folder: Path) -> Path:
    """The only wheel in `folder` afterwards, which is made."""
    folder.mkdir(parents=True, exist_ok=True)
    run(sys.executable, "-m", "wheel", "pack", "--dest-dir", folder, tree)
    (wheel,) = folder.glob("*.whl")
    return wheel


def add_libraries(wheel: Path, folder: Path) -> Path:
    """What auditwheel makes of it."""
    run(sys.executable, "-m", "auditwheel", "repair", "--zip-compression-level", 0, "--wheel-dir", folder, wheel)
    (whole,) = folder.iterdir()
    return whole


def closure(files: list[Path], libraries: Path) -> list[Path]:
    """The libraries in that folder that the files need, and those that these need."""
    found: dict[str, Path] = {}
    while files:
        for name in run("patchelf", "--print-needed", files.pop()).split():
            if name not in found and (libraries / name).is_file():
                found[name] = libraries / name
                files.append(found[name])
    return [found[name] for name in sorted(found)]


def complete_code(folder: Path, libraries: Path) -> None:
    """Puts what the programs and libraries in it need beside them."""
    files = elf_files(folder)
    for place in {file.parent for file in files}:
        for library in closure([file for file in files if file.parent == place], libraries):
            shutil.copy2(library, place)
    for file in elf_files(folder):
        run("patchelf", "--force-rpath", "--set-rpath", "$ORIGIN", file)


def replace_code(fmu: Path, folder: Path) -> None:
    code = {str(file.relative_to(folder)): file.read_bytes() for file in elf_files(folder)}
    whole = fmu.with_suffix(".whole")
    with zipfile.ZipFile(fmu) as old, zipfile.ZipFile(whole, "w", zipfile.ZIP_DEFLATED) as archive:
        for entry in old.infolist():
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, code.pop(entry.filename, None) or old.read(entry))
        for name, content in code.items():
            entry = zipfile.ZipInfo(name)  # with the same date in each
            entry.external_attr = (stat.S_IFREG | 0o755) << 16
            archive.writestr(entry, content, zipfile.ZIP_DEFLATED)
    whole.replace(fmu)


def remove_unneeded(tree: Path) -> None:
    """Libraries that only units need, which have them now."""
    libraries = tree / LIBRARIES
    users = [file for file in elf_files(tree) if file.parent != libraries]
    needed = closure(users, libraries)
    for library in libraries.iterdir():
        if library not in needed:
            library.unlink()


def add_licences(tree: Path) -> None:
    """Of the Debian packages that the libraries are from: the bill of materials, which auditwheel writes, names them."""
    (info,) = tree.glob("*.dist-info")
    (bill,) = (info / "sboms").iterdir()
    folder = info / "licenses" / "libraries"
    folder.mkdir(parents=True)
    common = set()
    for component in json.loads(bill.read_text())["components"]:
        if not component["purl"].startswith("pkg:deb/"):
            continue
        text = Path("/usr/share/doc", component["name"], "copyright").read_text()
        (folder / f"{component['name']}.txt").write_text(text)
        common.update(re.findall(r"/usr/share/common-licenses/([\w.+-]*\w)", text))
    for name in sorted(common):
        shutil.copyfile(Path("/usr/share/common-licenses", name), folder / f"common-{name}.txt")


def main(wheel: Path, target: Path) -> None:
    with tempfile.TemporaryDirectory() as temporary:
        work = Path(temporary)
        tree = unpack(wheel, work / "built")
        folders = {fmu.name: unpack_code(fmu) for fmu in (tree / UNITS).glob("*.fmu")}
        tree = unpack(add_libraries(pack(tree, work / "open"), work / "whole"), work / "tree")
        for folder in set(folders.values()):
            complete_code(tree / UNITS / folder, tree / LIBRARIES)
        for fmu, folder in folders.items():
            replace_code(tree / UNITS / fmu, tree / UNITS / folder)
        for folder in set(folders.values()):
            shutil.rmtree(tree / UNITS / folder)
        remove_unneeded(tree)
        add_licences(tree)
        print(pack(tree, target))


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
