"""A run of a scenario, step by step, in the process of Python."""

from __future__ import annotations

import atexit
import ctypes
import functools
import logging
import math
import os
import signal
import threading
import time
import weakref
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Optional

import numpy as np

from . import _library as c
from ._errors import InputError, MisuseError, RunError
from ._options import PathLike, path_of, refuse_keyword, settings

__all__ = ["Message", "Simulation", "Variable", "Verdict"]


_DTYPES = [np.dtype(name) for name in "float32 float64 int8 uint8 int16 uint16 int32 uint32 int64 uint64 bool".split()]
_STRING, _BINARY, _ENUMERATION, _CLOCK = range(11, 15)
TYPES = (
    "Float32 Float64 Int8 UInt8 Int16 UInt16 Int32 UInt32 Int64 UInt64 Boolean String Binary Enumeration Clock"
).split()
_CAUSALITIES = "parameter calculatedParameter structuralParameter input output local independent".split()

_log = logging.getLogger("stride")


def _log_message(_user: Any, level: int, message: bytes) -> None:
    _log.log((logging.INFO, logging.WARNING, logging.ERROR)[level], "%s", c.text(message))


_write_log = c.Log(_log_message)  # kept as long as the library may call it


def _library() -> Any:
    library = c.library()
    if not getattr(library, "has_log", False):
        library.stride_set_log(_write_log, None)
        library.has_log = True
    return library


@dataclass(frozen=True)
class Variable:
    """What is known of a variable.

    Attributes:
        name: "sensor.led"; of an output of the system "led".
        component: "sensor"; empty for an output of the system.
        type: As FMI names it: "Float64", "Boolean", "Binary", "Clock" and so on.
        causality: "parameter", "input", "output", "local" and so on.
        unit: Of measure: "V"; empty if there is none.
        shape: Of an array; () is a scalar.
        is_connected: It is an input with a source, so it cannot be set, but forced.
        is_message: It has values at ticks of a clock only; `clocks` are the names of its clocks.
        is_relative: It is a difference, whose unit is converted without its offset.
    """

    name: str
    component: str
    type: str
    causality: str
    unit: str
    description: str
    shape: tuple[int, ...]
    is_connected: bool
    is_message: bool
    clocks: tuple[str, ...]
    is_relative: bool = False


@dataclass(frozen=True)
class Message:
    """A message that a component has sent or received.

    Attributes:
        time: [s].
        variable: "reader.transmit.frame", or the name of the clock of a message without a value.
        received: Whether it is one that the component has received; otherwise it has sent it.
        value: bytes, a number or a text; an array of them; None without a value. In the events of a `Run` the text
            that events.csv has: hexadecimal digits for bytes.
        content: What a Binary value means, in the words of its unit; may be empty.
        index: Which event iteration at this time (super-dense time).
    """

    time: float
    variable: str
    received: bool
    value: Any
    content: str
    index: int


@dataclass(frozen=True)
class Verdict:
    """What a unit, or a check of the scenario, says of the run.

    Attributes:
        passed: None: not decided.
        time: Of the first failure [s], or None.
        margin: How far from failing, in the check's unit; negative: failed. None: it has none.
    """

    name: str
    passed: Optional[bool]
    text: str
    time: Optional[float] = None
    margin: Optional[float] = None


