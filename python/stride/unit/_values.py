"""Values as the texts of docs/process-protocol.md, and back."""

from __future__ import annotations

import operator
import struct

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Callable, NoReturn, Optional

# what a text or a number of the wrong kind is refused with
MISTAKES = (TypeError, ValueError, OverflowError)


def _refuse(expected: str, value: object) -> NoReturn:
    raise TypeError(f"expected {expected}, is {value!r:.80} ({type(value).__name__})")


# ---- Numbers ----


def _float_text(value: Any) -> str:
    if type(value) is float:
        return repr(value)
    if isinstance(value, (str, bytes, bytearray, bool)) or not hasattr(value, "__float__"):
        _refuse("a float", value)
    try:
        return repr(float(value))
    except OverflowError:
        raise _beyond("Float64", "1.7976931348623157e+308", f"a larger {type(value).__name__}") from None


def _beyond(name: str, most: str, value: str) -> OverflowError:
    return OverflowError(f"expected a number of the type {name}, from -{most} to {most}, is {value}")


_LEAST_FLOAT32 = 1.1754943508222875e-38  # below it a Float32 loses digits, and stride refuses what it has not


def _float32_text(value: Any) -> str:
    text = _float_text(value)
    try:
        rounded = struct.unpack("<f", struct.pack("<f", float(text)))[0]
    except OverflowError:
        raise _beyond("Float32", "3.4028234663852886e+38", text) from None
    return repr(rounded) if abs(rounded) < _LEAST_FLOAT32 else text


def _float32(text: str) -> float:
    number: float = struct.unpack("f", struct.pack("f", float(text)))[0]
    return number


def _int_text(name: str) -> Callable[[Any], str]:
    """Of the type with this name, such as Int64."""
    size = int(name.lstrip("UInt"))
    least, most = (0, 2**size - 1) if name[0] == "U" else (-(2 ** (size - 1)), 2 ** (size - 1) - 1)

    def text(value: Any) -> str:
        if type(value) is not int:
            if isinstance(value, bool) or not hasattr(value, "__index__"):
                _refuse("an int", value)
            value = operator.index(value)
        if not least <= value <= most:
            raise OverflowError(f"expected a number of the type {name}, from {least} to {most}, is {value}")
        return str(value)

    return text


def _bool_text(value: Any) -> str:
    if not isinstance(value, bool) and getattr(getattr(value, "dtype", None), "kind", "") != "b":
        _refuse("a bool", value)
    return "true" if value else "false"


# ---- Texts and bytes ----

_ESCAPES = {ord(c): f"&#{ord(c)};" for c in '&<"\t\n\r'}


def _str_text(value: Any) -> str:
    if not isinstance(value, str):
        _refuse("a str", value)
    if not value.isprintable():
        for c in value:
            if (c < " " and c not in "\t\n\r") or "\ud800" <= c <= "\udfff" or c in "\ufffe\uffff":
                raise ValueError(f"a str cannot have the character {c!r} here, but bytes can")
    return value.translate(_ESCAPES)


def printable(value: object) -> str:
    """The text of anything; where XML lacks a character, what Python writes for it."""
    text = str(value)
    try:
        return _str_text(text)
    except ValueError:
        return _str_text("".join(c if c.isprintable() or c in "\t\n" else repr(c)[1:-1] for c in text))


def _bytes_text(value: Any) -> str:
    if not isinstance(value, (bytes, bytearray, memoryview)):
        _refuse("bytes", value)
    return bytes(value).hex()


# ---- Types ----

_INTS = ("Int8", "Int16", "Int32", "Int64", "UInt8", "UInt16", "UInt32", "UInt64")

# name in FMI -> zero, from text, to text
SCALARS: dict[str, tuple[Any, Callable[[str], Any], Callable[[Any], str]]] = {
    "Float64": (0.0, float, _float_text),
    "Float32": (0.0, _float32, _float32_text),
    **{name: (0, int, _int_text(name)) for name in _INTS},
    "Boolean": (False, "true".__eq__, _bool_text),
    "String": ("", str, _str_text),
    "Binary": (b"", bytes.fromhex, _bytes_text),
}
_OF_PYTHON = {bool: "Boolean", float: "Float64", int: "Int64", str: "String", bytes: "Binary"}
_OF_NUMPY = {name.lower(): name for name in ("Float32", "Float64", *_INTS)}
_OF_NUMPY.update({"bool": "Boolean", "bool_": "Boolean"})


