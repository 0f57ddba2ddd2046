"""Variables in the body of a class."""

from __future__ import annotations

import operator

from ._errors import UnitError
from ._values import MISTAKES, SCALARS, Array, type_name, type_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from typing import Any, Callable, Optional, TypeVar, Union

    Method = TypeVar("Method", bound=Callable[..., Any])


def refuse_words(where: str, given: Iterable[str], known: Iterable[str]) -> None:
    """Raises UnitError for the first word that is none of those that are known."""
    import difflib

    for word in given:
        names = sorted(known)
        plain = {name.replace("_", ""): name for name in names}
        similar = [plain[each] for each in difflib.get_close_matches(word.replace("_", "").lower(), plain, n=1)]
        hint = f"did you mean {similar[0]}=…?" if similar else f"known are: {', '.join(names)}"
        raise UnitError(f"{where}: there is no {word}=…; {hint}")


class Variable:
    """A variable in the body of a class; of an instance the attribute is its value.

    Args:
        type: float, int, bool, str, bytes; the name of a type of FMI, such as "Float32", or a type of numpy; or the
            start value, which has the type.
        start: The start value; zero, False or empty where it is not given.
        shape: Of a numpy array: a number, or one for each dimension.
        name: In the FMU, where it is another one than that of the attribute, such as "receive.frame".
        unit: Of measure, as Modelica writes it: "m", "km/h", "W/(m2.K)", "degC"; others are in `units_of_measure` of the
            class.
        relative: A difference, whose unit is converted without its offset: 10 degC are 10 K, not 283.15 K.
        min, max: Bounds of its values. Start values are compared with them, also those that a scenario gives; what is
            assigned later is not.
    """

    tag = ""

    def __init__(
        self,
        type: Any,
        *,
        start: Any = None,
        shape: Union[int, Sequence[int], None] = None,
        name: str = "",
        description: str = "",
        unit: str = "",
        relative: bool = False,
        min: Optional[float] = None,
        max: Optional[float] = None,
        **others: Any,
    ) -> None:
        self._refuse(others)
        self.attribute = ""
        self.name = name
        self.description = description
        self.unit = unit
        self.relative = relative
        self.min = min
        self.max = max
        try:
            found = type_name(type)
        except ValueError as mistake:
            raise UnitError(str(mistake)) from None
        if shape is not None:
            shape = (shape,) if isinstance(shape, int) else tuple(shape)
        if found is None and start is None:
            start = type
            found, own_shape = type_of(start)
            shape = own_shape if shape is None else shape
        if found is None:
            raise UnitError(
                f"{type!r:.80} is neither a type nor a start value: expected float, int, bool, str, bytes, an array, or"
                " the name of a type such as 'Float32'"
            )
        self.type_name = found
        self.shape = shape
        self._set_type()
        if start is not None:
            self.start = start

    def _refuse(self, others: dict[str, Any]) -> None:
        known: set[str] = set()
        for each in self.__class__.__mro__:
            known.update(getattr(each.__init__, "__kwdefaults__", None) or {})
        refuse_words(f"{self.__class__.__name__}(…)", others, known)

    def _set_type(self) -> None:
        self.new: Callable[[Any], Any] = lambda value: value
        if self.shape is None:
            self.start, self.read, self.text = SCALARS[self.type_name]
            return
        if self.type_name in ("String", "Binary"):
            raise UnitError("shape: expected of numbers and bool only")
        array = Array(self.type_name, self.shape)
        self.new, self.start, self.read, self.text = array.new, array.zeros(), array.read, array.text

    def attributes(self) -> dict[str, str]:
        """Those of the declaration in docs/process-protocol.md. Raises one of MISTAKES for another start value."""
        found = {"name": self.name, "type": self.type_name}
        if self.shape is not None:
            found["dimensions"] = " ".join(map(str, self.shape))
        text = self.text(self.start)
        found["start"] = self.start if self.type_name == "String" else text
        for key in ("unit", "description", "min", "max"):
            value = getattr(self, key)
            if value not in (None, ""):
                found[key] = str(value)
        if self.relative:
            found["relative"] = "true"
        return found

    def require_unit(self) -> None:
        """Raises UnitError where it has a unit of measure that its type has not."""
        if self.type_name.startswith("Float"):
            return
        for key in ("unit", "relative"):
            if value := getattr(self, key):
                raise UnitError(
                    f"{key}: expected of Float32 and Float64 only, is of {self.type_name}; write"
                    f" {type(self).__name__}(float, {key}={value!r})"
                )

    def require_bounds(self) -> None:
        """Raises UnitError where the start value is beyond them, or those of its type."""
        if self.type_name == "Float32" and self.shape is None and self.start and float(self.text(self.start)) == 0:
            raise UnitError(f"start: {self.start!r} is too near to 0 for a Float32; write 0.0, or take a Float64")
        elements = [self.start] if self.shape is None else self.new(self.start).ravel().tolist()
        for bound, is_within in (("min", operator.ge), ("max", operator.le)):
            limit = getattr(self, bound)
            if limit is None:
                continue
            if self.type_name in ("Boolean", "String", "Binary"):
                raise UnitError(f"{bound}: expected of numbers only")
            if isinstance(limit, bool) or not hasattr(limit, "__float__"):
                raise UnitError(f"{bound}: expected a number, is {limit!r:.80} ({type(limit).__name__})")
            if not all(is_within(element, limit) for element in elements):
                raise UnitError(
                    f"start: {self.start!r:.80} is beyond {bound}={limit!r}; give another start, or another {bound}"
                )

    def names(self) -> list[str]:
        """All that it has in the FMU."""
        return [self.name]

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.name or self.attribute}>"

    if TYPE_CHECKING:  # of an instance it is a value, which is in its dictionary

        def __get__(self, instance: Optional[object], owner: type) -> Any: ...

        def __set__(self, instance: object, value: Any) -> None: ...


