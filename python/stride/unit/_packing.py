"""Packs a unit in Python as an FMU: its declaration for the unit `process`, and its files."""

from __future__ import annotations

import argparse
import inspect
import os
import re
import shutil
import subprocess
import sys
import tempfile
import traceback
import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import Optional, Union
from xml.etree import ElementTree

from .._installed import program
from ._errors import UnitError
from ._process import error_text, load_class
from ._unit import Unit
from ._variables import Input, MessageInput, Output

PathLike = Union[str, "os.PathLike[str]"]

# stride.unit in the FMU, which Python runs as it is
_RUNTIME = "stride_unit.pyz"
_DECLARATION = "process.xml"
_PYTHON = "python3"
_MAIN = '''import os
import sys

sys.dont_write_bytecode = True

from stride.unit._process import load_class, serve

file = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), sys.argv[1])
sys.exit(serve(lambda: load_class(file, sys.argv[2])))
'''


# ---- The declaration ----


def _description(cls: type[Unit]) -> str:
    """The first paragraph of its docstring."""
    text = inspect.cleandoc(cls.__doc__ or "")
    return " ".join(text.partition("\n\n")[0].split())


def _depends_on(cls: type[Unit], output: Output) -> Optional[str]:
    """What is declared of an output; None: all inputs.

    Without code for events an output changes where a step ends only, and does not depend on what comes then.
    """
    if output.depends_on is None:
        receives = any(isinstance(variable, MessageInput) for variable in cls._variables.values())
        is_held = cls.start is Unit.start and cls.event is Unit.event and not receives
        return "" if is_held else None
    inputs = {key: variable.name for key, variable in cls._variables.items() if type(variable) is Input}
    names = []
    for name in output.depends_on:
        if name not in inputs and name not in inputs.values():
            raise UnitError(f"{cls.__name__}.{output.attribute}: depends_on: there is no input '{name}'")
        names.append(inputs.get(name, name))
    return " ".join(names)


def declaration(cls: type[Unit], command: list[tuple[str, dict[str, str]]]) -> str:
    """That of docs/process-protocol.md, each element on a line. `command`: elements with their attributes."""
    root = ElementTree.Element("process", {"version": "1", "name": cls.__name__, "description": _description(cls)})
    for key, value in cls._options.items():
        root.set(key, str(value).lower())
    if cls.trace is not Unit.trace:
        root.set("trace", "true")
    for tag, attributes in command:
        ElementTree.SubElement(root, tag, attributes)
    for definition in cls._units_of_measure.values():
        ElementTree.SubElement(root, "unit-of-measure", definition)
    for variable in cls._variables.values():
        attributes = variable.attributes()
        if isinstance(variable, Output) and (names := _depends_on(cls, variable)) is not None:
            attributes["depends-on"] = names
        ElementTree.SubElement(root, variable.tag, attributes)
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode") + "\n"


# ---- The files ----


def _write_runtime(file: Path) -> None:
    contents = {"__main__.py": _MAIN, "stride/__init__.py": ""}
    for module in sorted(Path(__file__).parent.glob("*.py")):
        if module.name not in (Path(__file__).name, "__main__.py"):
            contents[f"stride/unit/{module.name}"] = module.read_text(encoding="utf-8")
    with zipfile.ZipFile(file, "w") as archive:
        for name, text in contents.items():
            archive.writestr(zipfile.ZipInfo(name), text)  # of a fixed date, so that the same is packed each time


def _program() -> str:
    """The program `stride`: that of this package or of STRIDE_PREFIX, or else the one in PATH."""
    try:
        return str(program())
    except FileNotFoundError as missing:
        found = shutil.which("stride")
        if found is None:
            raise UnitError(f"{missing}; or put 'stride' into PATH") from None
        return found


def _refusal(messages: str, declared: Path, cls: type[Unit], variables: list[str]) -> UnitError:
    """What the program says of the declaration, as said of the class; `variables` are what its last lines are for."""

    def place(match: re.Match[str]) -> str:
        lines = declared.read_text(encoding="utf-8").count("\n")
        i = int(match[1]) + len(variables) - lines
        return f"{cls.__name__}.{variables[i]}: " if 0 <= i < len(variables) else f"{cls.__name__}: "

    text = re.sub(f"{re.escape(str(declared))}:(\\d+): (?:<[-a-z]+>: )?", place, messages)
    return UnitError(text.replace("stride: error: ", "", 1).strip())


# with the arguments behind self that stride gives them
_METHODS = {
    "__init__": "",
    "start": "",
    "step": "now, end",
    "event": "now",
    "next_event": "",
    "trace": "file, signals",
    "finish": "",
}


_NOT_CALLED_AT_ONCE = (inspect.isgeneratorfunction, inspect.iscoroutinefunction, inspect.isasyncgenfunction)


