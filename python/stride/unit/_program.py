"""The program's side of docs/process-protocol.md, for one instance of a unit."""

from __future__ import annotations

import operator
import os

from ._errors import UnitError
from ._time import SECOND, Time
from ._values import MISTAKES
from ._variables import Input, Message, MessageInput, MessageOutput, Output, Parameter, Variable

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Any, Callable, Optional

    from ._unit import Unit

# what each unit has from stride, beside its variables
OWN = ("now", "early_return_allowed", "instance_name", "resources", "results")
_TOO_LATE = "but the run has ended, so nothing would read it; do it in step()"


def read_tag(line: str) -> tuple[str, dict[str, str]]:
    """Name and attributes."""
    pieces = line.split('"')
    if "&" in line or "'" in line or len(pieces) < 3 or pieces[-1] != "/>\n":
        from xml.etree import ElementTree

        element = ElementTree.fromstring(line)
        return element.tag, element.attrib
    name, _, first = pieces[0].partition(" ")
    attributes = {first.strip()[:-1]: pieces[1]}
    for i in range(2, len(pieces) - 1, 2):
        attributes[pieces[i].strip()[:-1]] = pieces[i + 1]
    return name[1:], attributes


def _instant(value: Any, what: str, expected: str) -> Time:
    """What one of the user's functions has returned."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) and not hasattr(value, "__float__"):
        raise UnitError(f"{what} returned {value!r:.80}; expected None, or {expected}")
    try:
        return Time(value if type(value) is Time else float(value))
    except (ValueError, OverflowError):
        raise UnitError(f"{what} returned {value!r:.80}; expected None, or {expected}") from None


class Program:
    """Runs a unit as stride's commands say."""

    def __init__(self, cls: type[Unit], commands: Iterable[bytes], write: Callable[[bytes], None]) -> None:
        """`commands` are the lines that stride writes; `write` takes those for stride."""
        self._unit = unit = cls()
        self._commands = commands
        self._write = write
        self._answer = unit._stride_answer
        self._time_unit = 1  # [ps]
        variables = cls._variables.values()
        # tag -> name -> the variable
        self._settable = {kind.tag: {v.name: v for v in variables if type(v) is kind} for kind in (Parameter, Input)}
        self._receivers = {v.name: v for v in variables if isinstance(v, MessageInput)}
        self._outputs = [
            (v.attribute, v.name, f'<output name="{v.name}" value="', v.text) for v in variables if isinstance(v, Output)
        ]
        # what is in the attributes that the unit must not assign to
        self._given = {v.attribute: (v, unit.__dict__[v.attribute]) for v in variables if not isinstance(v, Output)}
        for variable, value in self._given.values():
            if not isinstance(variable, Message) and variable.shape is None and value is not variable.start:
                raise self._changed(variable)
        self._own: dict[str, Any] = {}  # likewise those that each unit has
        for name in OWN:
            if name in unit.__dict__:
                raise self._taken(name)
            self._tell(name, getattr(unit, name))
        self._told = [""] * len(self._outputs)
        self._has_told = False
        self._announced: Optional[int] = None  # what next_event() has returned [ps]

    def run(self) -> None:
        """Obeys until <end/>, or until there is no line any more."""
        for line in self._commands:
            name, attributes = read_tag(line.decode())
            if name == "step":
                self._step(int(attributes["size"]) * self._time_unit, attributes["may-stop"] == "true")
            elif name in self._settable:
                self._set(name, attributes["name"], attributes["value"])
            elif name == "message":
                self._receive(attributes["name"], attributes["value"])
            elif name == "time-unit":
                self._time_unit = int(attributes["picoseconds"])
            elif name == "open":
                self._open(attributes)
            elif name == "trace":
                self._unit.trace(attributes["file"], attributes["signals"])
            elif name == "start":
                self._start(int(attributes["time"]) * self._time_unit)
            elif name == "end":
                self._finish()
                return
            else:
                raise UnitError(f"the command <{name}> is not known to the stride.unit in the FMU: pack it again")

    # ---- Commands ----

    def _open(self, attributes: dict[str, str]) -> None:
        if attributes["protocol"] != "1":
            raise UnitError(f"the FMU knows protocol 1, not {attributes['protocol']}: pack it again")
        self._tell("instance_name", attributes["instance"])
        self._tell("resources", attributes["resources"])
        self._tell("results", os.environ.get("STRIDE_RESULTS", ""))

    def _tell(self, name: str, value: Any) -> None:
        self._unit.__dict__[name] = self._own[name] = value

    def _set(self, tag: str, name: str, text: str) -> None:
        try:
            variable = self._settable[tag][name]
        except KeyError:
            raise self._other_class(tag, name) from None
        value = variable.read(text)
        self._unit.__dict__[variable.attribute] = value
        self._given[variable.attribute] = variable, value

    def _other_class(self, tag: str, name: str) -> UnitError:
        return UnitError(f"the class {type(self._unit).__name__} has no {tag} '{name}', which its FMU has: pack it again")

    def _receive(self, name: str, text: str) -> None:
        variable = self._receivers.get(name)
        if variable is None:
            raise self._other_class("message-input", name)
        if variable.receiver:
            getattr(self._unit, variable.receiver)(variable.read(text))

    def _start(self, ps: int) -> None:
        unit = self._unit
        self._tell("now", Time.from_ps(ps))
        unit._stride_end_ps = ps
        unit.start()
        self._reply()

    def _step(self, size: int, may_stop: bool) -> None:
        unit, own = self._unit, self._own
        now = own["now"]
        if size == 0:
            unit.event(now)
            self._reply()
            return
        unit._stride_end_ps = now.ps + size
        end = Time.from_ps(unit._stride_end_ps)
        unit.early_return_allowed = own["early_return_allowed"] = may_stop
        reached = unit.step(now, end)
        if unit.now is not now or unit.early_return_allowed is not may_stop:
            self._require_own()
        unit.now = own["now"] = now = end if reached is None else self._reached(reached, now, end, may_stop)
        unit._stride_end_ps = now.ps
        unit.early_return_allowed = own["early_return_allowed"] = False
        if self._announced is not None and now.ps >= self._announced:
            unit.event(now)
        self._reply()

    def _finish(self) -> None:
        """Nothing is read of the unit behind it, but what it has said."""
        unit, before, sent = self._unit, self._output_texts(), len(self._unit._stride_sent)
        unit.finish()
        self._require_given()
        for i, text in enumerate(self._output_texts()):
            if text != before[i]:
                raise UnitError(f"output '{self._outputs[i][1]}': finish() has assigned it, {_TOO_LATE}")
        if len(unit._stride_sent) > sent:
            raise UnitError(f"message '{unit._stride_sent[sent][1]}': finish() has sent it, {_TOO_LATE}")
        self.flush()

    def _output_texts(self) -> list[str]:
        """Of the values that are there; of one that is none of the output, what Python writes for it."""
        texts = []
        for attribute, _, _, write in self._outputs:
            value = self._unit.__dict__.get(attribute)
            try:
                texts.append(write(value))
            except MISTAKES:
                texts.append(f"{type(value).__name__} {value!r:.80}")
        return texts

    @staticmethod
    def _reached(returned: Any, now: Time, end: Time, may_stop: bool) -> Time:
        reached = _instant(returned, "step()", "the instant at which it has ended")
        if not now.ps <= reached.ps <= end.ps:
            raise UnitError(f"step() returned {float(reached)!r} s; expected from {float(now)!r} s to {float(end)!r} s")
        if reached.ps != end.ps and not may_stop:
            raise UnitError(
                f"step() returned {float(reached)!r} s, but this step has to end at {float(end)!r} s: end early only where"
                " self.early_return_allowed is true, for which the class declares early_return=True"
            )
        return reached

    # ---- Answers ----

    @staticmethod
    def _changed(variable: Variable) -> UnitError:
        if isinstance(variable, MessageOutput):
            return UnitError(
                f"message '{variable.name}': the unit has assigned it; send it: self.{variable.attribute}.send(value)"
            )
        if isinstance(variable, MessageInput):
            return UnitError(
                f"message '{variable.name}': the unit has assigned it; it comes to the method behind"
                f" @{variable.attribute}.receive"
            )
        return UnitError(
            f"{variable.tag} '{variable.name}': the unit has changed it, which stride alone does; keep what it is to"
            " remember in an attribute that is no variable"
        )

    @staticmethod
    def _taken(name: str) -> UnitError:
        return UnitError(f"self.{name}: the unit has assigned it, which stride alone does; choose another name")

    def _require_own(self) -> None:
        values = self._unit.__dict__
        for name, value in self._own.items():
            if values.get(name) is not value:
                raise self._taken(name)

    def _require_given(self) -> None:
        self._require_own()
        values = self._unit.__dict__
        for attribute, (variable, given) in self._given.items():
            if values.get(attribute) is not given:
                raise self._changed(variable)

    def _reply(self) -> None:
        unit, told, answer = self._unit, self._told, self._answer
        if unit._stride_sent:
            self._send()
        self._require_given()
        values = unit.__dict__
        for i, (attribute, name, prefix, write) in enumerate(self._outputs):
            try:
                text = write(values[attribute])
            except KeyError:
                raise UnitError(f"output '{name}': it was deleted") from None
            except MISTAKES as mistake:
                raise UnitError(f"output '{name}': {mistake}") from None
            if text != told[i] or not self._has_told:
                told[i] = text
                answer.append(f'{prefix}{text}"/>\n')
        self._has_told = True
        now = unit.now.ps
        self._announced = self._next(now)
        if self._announced is None:
            [time] = self._counts(now)
            answer.append(f'<sync time="{time}"')
        else:
            time, following = self._counts(now, self._announced)
            answer.append(f'<sync time="{time}" next="{following}"')
        answer.append(' end="true"/>\n' if unit._stride_ends else "/>\n")
        self.flush()

    def _next(self, now: int) -> Optional[int]:
        following = self._unit.next_event()
        if following is None or following == float("inf"):
            return None
        ps = _instant(following, "next_event()", "an instant after now").ps
        if ps <= now:
            raise UnitError(f"next_event() returned {ps / SECOND!r} s; expected None, or an instant after {now / SECOND!r} s")
        return ps

    def _send(self) -> None:
        """In the order of time; messages without an instant of their own have that of the end."""
        unit = self._unit
        messages = [((unit.now if at is None else at).ps, name, text) for at, name, text in unit._stride_sent]
        unit._stride_sent.clear()
        for ps, name, text in sorted(messages, key=operator.itemgetter(0)):
            if ps > unit.now.ps:
                raise UnitError(
                    f"message '{name}' of {ps / SECOND!r} s is behind {float(unit.now)!r} s, where step() has ended: send it"
                    " in the step that reaches it"
                )
            [time] = self._counts(ps)
            self._answer.append(f'<message name="{name}" time="{time}" value="{text}"/>\n')

    def _counts(self, *times: int) -> list[int]:
        """Of units of time, which become picoseconds where they have to."""
        unit = self._time_unit
        if unit != 1 and any(ps % unit for ps in times):
            self._time_unit = unit = 1
            self._answer.append('<time-unit picoseconds="1"/>\n')
        return [ps // unit for ps in times]

    def flush(self) -> None:
        self._write(self.take_answer().encode())

    def take_answer(self) -> str:
        """What is to be written."""
        text = "".join(self._answer)
        self._answer.clear()
        return text
