"""The class that units derive from."""

from __future__ import annotations

from ._errors import UnitError
from ._time import SECOND, Time
from ._values import MISTAKES, printable
from ._variables import MessageOutput, Variable, collect, definitions, refuse_words

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Optional, TypeVar

    U = TypeVar("U", bound="Unit")


class _Sender:
    """A message output of an instance."""

    def __init__(self, variable: Variable, unit: Unit) -> None:
        self._variable = variable
        self._unit = unit

    def send(self, value: Any, at: Optional[float] = None) -> None:
        """Sends it at an instant within the step, or else where the step ends; outside of a step, now.

        A step that may end early should end there: only then it is an event at its own instant.
        """
        unit, name = self._unit, self._variable.name
        try:
            text = self._variable.text(value)
        except MISTAKES as mistake:
            raise type(mistake)(f"message '{name}': {mistake}") from None
        if at is not None and not unit.now <= at <= Time.from_ps(unit._stride_end_ps):
            raise ValueError(
                f"message '{name}': at={float(at)!r} is not in this step, from {float(unit.now)!r} s to"
                f" {unit._stride_end_ps / SECOND!r} s"
            )
        unit._stride_sent.append((None if at is None else Time(at), name, text))


class _Body(dict):  # type: ignore[type-arg]
    """The body of a class, which refuses a second definition of a variable."""

    def __setitem__(self, name: str, value: object) -> None:
        if isinstance(self.get(name), Variable):
            raise UnitError(f"'{name}' is defined twice; give one of both another name")
        super().__setitem__(name, value)


class UnitType(type):
    """The type of units: lists the variables of a class."""

    @classmethod
    def __prepare__(mcs, name: str, bases: tuple[type, ...], /, **options: Any) -> _Body:
        return _Body()

    def __new__(mcs, name: str, bases: tuple[type, ...], body: dict[str, Any], **options: Any) -> UnitType:
        cls = super().__new__(mcs, name, bases, dict(body), **options)
        if bases:
            cls._variables = collect(cls, Unit)
        return cls

    _variables: dict[str, Variable] = {}


class Unit(metaclass=UnitType):
    """Derive from it, list variables, write `step`. Words behind the base, `class Pump(su.Unit, early_return=True)`:

    - early_return: a step may end before its end;
    - split_invariant: while inputs are held, it does not matter how time is divided into steps; `stride verify` tests it;
    - maximum_step: no step is longer [s];
    - units_of_measure: those that stride does not know, as `(factor, unit)` or `(factor, unit, offset)`, where a value is
      factor * value + offset in the unit: `{"furlong": (201.168, "m")}`;
    - time_unit: of the times in the lines, which are shorter so: "ps", "ns", "us", "ms", "s".

    The calls: `start`, then `step` and `event` in turn, `finish`. Inputs and parameters are in their attributes before
    each of them, outputs are read after it. An exception ends the run with an error. What is printed goes to stride's log.
    """

    _options: dict[str, object] = {}
    _units_of_measure: dict[str, dict[str, str]] = {}

    now: Time = Time.from_ps(0)
    """The present instant: the start, or where the last step ended."""
    early_return_allowed: bool = False
    """Within `step`: whether it may end early."""
    instance_name: str = ""
    """In the scenario."""
    resources: str = ""
    """The folder with the files that were packed with the unit."""
    results: str = ""
    """The folder for files that the unit writes."""

    _stride_sent: list[tuple[Optional[Time], str, str]]
    _stride_end_ps: int
    _stride_ends: bool
    _stride_answer: list[str]

    def __init_subclass__(
        cls,
        early_return: Optional[bool] = None,
        split_invariant: Optional[bool] = None,
        maximum_step: Optional[float] = None,
        time_unit: Optional[str] = None,
        units_of_measure: Optional[dict[str, tuple[Any, ...]]] = None,
        **others: Any,
    ) -> None:
        known = ("early_return", "split_invariant", "maximum_step", "time_unit", "units_of_measure")
        refuse_words(f"class {cls.__name__}(Unit, …)", others, known)
        given = {
            "may-stop": early_return,
            "split-invariant": split_invariant,
            "maximum-step": maximum_step,
            "time-unit": time_unit,
        }
        cls._units_of_measure = {**cls._units_of_measure, **definitions(cls.__name__, units_of_measure or {})}
        cls._options = {**cls._options, **{key: value for key, value in given.items() if value is not None}}

    def __new__(cls: type[U], *arguments: Any, **words: Any) -> U:
        unit = super().__new__(cls)
        unit._stride_sent = []
        unit._stride_end_ps = 0
        unit._stride_ends = False
        unit._stride_answer = []
        for attribute, variable in cls._variables.items():
            is_sender = isinstance(variable, MessageOutput)
            unit.__dict__[attribute] = _Sender(variable, unit) if is_sender else variable.new(variable.start)
        return unit

    def start(self) -> None:
        """Parameters and inputs have their values: computes the initial values of the outputs."""

    def step(self, now: Time, end: Time) -> Optional[float]:
        """Advances from one instant to the other. Returns None, or the instant before `end` at which it has ended."""
        raise NotImplementedError

    def event(self, now: Time) -> None:
        """Something happens at this instant: inputs have changed, messages have been received, or `next_event` has come.

        The step that ends there comes before it.
        """

    def next_event(self) -> Optional[float]:
        """Asked after each call: when something happens next, later than now, if that is known, or None."""
        return None

    def trace(self, file: str, signals: str) -> None:
        """To be overridden by a unit that can write a trace; called before `start`, if one is wanted."""

    def finish(self) -> None:
        """The run has ended well."""

    def log(self, text: object) -> None:
        """Writes a line to stride's log."""
        self._stride_answer.append(f'<log level="info" text="{printable(text)}"/>\n')

    def warn(self, text: object) -> None:
        """Writes a warning to stride's log."""
        self._stride_answer.append(f'<log level="warning" text="{printable(text)}"/>\n')

    def end_simulation(self) -> None:
        """Stride is to end the simulation where this step ends."""
        self._stride_ends = True
