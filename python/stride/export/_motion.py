"""How a node of a glTF file moves: keyframes, and what is between them."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from typing import Any

from ._glb import Glb, NotShown
from ._times import PICOSECONDS

Value = tuple[float, ...]


class Track:
    """The values of one property in the course of time [ps], which is asked for in order."""

    def __init__(self, times: Sequence[int], values: Sequence[Value], interpolation: str = "LINEAR") -> None:
        if interpolation not in ("LINEAR", "STEP"):
            raise NotShown(f"it is interpolated by {interpolation}")
        if len(times) != len(values) or not times or list(times) != sorted(times):
            raise NotShown("keyframes are not in the order of time")
        self.times = times
        self._values = values
        self._is_step = interpolation == "STEP"

    @property
    def moves(self) -> bool:
        return any(value != self._values[0] for value in self._values)

    def has_keyframe(self, time: int) -> bool:
        after = bisect_right(self.times, time)
        return after > 0 and self.times[after - 1] == time

    def at(self, time: int) -> Value:
        after = bisect_right(self.times, time)
        if after == 0:
            return self._values[0]
        begin = self.times[after - 1]
        value = self._values[after - 1]
        if self._is_step or after == len(self.times) or begin == time:
            return value
        part = (time - begin) / (self.times[after] - begin)
        interpolate = _slerp if len(value) == 4 else _lerp
        return interpolate(value, self._values[after], part)


def _lerp(a: Value, b: Value, part: float) -> Value:
    return tuple(x + part * (y - x) for x, y in zip(a, b))


def _slerp(a: Value, b: Value, part: float) -> Value:
    cosine = sum(x * y for x, y in zip(a, b))
    if cosine < 0:
        b, cosine = tuple(-y for y in b), -cosine
    angle = math.acos(min(cosine, 1.0))
    if angle < 1e-9:
        return _lerp(a, b, part)
    first, second = math.sin((1 - part) * angle), math.sin(part * angle)
    mixed = [first * x + second * y for x, y in zip(a, b)]
    length = math.sqrt(sum(x * x for x in mixed))
    return tuple(x / length for x in mixed)


_STILL: dict[str, Value] = {"translation": (0.0, 0.0, 0.0), "rotation": (0.0, 0.0, 0.0, 1.0), "scale": (1.0, 1.0, 1.0)}


def tracks(glb: Glb, start: int) -> dict[tuple[int, str], Track]:
    """Those of all animations, by node and property. `start` [ps] is the time of their 0 s."""
    found = {}
    for animation in glb.document.get("animations", []):
        for channel in animation["channels"]:
            target = channel["target"]
            if "node" not in target or target["path"] not in _STILL:
                continue
            sampler = animation["samplers"][channel["sampler"]]
            times = [start + round(time * PICOSECONDS) for time in glb.floats(sampler["input"])[:, 0].tolist()]
            values = glb.floats(sampler["output"])
            if values.shape[1] != len(_STILL[target["path"]]):
                raise NotShown(f"a {target['path']} has {values.shape[1]} numbers")
            found[target["node"], target["path"]] = Track(
                times, [tuple(value) for value in values.tolist()], sampler.get("interpolation", "LINEAR")
            )
    return found


def still(node: dict[str, Any], path: str) -> Track:
    """Of a node that does not move."""
    if "matrix" in node:
        raise NotShown(f"node '{node.get('name', '')}' has a matrix")
    value = tuple(float(number) for number in node.get(path, _STILL[path]))
    if len(value) != len(_STILL[path]):
        raise NotShown(f"a {path} has {len(value)} numbers")
    return Track([0], [value])
