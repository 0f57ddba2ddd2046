"""The world as models in frames, and the frames as they move."""

from __future__ import annotations

import heapq
import logging
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ._files import is_regular, unit_folders
from ._glb import NotShown
from ._output import Channel, Output
from ._signals import Event
from ._times import timestamp
from ._world import DAMAGES, Frame, Lamp, World

_MOST_BYTES = 2**29

_logger = logging.getLogger("stride")


def world_events(folder: Path, output: Output) -> list[Iterator[Event]]:
    """Of each component that has one. A file that is damaged is left out with a warning."""
    files = [(component, below / "world.glb") for component, below in unit_folders(folder)]
    files = [(component, file) for component, file in files if is_regular(file)]
    found: list[Iterator[Event]] = []
    for component, file in files:
        try:
            if file.stat().st_size > _MOST_BYTES:
                raise NotShown(f"it has more than {_MOST_BYTES} bytes")
            world = World(file.read_bytes(), f"{component}/" if len(files) > 1 else "")
            models = {frame.name: world.glb.part(frame.geoms) for frame in world.with_geoms}
            parts = {geom: world.glb.part([geom], with_scale=False) for geom in world.geoms_of_lamps}
        except DAMAGES as error:
            reason = error if isinstance(error, NotShown) else f"it is damaged ({type(error).__name__}: {error})"
            _logger.warning("%s is left out: %s", file, reason)
            continue
        scene = _Scene(component, output)
        found.append(scene.show(world.start, models))
        found += [scene.switch(lamp, parts, world.start) for lamp in world.lamps.values()]
        transforms = output.known_channel("FrameTransforms", ("world", component, "transforms"), component=component)
        found.append(_transforms(world, transforms, output))
    return found


class _Scene:
    """Models in their frames."""

    def __init__(self, component: str, output: Output) -> None:
        self._component = component
        self._output = output
        self._channel = output.known_channel("SceneUpdate", ("world", component, "scene"), component=component)

    def show(self, start: int, models: dict[str, bytes]) -> Iterator[Event]:
        """All that does not come and go, by the names of its frames."""

        def write(at: int) -> None:
            update = self._channel.make()
            for frame, model in models.items():
                self._add(update, at, frame, frame, [model])
            self._channel.write(at, update.SerializeToString(deterministic=True))

        yield start, write

    def switch(self, lamp: Lamp, parts: dict[int, bytes], start: int) -> Iterator[Event]:
        """A topic of its own, so that the last message before an instant is what is there then."""
        channel = self._output.known_channel(
            "SceneUpdate", ("world", self._component, "lamps", lamp.name), component=self._component, lamp=lamp.name
        )

        def write(at: int) -> None:
            update = channel.make()
            self._add(update, at, lamp.frame, lamp.name, [parts[geom] for geom in lamp.shown(at)])
            channel.write(at, update.SerializeToString(deterministic=True))

        shown = None
        for time in sorted({start}.union(*(scale.times for _, scale in lamp.geoms))):
            if time >= start and (now := lamp.shown(time)) != shown:
                shown = now
                yield time, write

    def _add(self, update: Any, time: int, frame: str, name: str, models: list[bytes]) -> None:
        """It replaces what has had this name in this topic."""
        entity = update.entities.add(id=name, frame_id=frame, frame_locked=True)
        entity.timestamp.CopyFrom(timestamp(type(entity.timestamp), self._output.time(time)))
        for model in models:
            primitive = entity.models.add(media_type="model/gltf-binary", data=model)
            primitive.pose.orientation.w = 1
            primitive.scale.x = primitive.scale.y = primitive.scale.z = 1


def _transforms(world: World, channel: Channel, output: Output) -> Iterator[Event]:
    """All frames at the start, and then each one that moves, at its keyframes and the samples between them."""
    if not world.frames:
        return
    moving = [frame for frame in world.frames if frame.moving]
    last: dict[str, tuple[float, ...]] = {}

    def write(at: int) -> None:
        message = channel.make()
        for frame in moving if last else world.frames:
            pose = frame.at(at)
            if last.get(frame.name) == pose and not frame.has_keyframe(at):
                continue
            last[frame.name] = pose
            entry = message.transforms.add(parent_frame_id=frame.parent, child_frame_id=frame.name)
            entry.timestamp.CopyFrom(timestamp(type(entry.timestamp), output.time(at)))
            entry.translation.x, entry.translation.y, entry.translation.z = pose[:3]
            entry.rotation.x, entry.rotation.y, entry.rotation.z, entry.rotation.w = pose[3:]
        if message.transforms:
            channel.write(at, message.SerializeToString(deterministic=True))

    before = None
    for time in _instants(world, moving):
        if time != before:
            yield time, write
        before = time


def _instants(world: World, moving: list[Frame]) -> Iterator[int]:
    """The keyframes, and the multiples of the interval between them."""
    keyframes = sorted({time for frame in moving for track in frame.moving for time in track.times})
    yield world.start
    end = keyframes[-1] if keyframes else world.start
    samples = range(world.start, end, world.interval) if world.interval > 0 else range(0)
    yield from heapq.merge(keyframes, samples)
