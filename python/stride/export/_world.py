"""The world of units/COMPONENT/world.glb: its bodies, their geoms, and how they move."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from ._glb import Z_TO_Y_UP, Glb, NotShown
from ._motion import Track, still, tracks
from ._times import picoseconds, picoseconds_of

#: What a file that is damaged raises, among its parts.
DAMAGES = (ValueError, KeyError, IndexError, TypeError, AttributeError, RecursionError)


@dataclass
class Frame:
    """A body: where it is in its parent, and its geoms."""

    name: str
    parent: str
    translation: Track
    rotation: Track
    geoms: list[int] = field(default_factory=list)

    @property
    def moving(self) -> list[Track]:
        return [track for track in (self.translation, self.rotation) if track.moves]

    def at(self, time: int) -> tuple[float, ...]:
        return self.translation.at(time) + self.rotation.at(time)

    def has_keyframe(self, time: int) -> bool:
        return any(track.has_keyframe(time) for track in self.moving)


@dataclass
class Lamp:
    """Geoms of one name that are there at times: a dark one and one that shines."""

    name: str
    frame: str
    geoms: list[tuple[int, Track]] = field(default_factory=list)

    def shown(self, time: int) -> list[int]:
        return [geom for geom, scale in self.geoms if any(scale.at(time))]


class World:
    """What of a file is shown. Raises one of DAMAGES."""

    def __init__(self, data: bytes, prefix: str) -> None:
        self.glb = Glb(data)
        self._nodes = self.glb.document["nodes"]
        self._prefix = prefix
        self._taken: set[str] = set()
        self._visited: set[int] = set()
        scene = self.glb.document["scenes"][self.glb.document.get("scene", 0)]
        notes = {**self.glb.document["asset"].get("extras", {}), **scene.get("extras", {})}.get("stride", {})
        self.start = picoseconds(str(notes.get("startTime", 0)))
        self.interval = picoseconds_of(notes.get("interval", 0))
        self._tracks = tracks(self.glb, self.start)
        self.frames: list[Frame] = []
        self.lamps: dict[tuple[str, str], Lamp] = {}
        (root,) = scene["nodes"]
        turn = self._nodes[root].get("rotation", [0, 0, 0, 1])
        if not all(math.isclose(a, b, abs_tol=1e-6) for a, b in zip(turn, Z_TO_Y_UP)):
            raise NotShown("its root does not turn z-up to y-up")
        self.root = Frame(self._name(root), "", still({}, "translation"), still({}, "rotation"))
        self._visited.add(root)
        self._add_below(root, self.root)

    @property
    def with_geoms(self) -> list[Frame]:
        return [frame for frame in (self.root, *self.frames) if frame.geoms]

    @property
    def geoms_of_lamps(self) -> list[int]:
        return [geom for lamp in self.lamps.values() for geom, _ in lamp.geoms]

    def _name(self, node: int) -> str:
        name = self._nodes[node].get("name") or f"node {node}"
        candidate, count = name, 1
        while candidate in self._taken:
            count += 1
            candidate = f"{name} {count}"
        self._taken.add(candidate)
        return f"{self._prefix}{candidate}"

    def _add_below(self, parent: int, frame: Frame) -> None:
        waiting = [(child, frame) for child in reversed(self._nodes[parent].get("children", []))]
        while waiting:
            index, frame = waiting.pop()
            self._visit(index)
            node = self._nodes[index]
            if "mesh" in node:
                self._add_geom(index, node, frame)
            elif _is_body(node):
                body = Frame(
                    self._name(index), frame.name, self._track(index, "translation"), self._track(index, "rotation")
                )
                self.frames.append(body)
                waiting += [(child, body) for child in reversed(node.get("children", []))]

    def _add_geom(self, index: int, node: dict[str, Any], frame: Frame) -> None:
        scale = self._tracks.get((index, "scale"))
        if scale is None and node.get("extras", {}).get("stride") != "lamp":
            frame.geoms.append(index)
        else:
            name = node.get("name") or f"node {index}"
            lamp = self.lamps.setdefault((frame.name, name), Lamp(name, frame.name))
            lamp.geoms.append((index, scale or still(node, "scale")))
        self._visit_below(node)

    def _visit_below(self, node: dict[str, Any]) -> None:
        """What is below a geom belongs to it."""
        for child in node.get("children", []):
            self._visit(child)
            self._visit_below(self._nodes[child])

    def _visit(self, index: int) -> None:
        if index in self._visited:
            raise NotShown(f"node {index} has two parents")
        self._visited.add(index)

    def _track(self, node: int, path: str) -> Track:
        return self._tracks.get((node, path)) or still(self._nodes[node], path)


def _is_body(node: dict[str, Any]) -> bool:
    """And no camera, light, site or contact."""
    is_other = "camera" in node or "KHR_lights_punctual" in node.get("extensions", {})
    return not is_other and node.get("extras", {}).get("stride", "body") == "body"