# names of other languages and of FMI 2
_ALMOST = {
    "double": "Float64",
    "float": "Float64",
    "real": "Float64",
    "single": "Float32",
    "int": "Int64",
    "integer": "Int32",
    "bool": "Boolean",
    "str": "String",
    "bytes": "Binary",
}
_UNKNOWN = ("clock", "enumeration")


def _types_like(text: str) -> list[str]:
    """The types that may be meant by a text that is none of their names; empty for a text like any other."""
    word = text.strip().lower().removeprefix("numpy.").removeprefix("np.")
    known = {**{name.lower(): name for name in SCALARS}, **_ALMOST}
    if word in known:
        return [known[word]]
    digits = word.removeprefix("u").removeprefix("int").removeprefix("float")
    if word in _UNKNOWN or (digits.isdigit() and digits != word):
        return [*SCALARS]
    if " " in word:
        return []
    import difflib

    names = [name.lower() for name in SCALARS]
    if close := difflib.get_close_matches(word, names, n=1, cutoff=0.8):
        return [known[close[0]]]
    swapped = [name for name in _ALMOST if len(name) > 4 and sorted(name) == sorted(word)]  # such as "flaot"
    return [f"{name} ({_ALMOST[name]})" for name in swapped]


def type_name(given: Any) -> Optional[str]:
    """The name in FMI of float, "Float32", numpy.float32 and the like; None if it is no type.

    Raises ValueError for what is the name of a type elsewhere, and would be a text here.
    """
    if isinstance(given, str):
        if given in SCALARS:
            return given
        if similar := _types_like(given):
            raise ValueError(
                f"there is no type '{given}'; expected {', '.join(similar)}, or for the text {given!r}"
                f" (str, start={given!r})"
            )
        return None
    if isinstance(given, type):
        return _OF_PYTHON.get(given) or _OF_NUMPY.get(given.__name__)
    return _OF_NUMPY.get(str(given)) if hasattr(given, "itemsize") and hasattr(given, "kind") else None


def type_of(value: Any) -> tuple[Optional[str], Optional[tuple[int, ...]]]:
    """The name in FMI of the type of a value, and the shape if it is an array; None if it has no such type."""
    for type_, name in _OF_PYTHON.items():
        if isinstance(value, type_):
            return name, None
    if not isinstance(value, (list, tuple)) and not hasattr(value, "dtype"):
        return None, None
    import numpy

    array = numpy.asarray(value)
    return _OF_NUMPY.get(array.dtype.name), array.shape or None


class Array:
    """Arrays of numpy with this shape and elements of the type with this name; the reader and writer of their texts."""

    def __init__(self, name: str, shape: tuple[int, ...]) -> None:
        import numpy

        self._numpy = numpy
        self._shape = shape
        self._dtype = numpy.dtype("bool" if name == "Boolean" else name.lower())
        self._name = f"an array of {self._dtype.name} with the shape {shape}"

    def zeros(self) -> Any:
        return self._numpy.zeros(self._shape, self._dtype)

    def new(self, value: Any) -> Any:
        """A copy with the type. Raises one of MISTAKES where that would lose something."""
        array = self._numpy.asarray(value)
        kind, expected = array.dtype.kind, self._dtype.kind
        is_suitable = kind == expected or (kind in "iu" and expected in "iuf")
        if array.shape != self._shape or not is_suitable:
            raise TypeError(f"expected {self._name}, is one of {array.dtype} with the shape {array.shape}")
        with self._numpy.errstate(over="ignore"):
            copy = array.astype(self._dtype)
        is_other = copy != array if expected in "iu" else self._numpy.isinf(copy) & ~self._numpy.isinf(array)
        if expected != "b" and is_other.any():
            raise OverflowError(f"expected {self._name}, has elements beyond that: {array.tolist()!r:.80}")
        return copy

    def read(self, text: str) -> Any:
        words = text.split()
        values: list[Any]
        if self._dtype.kind == "b":
            values = [word == "true" for word in words]
        else:
            values = [*map(float if self._dtype.kind == "f" else int, words)]
        array = self._numpy.array(values, self._dtype).reshape(self._shape)
        array.flags.writeable = False  # what is changed there would be lost
        return array

    def text(self, value: Any) -> str:
        values = self.new(value).ravel().tolist()
        if self._dtype.kind == "b":
            return " ".join(["true" if value else "false" for value in values])
        return " ".join(map(repr, values))