def _check_methods(cls: type[Unit]) -> None:
    """What would be an error of the call, or no call of the body at all."""
    receivers = [variable.receiver for variable in cls._variables.values() if isinstance(variable, MessageInput)]
    for name, words in {**_METHODS, **{name: "value" for name in receivers if name}}.items():
        method = getattr(cls, name)
        if method is object.__init__:
            continue
        arguments = words.split(", ") if words else []
        expected = f"expected {name}({', '.join(['self', *arguments])})"
        if not callable(method):
            raise UnitError(f"{cls.__name__}.{name}: {expected}, is {method!r:.80}")
        try:
            inspect.signature(getattr(cls.__new__(cls), name)).bind(*arguments)
        except (TypeError, ValueError):  # ValueError: without self
            raise UnitError(f"{cls.__name__}.{name}{inspect.signature(method)}: {expected}") from None
        if any(is_kind(method) for is_kind in _NOT_CALLED_AT_ONCE):
            raise UnitError(f"{cls.__name__}.{name}: expected a method without yield or async, whose body runs when it is called")


def _prefix_of(interpreter: str) -> str:
    """Where its packages are; a program in PATH may be a script that chooses one."""
    done = subprocess.run([interpreter, "-c", "import sys; print(sys.prefix)"], stdout=subprocess.PIPE, text=True, check=False)
    return done.stdout.strip()


def _note_on_interpreter(output: PathLike) -> Optional[str]:
    """What is to be known of the FMU if another interpreter than this one may run it."""
    found = shutil.which(_PYTHON)
    is_virtual = sys.prefix != sys.base_prefix
    if not is_virtual and found is not None and _prefix_of(found) == sys.prefix:
        return None
    this = f"that of the virtual environment {sys.prefix}" if is_virtual else sys.executable
    return (
        f"{output}: the first '{_PYTHON}' in PATH runs it (here {found or 'there is none'}), which may be another "
        f"interpreter than {this}; to choose this one: --python {sys.executable}"
    )


def pack(
    file: PathLike,
    output: PathLike,
    *,
    name: str = "",
    python: Optional[str] = None,
    files: Sequence[PathLike] = (),
    outside: bool = False,
) -> None:
    """Packs a class in a file of Python as an FMU.

    Args:
        file: The file; `name` is the class, if it has more than one.
        output: The .fmu to write.
        python: Runs it: a path, or a name that is searched in PATH where the unit runs. Without one it is python3, and
            a warning says so where that may be another interpreter than this one.
        files: Others that the unit needs: modules and data; each is in `resources` by the last part of its name.
        outside: The file is not packed but used where it is, so that it can be changed without packing it.

    Raises UnitError, or what the file raises.
    """
    file = Path(file).resolve()
    cls = load_class(str(file), name)
    _check_methods(cls)
    packed = {_RUNTIME: Path(), _DECLARATION: Path(), "origin.txt": Path()}
    with tempfile.TemporaryDirectory() as folder:
        _write_runtime(Path(folder, _RUNTIME))
        for other in [*([] if outside else [file]), *map(Path, files)]:
            if packed.setdefault(other.name, other) is not other:
                raise UnitError(f"{other}: the FMU has another file of this name; call it otherwise")
            shutil.copyfile(other, Path(folder, other.name))
        command = [
            ("program", {"name": python or _PYTHON}),
            ("argument", {"file": _RUNTIME}),
            ("argument", {"text": str(file) if outside else file.name}),
            ("argument", {"text": cls.__name__}),
            *(("file", {"file": name}) for name, source in packed.items() if source != Path()),
        ]
        declared = Path(folder, _DECLARATION)
        declared.write_text(declaration(cls, command), encoding="utf-8")
        words = [_program(), "pack", str(declared), "--output", str(output)]
        done = subprocess.run(words, stderr=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            raise _refusal(done.stderr, declared, cls, [*cls._variables])
    sys.stderr.write(done.stderr)
    if python is None and (note := _note_on_interpreter(output)) is not None:
        print(f"stride.unit: warning: {note}", file=sys.stderr)


def _is_raised_in(file: PathLike, error: Exception) -> bool:
    path = str(Path(file).resolve())
    return any(frame.filename == path for frame in traceback.extract_tb(error.__traceback__))


def command(arguments: list[str]) -> int:
    """`python -m stride.unit`. Returns the exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m stride.unit", description="Packs a class that derives from stride.unit.Unit as an FMU."
    )
    parser.add_argument("file", metavar="FILE", help="the file of Python with the class")
    parser.add_argument("-o", "--output", metavar="FMU", required=True, help="the .fmu to write")
    parser.add_argument("--class", dest="name", default="", metavar="NAME", help="which one, if there are several")
    parser.add_argument(
        "--file", dest="files", action="append", default=[], metavar="FILE", help="to be packed, too; may be repeated"
    )
    parser.add_argument("--python", metavar="PROGRAM", help="what runs it, in PATH, or its path [python3]")
    parser.add_argument("--outside", action="store_true", help="use FILE where it is, do not pack it")
    given = parser.parse_args(arguments)
    try:
        pack(given.file, given.output, name=given.name, python=given.python, files=given.files, outside=given.outside)
    except Exception as error:
        is_of_a_file = isinstance(error, OSError) and not _is_raised_in(given.file, error)
        print(f"stride.unit: error: {error if is_of_a_file else error_text(error)}", file=sys.stderr)
        return 2
    return 0
