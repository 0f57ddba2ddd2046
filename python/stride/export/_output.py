"""The MCAP file that is written."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any, Optional

from .._errors import InputError, RunError
from ._names import Topics
from ._packages import package
from ._schemas import Schema, known_schema
from ._times import nanoseconds, seconds


class Channel:
    """A topic, to which messages are written."""

    def __init__(self, output: Output, number: int, make: Any) -> None:
        self._output = output
        self._number = number
        self._count = 0
        self.make = make

    def write(self, time: int, data: bytes) -> None:
        """`time` is simulated [ps]."""
        self._output.add(self._number, self._count, time, data)
        self._count += 1


class Output:
    """Topics, schemas and messages, as they come. `begin` [ns] is the time in the file of the simulated 0 s."""

    def __init__(self, file: IO[bytes], begin: int) -> None:
        self._writer = package("mcap.writer").Writer(file)
        self._writer.start(profile="", library="stride")
        self._begin = begin
        self._schemas: dict[str, tuple[int, Any]] = {}
        self._names = Topics()
        self.topics: list[str] = []
        self.messages = 0
        self.last: Optional[int] = None

    def time(self, time: int) -> int:
        """[ns] of the file. Raises InputError if it has none."""
        found = self._begin + nanoseconds(time)
        if not 0 <= found < 2**64:
            raise InputError(
                f"an MCAP file has no time for {seconds(time)} s of this run",
                hint="give the first instant of the simulation a date, epoch=",
            )
        return found

    def channel(self, schema: Schema, topic: tuple[str, ...], **metadata: str) -> Channel:
        """`topic` is what it is and of what: ("signals", "sensor")."""
        if schema.name not in self._schemas:
            number = self._writer.register_schema(name=schema.name, encoding="protobuf", data=schema.data)
            self._schemas[schema.name] = number, schema.make
        number, make = self._schemas[schema.name]
        name = self._names.take(*topic)
        self.topics.append(name)
        return Channel(self, self._writer.register_channel(name, "protobuf", number, metadata), make)

    def known_channel(self, schema: str, topic: tuple[str, ...], **metadata: str) -> Channel:
        """With one of Foxglove's schemas."""
        return self.channel(known_schema(schema), topic, **metadata)

    def add(self, channel: int, sequence: int, time: int, data: bytes) -> None:
        at = self.time(time)
        self._writer.add_message(channel_id=channel, sequence=sequence % 2**32, log_time=at, publish_time=at, data=data)
        self.messages += 1
        self.last = time if self.last is None else max(self.last, time)

    def add_metadata(self, name: str, entries: dict[str, str]) -> None:
        self._writer.add_metadata(name, entries)

    def attach(self, time: int, name: str, media_type: str, data: bytes) -> None:
        at = self.time(time)
        self._writer.add_attachment(create_time=at, log_time=at, name=name, media_type=media_type, data=data)

    def finish(self) -> None:
        self._writer.finish()


@contextmanager
def new_file(file: Path) -> Iterator[IO[bytes]]:
    """To be written. What is there is replaced at the end, and stays where there is an error.

    A device or pipe is written to as it is.
    """
    if file.is_dir() or not file.absolute().parent.is_dir():
        what = "it is a folder" if file.is_dir() else f"there is no folder {file.absolute().parent}"
        raise InputError(f"cannot write {file}: {what}", file=str(file))
    in_place = file.exists() and not file.is_file()
    target = file if in_place else file.resolve().with_name(f"{file.resolve().name}.part")
    try:
        with target.open("wb") as stream:
            yield stream
        if not in_place:
            os.replace(target, file.resolve())
    except BaseException as error:
        if not in_place:
            target.unlink(missing_ok=True)
        if isinstance(error, OSError) and error.filename in (None, str(target)):
            raise RunError(f"cannot write {file}: {error.strerror or error}", file=str(file)) from error
        raise
