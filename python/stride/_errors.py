"""What can go wrong, and the warnings about what did not."""

from __future__ import annotations

import re
from typing import Any, Optional, TypeVar

__all__ = ["Error", "InputError", "MisuseError", "RunError"]

_HINT = "\n  hint: "


class Error(Exception):
    """What stride says of a mistake or a failure: `str(error)` is all of it, the attributes are its parts.

    What is not known is None.

    Attributes:
        text: What is wrong, without the place and the hint.
        hint: How to mend it.
        file: Where, in a file of the scenario.
        line: Of that file.
        component: Of what.
        variable: Of this component.
        time: When, in simulated time [s].
    """

    def __init__(
        self,
        message: str,
        *,
        text: Optional[str] = None,
        hint: Optional[str] = None,
        file: Optional[str] = None,
        line: Optional[int] = None,
        component: Optional[str] = None,
        variable: Optional[str] = None,
        time: Optional[float] = None,
    ) -> None:
        super().__init__(f"{message}{_HINT}{hint}" if hint and _HINT not in message else message)
        self.text = message if text is None else text
        self.hint = hint
        self.file = file
        self.line = line
        self.component = component
        self.variable = variable
        self.time = time


class InputError(Error):
    """The scenario, an option, a name or a value is wrong; nothing was run."""


class RunError(Error):
    """A unit, the simulation or the machine has failed.

    Attributes:
        run: The `Run` up to the failure, where `stride.run` has raised this and a run.json could be written; otherwise
            None.
    """

    run: Any = None


class MisuseError(Error):
    """A call at a time at which it makes no sense, such as a step of a simulation that is closed."""


AnyError = TypeVar("AnyError", bound=Error)

# "FILE:LINE: unit 'U', variable 'V', at T s: MESSAGE", each part if it is known, and a hint on a line of its own
_ERROR = re.compile(
    r"(?:(?P<file>[^\n:]+?)(?::(?P<line>\d+))?: )?"
    r"(?:unit '(?P<component>[^'\n]*)'(?:, |: ))?"
    r"(?:variable '(?P<variable>[^'\n]*)'(?:, |: ))?"
    r"(?:at (?P<time>[-+.e\d]+) s: )?"
    r"(?P<text>.*?)(?:\n +hint: (?P<hint>.*))?",
    re.DOTALL,
)


def parse_error(message: str, kind: type[AnyError]) -> AnyError:
    """The error whose text the program has printed."""
    match = _ERROR.fullmatch(message)
    parts = match.groupdict() if match else {}
    has_place = any(parts.get(key) for key in ("line", "component", "variable", "time"))
    if not has_place:
        parts.pop("file", None)
    return kind(
        message,
        text=parts.get("text") if has_place else message.partition("\n")[0],
        hint=parts.get("hint"),
        file=parts.get("file"),
        line=int(parts["line"]) if parts.get("line") else None,
        component=parts.get("component"),
        variable=parts.get("variable"),
        time=float(parts["time"]) if parts.get("time") else None,
    )
