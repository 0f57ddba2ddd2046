"""Keyword arguments as the options of `stride run`."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import Any, Optional, Union

from ._errors import InputError

PathLike = Union[str, os.PathLike[str]]

_BYTES = (bytes, bytearray, memoryview)

Setting = tuple[str, Optional[str]]


def word_of(value: Any, what: str) -> str:
    """Of a text or a path. Raises InputError for what cannot be a word of a command line."""
    text = os.fspath(value) if isinstance(value, (str, os.PathLike)) else value
    if not isinstance(text, str):
        raise InputError(f"{what} is a text or a path, not {value!r:.80}")
    if "\0" in text:
        raise InputError(f"{what}: a text has no NUL: {text!r:.80}")
    return text


def path_of(value: Any, what: str) -> str:
    """Of a file or folder. Raises InputError likewise, and for an empty name, which would be the working folder."""
    text = word_of(value, what)
    if not text:
        raise InputError(f"{what}: an empty name is that of no file and no folder", hint="'.' is the working folder")
    return text


def file_word(value: Any, what: str) -> str:
    """Of a path, which may begin as an option does."""
    word = path_of(value, what)
    return f"./{word}" if word.startswith("-") else word


def refuse_keyword(options: Mapping[str, Any], keyword: str, instead: str) -> None:
    """Raises InputError for what another call has under this name."""
    if keyword in options:
        raise InputError(f"there is no '{keyword}' here", hint=f"the folder of the results is {instead}=")


def _text(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if value is None:
        raise InputError("None is no value of a variable")
    if isinstance(value, _BYTES):
        return bytes(value).hex()
    if isinstance(value, (str, os.PathLike)):
        return word_of(value, "a value")
    if isinstance(value, Iterable) and getattr(value, "ndim", 1) > 0:
        texts = [_text(element) for element in value]
        if "" in texts or any(isinstance(element, str) and " " in element for element in value):
            raise InputError(
                "the elements of an array are separated by blanks, so a text with blanks, or without a"
                " character, cannot be among them: set them in a Simulation"
            )
        return " ".join(texts)
    if isinstance(value, float):
        return repr(float(value))  # that of numpy has another text
    item = getattr(value, "item", None)  # a number of numpy
    return _text(item()) if item is not None else str(value)


def _text_of_no_bytes(value: Any) -> str:
    """Of what is no value of a variable, such as the name of a file."""
    return word_of(value, "an option") if isinstance(value, _BYTES) else _text(value)


def settings(options: Mapping[str, Any]) -> list[Setting]:
    """Name and value of each option: `max_skip=1` is ("max-skip", "1"), `isolate=True` is ("isolate", None).

    A mapping is repeated for each of its items, `set={"a.x": 1}` as ("set", "a.x=1"), other iterables for each
    element. What is None or False is left out.
    """
    found: list[Setting] = []
    for keyword, value in options.items():
        name = word_of(keyword, "an option").rstrip("_").replace("_", "-")
        if name in ("help", "h", "version", "progress", "json"):
            raise InputError(f"'{keyword}' is an option for a command line, and none of a call from Python")
        if value is None or value is False:
            continue
        if value is True:
            found.append((name, None))
        elif isinstance(value, Mapping):
            text = _text if name == "set" else _text_of_no_bytes
            found.extend((name, f"{word_of(key, 'a name')}={text(item)}") for key, item in value.items())
        elif isinstance(value, (str, os.PathLike, *_BYTES)) or not isinstance(value, Iterable):
            found.append((name, _text_of_no_bytes(value)))
        else:
            found.extend((name, _text_of_no_bytes(item)) for item in value)
    return found


def words(options: Mapping[str, Any]) -> list[str]:
    """As words of a command line."""
    return [f"--{name}" if value is None else f"--{name}={value}" for name, value in settings(options)]