class Simulation:
    """A run of a scenario, which is advanced, looked at and changed from Python.

    >>> with stride.Simulation("two_filters.ssd", set={"fast.time_constant": 0.1}) as sim:
    ...     sim.step(until=0.5)
    ...     print(sim.time, sim["slow.y"])

    It is at its start time when it is made: its units are initialised. Times are in seconds; picoseconds are kept
    (`time_ps`). Values are Python's bool, int, float, str and bytes, and numpy arrays with the shape of the variable.

    Args:
        scenario: A system file (.ssd), a package (.ssp), an FMU (.fmu) or a table (.csv, .parquet, .mcap).
        results: The folder of the results, which is made; None: none are written.
        checkpoint: A file that `save` has written, of the same scenario and options, to go on from.
        can_save: Whether `save` will be called; units are journaled then, which takes memory.
        messages: How many messages are kept between two calls of `messages`, at most.
        options: Those of `stride run` that concern the scenario, with "_" for "-": `set={"sensor.gain": 2}`,
            `swap={"sensor": "new.fmu"}`, `stop=3`, `isolate=True`, `no_idle_skip=True`. See `stride run --help`.

    Raises:
        InputError: The scenario, an option or a value is wrong.
        RunError: A unit, the simulation or the machine has failed. The simulation is over then.
        MisuseError: A call that makes no sense now.

    A unit that crashes ends Python with it, unless it is in a process of its own: `isolate=True`. A simulation is for
    one thread at a time, and for the process that has made it.
    """

    def __init__(
        self,
        scenario: PathLike,
        *,
        results: Optional[PathLike] = None,
        checkpoint: Optional[PathLike] = None,
        can_save: bool = False,
        messages: int = 10000,
        **options: Any,
    ) -> None:
        self._handle = ctypes.c_void_p()
        self._last: Optional[list[Verdict]] = None
        self._library = _library()
        if not isinstance(messages, int) or not 0 <= messages < 2**63:
            raise InputError(f"messages= is a number of messages, not {messages!r}")
        if not isinstance(can_save, (bool, np.bool_)):
            raise InputError(f"can_save= is True or False, not {can_save!r:.80}")
        refuse_keyword(options, "out", "results")
        pairs = settings(options)
        system = os.fsencode(path_of(scenario, "the scenario"))
        for name, value in pairs:
            _text_bytes(f"{name}={value}", "an option")
        array = (c.Setting * len(pairs))(
            *[c.Setting(name.encode(), None if value is None else value.encode()) for name, value in pairs]
        )
        self._interruption = _Interruption()
        _open_simulations.add(self)
        self._progress = c.Progress(self._interruption.tell)  # kept as long as the library may call it
        given = c.Options(
            size=ctypes.sizeof(c.Options),
            settings=array,
            setting_count=len(pairs),
            results=None if results is None else os.fsencode(path_of(results, "results")),
            checkpoint=None if checkpoint is None else os.fsencode(path_of(checkpoint, "checkpoint")),
            can_save=bool(can_save),
            message_limit=messages,
            progress=self._progress,
        )
        c.check(self._library.stride_open(system, ctypes.byref(given), ctypes.byref(self._handle)))

    # ---- Life ----

    def __enter__(self) -> Simulation:
        self._open()
        return self

    def __exit__(self, kind: Any, *_exception: Any) -> None:
        try:
            self.close()
        except RunError as error:
            if kind is None:
                raise
            _log.error("%s", error)  # the exception under way is the one to be told

    def __del__(self) -> None:
        if getattr(self, "_handle", None):
            self._library.stride_close(self._handle)

    def __repr__(self) -> str:
        if not self._handle:
            return "<stride.Simulation, closed>"
        return f"<stride.Simulation at {self.time:.12g} s of {self.stop_time:.12g} s>"

    def __reduce__(self) -> Any:
        raise TypeError("a simulation cannot be copied")

    def close(self) -> None:
        """Ends the run, if it has not ended, and frees its units. May be called again.

        Raises RunError where the run cannot be ended, as its results cannot be written; it is closed all the same.
        """
        if not self._handle:
            return
        if self._interruption.is_active:
            raise MisuseError("the simulation is in a step, so it cannot be closed: interrupt it")
        try:
            if not self.has_ended:
                self.end()
        finally:
            handle, self._handle = self._handle, ctypes.c_void_p()
            self._library.stride_close(handle)

    def end(self) -> list[Verdict]:
        """Ends the run where it is: units are terminated, verdicts given, results completed. Returns the verdicts."""
        self._call("stride_end")
        self._last = self._read_verdicts()
        return self._last

    @property
    def has_ended(self) -> bool:
        """Whether its units are terminated, because `end` was called or it has failed."""
        reason = self.end_reason
        return reason == "failed" or self._ended

    _ended = False

    # ---- Time ----

    @property
    def time(self) -> float:
        """The instant that the simulation has reached [s]."""
        return c.seconds(self.time_ps)

    @property
    def time_ps(self) -> int:
        """Likewise, in picoseconds, exactly."""
        return self._library.stride_now(self._open()).count()

    @property
    def start_time(self) -> float:
        """[s]."""
        return c.seconds(self._library.stride_start_time(self._open()).count())

    @property
    def stop_time(self) -> float:
        """[s]."""
        return c.seconds(self._library.stride_stop_time(self._open()).count())

    @property
    def is_over(self) -> bool:
        """Whether there is nothing more to simulate."""
        return bool(self._library.stride_is_over(self._open()))

    @property
    def end_reason(self) -> str:
        """Once it is over, "completed", "ended by a unit", "interrupted", "ended early" or "failed"."""
        return c.text(self._library.stride_end_reason(self._open()))

    def step(self, duration: Optional[float] = None, *, until: Optional[float] = None) -> float:
        """Simulates for this time, or until this instant [s], or to the end of the run if that is earlier.

        A communication step ends there, as it does at an intervention. Returns the time that is reached.
        Ctrl-C interrupts it: the results are complete up to there, and the run is over.
        """
        if (duration is None) == (until is None):
            raise MisuseError("step() takes a duration, or until=, and not both")
        seconds = duration if until is None else until
        if not isinstance(seconds, (int, float, np.number)):
            raise InputError(f"a time in seconds is a number, not {seconds!r}")
        try:
            number = float(seconds)
        except OverflowError:
            number = math.inf if seconds > 0 else -math.inf
        if math.isnan(number):
            raise InputError(f"a time in seconds is a number, not {seconds!r}")
        if duration is not None and duration < 0:
            raise InputError(f"a step of {duration} s would go back")
        target = self._library.stride_seconds(number).count()
        if duration is not None:
            if target == 0 < duration:
                raise InputError(f"a step of {duration} s is shorter than a picosecond, in which stride counts")
            target = min(self.time_ps + target, c.END_OF_TIME)
        return self._advance(target)

    def run(self) -> float:
        """Simulates to the end of the run. Returns the time that is reached."""
        return self._advance(c.END_OF_TIME)

    def _advance(self, target: int) -> float:
        with self._interruption:
            self._call("stride_advance", c.Time.of(target))
        return self.time

    # ---- Variables ----

    @functools.cached_property
    def variables(self) -> Mapping[str, Variable]:
        """All variables, by their names, in the order of their indices."""
        raw = [self._describe(index) for index in range(self._library.stride_variable_count(self._open()))]
        names = [name for name, _ in raw]
        return MappingProxyType({name: make(names) for name, make in raw})

    @functools.cached_property
    def _indices(self) -> dict[str, int]:
        return {name: index for index, name in enumerate(self.variables)}

    @functools.cached_property
    def _by_index(self) -> list[Variable]:
        return list(self.variables.values())

    def _describe(self, index: int) -> tuple[str, Any]:
        raw = c.Variable(size=ctypes.sizeof(c.Variable))
        c.check(self._library.stride_describe(self._open(), index, ctypes.byref(raw)))
        name = c.text(raw.name)
        clocks = [raw.clocks[i] for i in range(raw.clock_count)]
        known = dict(
            name=name,
            component=c.text(raw.component),
            type=TYPES[raw.type],
            causality=_CAUSALITIES[raw.causality],
            unit=c.text(raw.unit),
            description=c.text(raw.description),
            shape=tuple(raw.dimensions[i] for i in range(raw.dimension_count)),
            is_connected=bool(raw.is_connected),
            is_message=bool(raw.is_message),
            is_relative=bool(raw.is_relative),
        )
        return name, lambda names: Variable(**known, clocks=tuple(names[clock] for clock in clocks))

    def _find(self, name: str) -> tuple[int, Variable]:
        if not isinstance(name, str):
            raise InputError(f"the name of a variable is a text, not {name!r}")
        if name in self._indices:
            return self._indices[name], self.variables[name]
        index = ctypes.c_size_t()
        c.check(
            self._library.stride_find(self._open(), _text_bytes(name, "a name"), ctypes.byref(index))
        )  # fails with a suggestion, unless it is the short name of a unit that is run alone
        return index.value, self._by_index[index.value]

    def __contains__(self, name: object) -> bool:
        return name in self.variables

    def __iter__(self) -> Iterator[str]:
        return iter(self.variables)

    def __getitem__(self, name: str) -> Any:
        """The value of a variable at the present instant."""
        index, variable = self._find(name)
        count = math.prod(variable.shape)
        elements = _space(TYPES.index(variable.type), count)
        self._call("stride_get", index, ctypes.byref(elements), count)
        return _value(variable, elements, count)

    def __setitem__(self, name: str, value: Any) -> None:
        """Sets a tunable parameter, or an input without a source, at the present instant.

        An enumeration takes a number, or the name of an item.
        """
        index, variable = self._find(name)
        if variable.is_message and variable.causality == "input":
            raise InputError(
                f"'{name}' is a message, which cannot be set", hint=f'send it: sim.send("{name}", …)', **_place(variable)
            )
        if variable.type == "Enumeration" and isinstance(value, str):
            return self._set_item(variable, value)
        elements, count = _elements(variable, value)
        self._call("stride_set", index, ctypes.byref(elements), count)

    def _set_item(self, variable: Variable, item: str) -> None:
        """Of an enumeration: the library knows the items, and lists them."""
        seconds, picoseconds = divmod(self.time_ps, c.SECOND)
        try:
            self.intervene("set-at", f"{variable.name}={item}@{seconds}.{picoseconds:012}")
        except InputError as error:
            raise InputError(f"'{variable.name}': {error.text}", hint=error.hint, **_place(variable)) from None

    # ---- Messages and interventions ----

    def send(self, name: str, value: Any = None, /, **values: Any) -> None:
        """Sends a message to a component at the present instant.

        Args:
            name: The input that receives it, with its value: `send("sensor.receive.frame", frame)`; or a clock,
                with the values of inputs that belong to it, by their names in the component:
                `send("sensor.receive.clock", **{"receive.frame": frame})`.
        """
        index, variable = self._find(name)
        payload = []
        if variable.type != "Clock":
            if len(variable.clocks) != 1:
                raise InputError(f"'{name}' belongs to {len(variable.clocks)} clocks; name the clock")
            payload.append((name, value))
            index, variable = self._find(variable.clocks[0])
        elif value is not None:
            raise InputError(f"'{name}' is a clock, which has no value; name the input that has")
        payload += [(f"{variable.component}.{key}", item) for key, item in values.items()]
        for key, count in Counter(key for key, _ in payload).items():
            if count > 1:
                raise InputError(f"'{key}' has two values", hint="give one, as the value or by its name")
        array = (c.Value * len(payload))()
        kept = []
        for entry, (key, item) in zip(array, payload):
            entry.index, described = self._find(key)
            elements, entry.count = _elements(described, item)
            entry.elements = ctypes.cast(ctypes.byref(elements), ctypes.c_void_p)
            kept.append(elements)
        self._call("stride_send", index, array, len(payload))

    def messages(self) -> list[Message]:
        """What components have sent and received since the last call, in order.

        What `send` sends is received at the next step, or where a variable is read, and among them from then on.
        """
        found = []
        raw = c.Message(size=ctypes.sizeof(c.Message))
        while self._library.stride_next_message(self._open(), ctypes.byref(raw)):
            if raw.dropped:
                _log.warning("%d messages were more than are kept (messages=)", raw.dropped)
            variable = self._by_index[raw.index]
            value = None
            if raw.elements:
                space = _space(TYPES.index(variable.type), raw.count)
                ctypes.memmove(space, raw.elements, ctypes.sizeof(space))
                value = _value(variable, space, raw.count)
            found.append(
                Message(
                    c.seconds(raw.time.count()),
                    variable.name,
                    bool(raw.is_received),
                    value,
                    c.text(raw.content),
                    raw.super_dense_index,
                )
            )
        return found

    def intervene(self, option: str, text: str) -> None:
        """What the option of `stride run` with this name does, from now on or later.

        >>> sim.intervene("force", "sensor.supply.voltage=2@1.5..2")
        """
        name = _text_bytes(option, "an option").replace(b"_", b"-")  # also as an argument of Python has it
        self._call("stride_intervene", name, _text_bytes(text, "an intervention"))

    def save(self, file: PathLike) -> None:
        """Writes a checkpoint of the present instant: see the arguments `can_save` and `checkpoint`."""
        self._call("stride_save", os.fsencode(path_of(file, "the checkpoint")))

    @property
    def verdicts(self) -> list[Verdict]:
        """Of the units and the scenario's checks. Raises MisuseError before the run has ended."""
        if self._last is None and self._handle and self.has_ended:
            self._last = self._read_verdicts()
        if self._last is None:
            hint = ": call end()" if self._handle else ", and it was closed without having ended"
            raise MisuseError(f"there are no verdicts before the run has ended{hint}")
        return self._last

    def _read_verdicts(self) -> list[Verdict]:
        handle = self._open()
        found = []
        for index in range(self._library.stride_verdict_count(handle)):
            raw = c.Verdict(size=ctypes.sizeof(c.Verdict))
            c.check(self._library.stride_get_verdict(handle, index, ctypes.byref(raw)))
            found.append(
                Verdict(
                    c.text(raw.name),
                    None if raw.passed < 0 else bool(raw.passed),
                    c.text(raw.text),
                    raw.time.known(),
                    None if math.isnan(raw.margin) else raw.margin,
                )
            )
        return found

    # ---- Calls ----

    def _open(self) -> ctypes.c_void_p:
        if not self._handle:
            raise MisuseError("the simulation is closed")
        return self._handle

    def _call(self, function: str, *arguments: Any) -> None:
        c.check(getattr(self._library, function)(self._open(), *arguments))
        if function == "stride_end":
            self._ended = True