class Parameter(Variable):
    """What is set before the start, and stays."""

    tag = "parameter"


class Input(Variable):
    """Has its value before each step and each event. `discrete`: it changes at events only, as all do that are no float."""

    tag = "input"

    def __init__(self, type: Any, *, discrete: bool = False, **options: Any) -> None:
        super().__init__(type, **options)
        self.discrete = discrete

    def attributes(self) -> dict[str, str]:
        return {**super().attributes(), **({"variability": "discrete"} if self.discrete else {})}


class Output(Input):
    """Assigned by the unit; read after each step and each event.

    `depends_on`: the names of the inputs on which it depends at the same instant. Without it none, if the class has
    neither `start` nor `event` nor receives messages, or else all.
    """

    tag = "output"

    def __init__(self, type: Any, *, depends_on: Optional[Iterable[str]] = None, **options: Any) -> None:
        super().__init__(type, **options)
        self.depends_on = depends_on


class Message(Variable):
    """`clock`: the name of its clock; `mime_type`: of a Binary."""

    def __init__(self, type: Any, *, clock: str = "", mime_type: str = "", **options: Any) -> None:
        super().__init__(type, **options)
        self.clock = clock
        self.mime_type = mime_type

    def clock_name(self) -> str:
        """`receive.frame` has the clock `receive.clock`, `frame` has `frame.clock`."""
        return self.clock or f"{self.name.rpartition('.')[0] or self.name}.clock"

    def names(self) -> list[str]:
        return [self.name, self.clock_name()]

    def attributes(self) -> dict[str, str]:
        mime_type = {"mime-type": self.mime_type} if self.mime_type else {}
        return {**super().attributes(), "clock": self.clock_name(), **mime_type}


class MessageInput(Message):
    """Messages that arrive; `@NAME.receive` decorates the method that is called with each of them, at `self.now`."""

    tag = "message-input"
    receiver = ""
    """The name of the method."""

    def receive(self, method: Method) -> Method:
        self.receiver = method.__name__
        return method

    if TYPE_CHECKING:

        def __get__(self, instance: Optional[object], owner: type) -> MessageInput: ...


class MessageOutput(Message):
    """Messages that the unit sends: `self.NAME.send(value)`."""

    tag = "message-output"


def definitions(cls: str, units: dict[str, tuple[Any, ...]]) -> dict[str, dict[str, str]]:
    """The elements of docs/process-protocol.md that define units of measure, by their names."""
    found = {}
    for name, given in units.items():
        try:
            factor, unit, offset = (*given, 0.0) if len(given) == 2 else given
            found[name] = {"name": name, "factor": repr(float(factor)), "unit": unit, "offset": repr(float(offset))}
        except (TypeError, ValueError):
            raise UnitError(
                f"{cls}: units_of_measure: '{name}' is {given!r:.80}; expected (factor, unit) or (factor, unit, offset),"
                " such as (201.168, 'm')"
            ) from None
        if not isinstance(unit, str):
            raise UnitError(f"{cls}: units_of_measure: '{name}': the unit is {unit!r:.80}, expected text such as 'm'")
    return found


def collect(cls: type, base: type) -> dict[str, Variable]:
    """The variables of a class that derives from `base`, and of its bases, by their attributes."""
    found: dict[str, Variable] = {}
    for each in reversed(cls.__mro__):
        found.update((key, value) for key, value in vars(each).items() if isinstance(value, Variable))
    names: dict[str, str] = {}
    for attribute, variable in found.items():
        where = f"{cls.__name__}.{attribute}"
        variable.attribute = attribute
        variable.name = variable.name or attribute
        if hasattr(base, attribute):
            raise UnitError(
                f"{where}: each unit has something of this name; choose another one, and give name='{variable.name}' if"
                " the FMU is to have it"
            )
        for name in variable.names():
            if names.setdefault(name, attribute) != attribute:
                raise UnitError(f"{where}: '{names[name]}' has the name '{name}', too; give it another name='…'")
        try:
            variable.attributes()
        except MISTAKES as mistake:
            raise UnitError(f"{where}: start: {mistake}") from None
        try:
            variable.require_unit()
            variable.require_bounds()
        except UnitError as mistake:
            raise UnitError(f"{where}: {mistake}") from None
    return found
