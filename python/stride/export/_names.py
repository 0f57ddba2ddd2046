"""Names of stride as those of topics and of protobuf's fields, which allow fewer characters."""

from __future__ import annotations

import re
from collections.abc import Iterable

# the parts of a structured name: dots in 'quotes', (parentheses) and [brackets] separate nothing
_PARTS = re.compile(r"(?:'(?:\\.|[^'\\])*'|\([^()]*\)|\[[^\[\]]*\]|[^.'()\[\]])+")


def parts(name: str) -> list[str]:
    """Of "sensor.capacitor.voltage", those between the dots."""
    found = _PARTS.findall(name)
    return found if ".".join(found) == name else name.split(".")


def identifier(text: str) -> str:
    """Letters, digits and _, the first one no digit."""
    if re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", text):
        return text
    found = re.sub(r"[^A-Za-z0-9]+", "_", text).strip("_") or "_"
    return f"_{found}" if found[0].isdigit() else found


class Scope:
    """Gives each name once: "x", and then "x_2".

    Names that differ in case and underscores only are the same, since they are in protobuf's JSON.
    """

    def __init__(self, reserved: Iterable[str] = ()) -> None:
        self._taken = set(map(_key, reserved))

    def take(self, name: str) -> str:
        candidate, count = name, 1
        while (key := _key(candidate)) in self._taken:
            count += 1
            candidate = f"{name}_{count}"
        self._taken.add(key)
        return candidate


def _key(name: str) -> str:
    return name.replace("_", "").lower()


class Topics:
    """Gives each topic once: "/signals/sensor", from what it is and of what."""

    def __init__(self) -> None:
        self._scope = Scope()

    def take(self, kind: str, *names: str) -> str:
        words = [re.sub(r"[^A-Za-z0-9_-]+", "_", part) for name in names for part in parts(name) if part]
        return self._scope.take("/" + "/".join([kind, *words]))