# ---- Interruption ----


class _Interruption:
    """During a step: handlers of signals are called, and what they raise ends the run and goes on behind the step.

    The library calls `tell` now and then, and Python its handlers meanwhile. What these raised there would be lost.
    """

    _SIGNALS = tuple(
        getattr(signal, name)
        for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGALRM", "SIGUSR1", "SIGUSR2")
        if hasattr(signal, name)
    )

    is_python_ending = False

    def __init__(self) -> None:
        self.is_active = False
        self._raised: Optional[BaseException] = None
        self._handlers: dict[int, Any] = {}

    def __enter__(self) -> None:
        if self.is_active:
            raise MisuseError("the simulation is in a step already")
        if _Interruption.is_python_ending:
            raise MisuseError("Python is about to end")
        self.is_active = True
        self._raised = None
        if threading.current_thread() is not threading.main_thread():
            return
        for number in self._SIGNALS:
            if callable(handler := signal.getsignal(number)):
                self._handlers[number] = handler
                signal.signal(number, self._handle)

    def __exit__(self, *_exception: Any) -> None:
        for number, handler in self._handlers.items():
            if signal.getsignal(number) == self._handle:  # else the handler has put another one in its place
                signal.signal(number, handler)
        self._handlers.clear()
        self.is_active = False
        if self._raised is not None:
            raise self._raised from None

    def _handle(self, number: int, frame: Any) -> None:
        try:
            self._handlers[number](number, frame)
        except BaseException as raised:  # noqa: BLE001 - such as KeyboardInterrupt and SystemExit
            self._raised = raised

    def tell(self, _user: Any, _time: Any) -> int:
        return 0 if self._raised is None else 1


