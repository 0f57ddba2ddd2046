"""The pictures of a film: units/COMPONENT/film/frames.csv and what it lists."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from pathlib import Path

from .._rows import rows
from ._files import is_regular, unit_folders
from ._output import Channel, Output
from ._signals import Event
from ._times import picoseconds, timestamp

_FORMATS = {".jpg": "jpeg", ".jpeg": "jpeg", ".png": "png", ".webp": "webp"}

_logger = logging.getLogger("stride")


def film_events(folder: Path, output: Output) -> list[Iterator[Event]]:
    """Of each component that has one."""
    found = []
    for component, below in unit_folders(folder):
        film = below / "film"
        if not film.is_symlink() and is_regular(film / "frames.csv"):
            channel = output.known_channel("CompressedImage", ("film", component), component=component)
            found.append(_pictures(film, channel, output))
    return found


def _pictures(film: Path, channel: Channel, output: Output) -> Iterator[Event]:
    listed = film / "frames.csv"
    for line, (time, name) in rows(listed, ["time", "file"]):
        picture = film / name
        kind = _FORMATS.get(picture.suffix.lower())
        try:
            at = picoseconds(time)
        except ValueError as error:
            _logger.warning("%s:%d: %s; the picture is left out", listed, line, error)
            continue
        if "/" in name or kind is None or not is_regular(picture):
            _logger.warning("%s:%d: there is no picture '%s'", listed, line, name)
            continue

        def write(at: int, picture: Path = picture, kind: str = kind) -> None:
            image = channel.make(data=picture.read_bytes(), format=kind)
            image.timestamp.CopyFrom(timestamp(type(image.timestamp), output.time(at)))
            channel.write(at, image.SerializeToString(deterministic=True))

        yield at, write
