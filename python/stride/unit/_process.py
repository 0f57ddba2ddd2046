"""The process of a unit: its pipes, its class, and what is said where it fails."""

from __future__ import annotations

import os
import sys

from ._errors import UnitError
from ._program import OWN, Program
from ._unit import Unit, UnitType
from ._values import printable

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Callable

_OWN = os.path.dirname(__file__)


def _take_pipes() -> tuple[Iterable[bytes], Callable[[bytes], None]]:
    """The lines from stride, and what writes to it. What else reads gets nothing, what else prints is in stride's log."""
    commands = os.fdopen(os.dup(0), "rb")
    answers = os.dup(1)
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    os.dup2(2, 1)
    sys.stdout.reconfigure(line_buffering=True)  # type: ignore[union-attr]

    def write(data: bytes) -> None:
        while data:
            data = data[os.write(answers, data) :]

    return commands, write


def error_text(error: BaseException) -> str:
    """The last line of the traceback, and where in the user's file that was; all of it goes to the standard error."""
    import traceback

    frames = [frame for frame in traceback.extract_tb(error.__traceback__) if not frame.filename.startswith(_OWN)]
    where = f" ({os.path.basename(frames[-1].filename)}:{frames[-1].lineno}, in {frames[-1].name})" if frames else ""
    if isinstance(error, UnitError):
        return f"{error}{where}"
    everything = traceback.TracebackException.from_exception(error)
    everything.stack = traceback.StackSummary.from_list(frames)
    sys.stderr.write("".join(everything.format()))
    sys.stderr.flush()
    return f"{traceback.format_exception_only(type(error), error)[-1].strip()}{where}"


def serve(find_class: Callable[[], type[Unit]]) -> int:
    """Runs the class until stride ends it. Returns the exit code."""
    commands, write = _take_pipes()
    program = None
    try:
        program = Program(find_class(), commands, write)
        program.run()
        return 0
    except BrokenPipeError:  # stride has gone
        return 1
    except BaseException as error:  # sys.exit() in a step, too, would leave stride without an answer
        said = program.take_answer() if program is not None else ""  # what was logged before the mistake
        write(f'{said}<error text="{printable(error_text(error))}"/>\n'.encode())
        return 1


_loading: list[str] = []


def is_loading() -> bool:
    """Whether a file is executed for its class: what it does with that itself, at its end, is not wanted."""
    return len(_loading) > 0


def load_class(file: str, name: str = "") -> type[Unit]:
    """The class of this name in a file of Python, or else the only one that is no base of another."""
    module = type(sys)(os.path.splitext(os.path.basename(file))[0])
    module.__file__ = file
    sys.modules[module.__name__] = module
    folder = os.path.dirname(os.path.abspath(file))
    if folder not in sys.path:
        sys.path.insert(0, folder)
    with open(file, "rb") as source:
        code = compile(source.read(), file, "exec")
    _loading.append(file)
    try:
        exec(code, module.__dict__)
    except SystemExit as end:
        raise UnitError(f"{file}: it ends Python ({end}) where it is only to define a class") from None
    finally:
        _loading.pop()
    found = [
        value
        for value in vars(module).values()
        if isinstance(value, UnitType) and value.__module__ == module.__name__ and issubclass(value, Unit)
    ]
    bases = {base for cls in found for base in cls.__mro__[1:]}
    chosen = [cls for cls in found if (cls.__name__ == name if name else cls not in bases)]
    if len(chosen) == 1:
        return checked(chosen[0])
    names = ", ".join(cls.__name__ for cls in found) or "none"
    if name:
        raise UnitError(f"{file}: there is no unit '{name}'; its units are: {names}")
    raise UnitError(f"{file}: expected one class that derives from stride.unit.Unit, there are: {names}")


def checked(cls: type[Unit]) -> type[Unit]:
    """The class, if it can be a unit."""
    if not callable(cls.step) or cls.step is Unit.step:
        raise UnitError(f"the class {cls.__name__} has no step(self, now, end), which every unit has")
    for name in OWN:
        if any(name in vars(base) for base in cls.__mro__[: cls.__mro__.index(Unit)]):
            raise UnitError(f"{cls.__name__}.{name}: each unit has something of this name; choose another one")
    return cls