_open_simulations: weakref.WeakSet[Simulation] = weakref.WeakSet()


@atexit.register
def _end_steps() -> None:
    """Those of daemon threads, which must not come back to a Python that is no more."""
    _Interruption.is_python_ending = True
    for simulation in list(_open_simulations):
        if simulation._interruption.is_active:
            simulation._library.stride_interrupt(simulation._handle)
    while any(simulation._interruption.is_active for simulation in list(_open_simulations)):
        time.sleep(0.001)


# ---- Values ----


def _text_bytes(text: str, what: str, **where: Any) -> bytes:
    """Raises InputError for what no text in C can be."""
    if not isinstance(text, str):
        raise InputError(f"{what} is a text, not {text!r:.80}", **where)
    try:
        encoded = text.encode()
    except UnicodeEncodeError:
        raise InputError(f"{what}: {text!r} cannot be written in UTF-8", **where) from None
    if b"\0" in encoded:
        raise InputError(f"{what}: a text has no NUL: {text!r}", **where)
    return encoded


def _space(type_: int, count: int) -> Any:
    """Room for elements of the C type."""
    if type_ == _STRING:
        return (ctypes.c_char_p * count)()
    if type_ == _BINARY:
        return (c.Bytes * count)()
    dtype = np.dtype("int64") if type_ == _ENUMERATION else _DTYPES[min(type_, 10)]
    return (np.ctypeslib.as_ctypes_type(dtype) * count)()


