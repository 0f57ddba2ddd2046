"""libstride by ctypes: the C interface of interfaces/stride/master.h, name by name."""

from __future__ import annotations

import ctypes
import functools
from ctypes import POINTER, c_char_p, c_double, c_int, c_int64, c_size_t, c_uint32, c_void_p
from pathlib import Path
from typing import Any, Optional

from ._errors import Error, InputError, MisuseError, RunError
from ._installed import choose_python, missing, prefix

SECOND = 10**12  # in picoseconds

OK, RUN_FAILED, INVALID_INPUT, MISUSE = range(4)


class Time(ctypes.Structure):
    """stride_time: times are counted in picoseconds in Python."""

    _fields_ = [("seconds", c_int64), ("picoseconds", c_int64)]

    @classmethod
    def of(cls, picoseconds: int) -> Time:
        return cls(*divmod(picoseconds, SECOND))

    def count(self) -> int:
        return int(self.seconds) * SECOND + int(self.picoseconds)

    def known(self) -> Optional[float]:
        """In seconds; None where there is no time."""
        return None if self.seconds == -(2**63) else seconds(self.count())


END_OF_TIME = 10**15 * SECOND


class StrideError(ctypes.Structure):
    _fields_ = [
        ("status", c_int),
        ("message", c_char_p),
        ("text", c_char_p),
        ("hint", c_char_p),
        ("file", c_char_p),
        ("line", c_int),
        ("component", c_char_p),
        ("variable", c_char_p),
        ("time", Time),
    ]


class Setting(ctypes.Structure):
    _fields_ = [("name", c_char_p), ("value", c_char_p)]


Log = ctypes.CFUNCTYPE(None, c_void_p, c_int, c_char_p)
Progress = ctypes.CFUNCTYPE(c_int, c_void_p, Time)


class Options(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("settings", POINTER(Setting)),
        ("setting_count", c_size_t),
        ("results", c_char_p),
        ("checkpoint", c_char_p),
        ("can_save", c_int),
        ("message_limit", c_size_t),
        ("progress", Progress),
        ("user", c_void_p),
    ]


class Bytes(ctypes.Structure):
    _fields_ = [("data", c_void_p), ("size", c_size_t)]


class Variable(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("name", c_char_p),
        ("component", c_char_p),
        ("type", c_int),
        ("causality", c_int),
        ("unit", c_char_p),
        ("description", c_char_p),
        ("count", c_size_t),
        ("dimensions", POINTER(c_size_t)),
        ("dimension_count", c_size_t),
        ("is_connected", c_int),
        ("is_message", c_int),
        ("clocks", POINTER(c_size_t)),
        ("clock_count", c_size_t),
        ("is_relative", c_int),
    ]


class Value(ctypes.Structure):
    _fields_ = [("index", c_size_t), ("elements", c_void_p), ("count", c_size_t)]


class Message(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("time", Time),
        ("super_dense_index", c_uint32),
        ("index", c_size_t),
        ("is_received", c_int),
        ("elements", c_void_p),
        ("count", c_size_t),
        ("content", c_char_p),
        ("dropped", c_size_t),
    ]


class Verdict(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("name", c_char_p),
        ("text", c_char_p),
        ("passed", c_int),
        ("time", Time),
        ("margin", c_double),
    ]


_FUNCTIONS = {
    "stride_last_error": (POINTER(StrideError), []),
    "stride_version": (c_char_p, []),
    "stride_set_log": (None, [Log, c_void_p]),
    "stride_seconds": (Time, [c_double]),
    "stride_open": (c_int, [c_char_p, POINTER(Options), POINTER(c_void_p)]),
    "stride_advance": (c_int, [c_void_p, Time]),
    "stride_end": (c_int, [c_void_p]),
    "stride_close": (c_int, [c_void_p]),
    "stride_interrupt": (None, [c_void_p]),
    "stride_now": (Time, [c_void_p]),
    "stride_start_time": (Time, [c_void_p]),
    "stride_stop_time": (Time, [c_void_p]),
    "stride_is_over": (c_int, [c_void_p]),
    "stride_end_reason": (c_char_p, [c_void_p]),
    "stride_variable_count": (c_size_t, [c_void_p]),
    "stride_describe": (c_int, [c_void_p, c_size_t, POINTER(Variable)]),
    "stride_find": (c_int, [c_void_p, c_char_p, POINTER(c_size_t)]),
    "stride_get": (c_int, [c_void_p, c_size_t, c_void_p, c_size_t]),
    "stride_set": (c_int, [c_void_p, c_size_t, c_void_p, c_size_t]),
    "stride_intervene": (c_int, [c_void_p, c_char_p, c_char_p]),
    "stride_send": (c_int, [c_void_p, c_size_t, POINTER(Value), c_size_t]),
    "stride_next_message": (c_int, [c_void_p, POINTER(Message)]),
    "stride_save": (c_int, [c_void_p, c_char_p]),
    "stride_verdict_count": (c_size_t, [c_void_p]),
    "stride_get_verdict": (c_int, [c_void_p, c_size_t, POINTER(Verdict)]),
}


def _find() -> Path:
    for folder in ("lib", "lib64", "lib/x86_64-linux-gnu"):
        found = sorted((prefix() / folder).glob("libstride.so*"))
        if found:
            return found[0]
    raise missing(f"libstride.so in {prefix()}/lib")


@functools.lru_cache(maxsize=None)
def library() -> Any:
    """The library with the types of its functions. Raises FileNotFoundError, or OSError for one that cannot be loaded."""
    choose_python()
    loaded = ctypes.CDLL(str(_find()))
    for name, (result, arguments) in _FUNCTIONS.items():
        function = getattr(loaded, name)
        function.restype = result
        function.argtypes = arguments
    return loaded


def text(value: Optional[bytes]) -> str:
    return (value or b"").decode("utf-8", "replace")


def seconds(time: int) -> float:
    return time / SECOND


def last_error() -> Error:
    """The exception for the status of the function of the library that has just failed."""
    error = library().stride_last_error().contents
    kind = {RUN_FAILED: RunError, INVALID_INPUT: InputError}.get(error.status, MisuseError)
    return kind(
        text(error.message),
        text=text(error.text),
        hint=text(error.hint) or None,
        file=text(error.file) or None,
        line=error.line or None,
        component=text(error.component) or None,
        variable=text(error.variable) or None,
        time=error.time.known(),
    )


def check(status: int) -> None:
    if status != OK:
        raise last_error()