def _value(variable: Variable, elements: Any, count: int) -> Any:
    if variable.type == "String":
        values: Any = [c.text(text) for text in elements]
    elif variable.type == "Binary":
        values = [ctypes.string_at(each.data, each.size) if each.size else b"" for each in elements]
    else:
        values = np.ctypeslib.as_array(elements)
    if variable.shape:
        if isinstance(values, list):
            array = np.empty(count, dtype=object)
            array[:] = values
            values = array
        return values.reshape(variable.shape)
    return values[0] if isinstance(values, list) else values[0].item()


def _place(variable: Variable) -> dict[str, Any]:
    """For an error."""
    local_name = variable.name[len(variable.component) + 1 :] if variable.component else variable.name
    return {"component": variable.component, "variable": local_name}


def _flat(value: Any, shape: tuple[int, ...]) -> Optional[list[Any]]:
    """The elements of nested sequences, which are texts or bytes; None where the shape is another one."""
    if not shape:
        return [value]
    if isinstance(value, (str, bytes, bytearray, memoryview)) or not isinstance(value, Iterable):
        return None
    parts = [_flat(part, shape[1:]) for part in value] if getattr(value, "ndim", 1) > 0 else []
    if len(parts) != shape[0]:
        return None
    found: list[Any] = []
    for part in parts:
        if part is None:
            return None
        found += part
    return found


def _elements(variable: Variable, value: Any) -> tuple[Any, int]:
    """The elements in their C type. Raises InputError for what is none of the variable."""
    count = math.prod(variable.shape)
    where = _place(variable)

    def fail(wanted: str) -> InputError:
        return InputError(f"'{variable.name}' is {wanted}, not {value!r}", **where)

    if variable.type == "Clock":
        raise fail("a clock, which has no value")
    if variable.type in ("String", "Binary"):
        wanted = str if variable.type == "String" else (bytes, bytearray, memoryview)
        flat = _flat(value, variable.shape)
        if flat is None or not all(isinstance(element, wanted) for element in flat):
            kind = "a text (str)" if variable.type == "String" else "bytes"
            raise fail(f"an array of {kind.removeprefix('a ')} with the shape {variable.shape}" if variable.shape else kind)
        if variable.type == "String":
            texts = [_text_bytes(element, variable.name, **where) for element in flat]
            return (ctypes.c_char_p * count)(*texts), count
        space: Any = (c.Bytes * count)()
        space.kept = [ctypes.create_string_buffer(bytes(element), len(element) or 1) for element in flat]
        for entry, buffer, element in zip(space, space.kept, flat):
            entry.data = ctypes.cast(buffer, ctypes.c_void_p)
            entry.size = len(element)
        return space, count
    dtype = np.dtype("int64") if variable.type == "Enumeration" else _DTYPES[TYPES.index(variable.type)]
    wanted_text = f"of the type {variable.type}" + (f" and the shape {variable.shape}" if variable.shape else "")
    try:
        given = np.asarray(value)
    except ValueError:
        raise fail(wanted_text) from None
    if given.shape != variable.shape or given.dtype.kind not in "biuf":
        raise fail(wanted_text)
    with np.errstate(all="ignore"):
        converted = given.astype(dtype)
    is_exact = dtype.kind != "f" and np.array_equal(converted.astype(object), given.astype(object))
    if dtype.kind == "f":
        exact = given.astype(float)
        is_exact = np.array_equal(np.isfinite(converted), np.isfinite(exact))
        is_exact = is_exact and np.array_equal(converted == 0, exact == 0)  # 1e-50 as Float32
    if not is_exact or (dtype.kind != "b" and given.dtype.kind == "b"):
        raise fail(wanted_text)
    space = (np.ctypeslib.as_ctypes_type(dtype) * count)()
    np.ctypeslib.as_array(space)[...] = converted.ravel()
    return space, count
