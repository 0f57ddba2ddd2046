"""table_to_csv.py FILE CSV: what is in a Parquet or MCAP file, as a table of CSV (docs/stimuli.md).

stride runs it in a process of its own. Exit code 3: what it printed says what is wrong with the file.
"""

from __future__ import annotations

import importlib
import json
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Callable, Optional, TextIO, Union

_WRONG_FILE = 3
_TIME = re.compile(r"[tT]ime(?: \[\w+\])?")


class _Mistake(Exception):
    """`hint` says what would mend it."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message + (f"\n  hint: {hint}" if hint else ""))


def _module(name: str, install: str, what: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise _Mistake(
            f"{what} is read by the Python module '{name.partition('.')[0]}', which {sys.executable or 'python3'} does "
            f"not have ({error})",
            f"{install}; STRIDE_PYTHON=PROGRAM chooses another Python",
        ) from error


def _quoted(text: str) -> str:
    doubled = text.replace('"', '""')
    return f'"{doubled}"'


def _bytes(value: bytes) -> str:
    """In quotation marks, since there may be none of them."""
    return _quoted(value.hex())


def _truth(value: bool) -> str:
    return "true" if value else "false"


def _heading(name: str, unit: str, words: str) -> str:
    return _quoted(f"{name} [{unit}]: {words}" if unit else f"{name}: {words}")


# ---- Parquet ----

_Text = Callable[[Any], str]


def _split_heading(name: str) -> tuple[str, str]:
    """The text before the colon of "speed [km/h]: hold", if one stands outside of single quotes, and behind it."""
    for match in re.finditer(":", name):
        if name.count("'", 0, match.start()) % 2 == 0:
            return name[: match.start()].strip(), name[match.end() :].strip()
    return name.strip(), ""


def _type_of(kind: Any, types: Any) -> Optional[tuple[str, _Text]]:
    """The type of FMI for one of Arrow, and how a value of it is written."""
    if types.is_dictionary(kind):
        return _type_of(kind.value_type, types)
    if types.is_boolean(kind):
        return "Boolean", _truth
    if types.is_integer(kind):
        return f"{'Int' if types.is_signed_integer(kind) else 'UInt'}{kind.bit_width}", str
    if types.is_float32(kind) or types.is_float16(kind):
        return "Float32", repr
    if types.is_float64(kind):
        return "Float64", repr
    if types.is_decimal(kind):
        return "Float64", str
    if types.is_string(kind) or types.is_large_string(kind):
        return "String", _quoted
    if types.is_binary(kind) or types.is_large_binary(kind) or types.is_fixed_size_binary(kind):
        return "Binary", _bytes
    return None


def _agreed_unit(field: Any) -> tuple[str, bool]:
    """The unit of measure of a column, and whether its heading has it."""
    name = _split_heading(field.name)[0]
    own = re.search(r" \[([^\[\]]*)\]$", name)
    unit = (field.metadata or {}).get(b"unit", b"").decode()
    if own and unit and own[1].strip() != unit.strip():
        raise _Mistake(
            f"column '{field.name}' is in '{own[1]}' by its heading, and in '{unit}' by the metadata of its field",
            "keep the one that is right, in the heading or in the metadata",
        )
    return (own[1] if own else unit), own is not None


def _float_of(name: str) -> _Text:
    """How a whole number is written in a column of Float64, which must have it."""

    def text(value: int) -> str:
        if value != int(float(value)):
            raise _Mistake(
                f"column '{name}': {value} has more digits than a Float64, and only floating-point numbers have a unit "
                "of measure",
                "leave the unit of measure out, or convert the column to float64 if it may be rounded",
            )
        return repr(value)

    return text


def _column(field: Any, types: Any) -> tuple[str, _Text]:
    name, words = _split_heading(field.name)
    found = _type_of(field.type, types)
    if found is None:
        raise _Mistake(
            f"column '{field.name}': values of the type {field.type} cannot be played",
            "expected numbers, Booleans, texts or bytes: convert the column, or leave it out",
        )
    kind, text = found
    unit, has_own = _agreed_unit(field)
    if (unit or has_own) and types.is_integer(field.type):
        kind, text = "Float64", _float_of(name)  # which alone has a unit of measure in FMI
    courses = [word for word in words.split() if word in ("linear", "hold", "event")]
    if words and words.split() not in ([kind, *courses], [*courses, kind], courses):
        kind = ""  # what else stands there is for the reader of the table to judge
        courses = words.split()
    return _heading(name, "" if has_own else unit, " ".join([kind, *courses]).strip()), text


def _time_column(schema: Any, types: Any) -> tuple[int, str, _Text]:
    """Where it is, its heading, and how a value of it is written. pandas has an index as the last column."""
    places = [i for i, name in enumerate(schema.names) if _TIME.fullmatch(name.strip())]
    if not places:
        names = ", ".join(schema.names[:20])
        raise _Mistake(
            f"there is no column 'time', in seconds, or 'time [UNIT]'; there are: {names}",
            "rename the column of the times, with pandas by rename(columns={'t': 'time'})",
        )
    field = schema.field(places[0])
    if types.is_duration(field.type):
        power = {"s": 0, "ms": 3, "us": 6, "ns": 9}[field.type.unit]
        return places[0], "time", lambda count: f"{count}e-{power}"
    if types.is_integer(field.type) or types.is_floating(field.type) or types.is_decimal(field.type):
        unit, has_own = _agreed_unit(field)
        heading = f"time [{unit}]" if unit and not has_own else field.name
        return places[0], heading, str if types.is_decimal(field.type) else repr
    raise _Mistake(
        f"column '{field.name}' has values of the type {field.type}; expected numbers or durations",
        "subtract the date at which the run begins: a difference of dates is a duration",
    )


def _values(array: Any, types: Any) -> list[Any]:
    if types.is_duration(array.type):
        array = array.cast("int64")
    values: list[Any] = array.to_pylist()
    return values


def _write_parquet(file: Path, output: TextIO) -> None:
    install = "pip install pyarrow"
    arrow = _module("pyarrow", install, "a Parquet file")
    parquet = _module("pyarrow.parquet", install, "a Parquet file")
    types = arrow.types
    try:
        table = parquet.ParquetFile(file)
        schema = table.schema_arrow
    except (arrow.ArrowException, OSError, ValueError) as error:
        raise _Mistake(f"this is not a Parquet file: {error}") from error
    place, heading, time_text = _time_column(schema, types)
    order = [place, *(i for i in range(len(schema)) if i != place)]
    columns = [_column(schema.field(i), types) for i in order[1:]]
    print(",".join([_quoted(heading), *(heading for heading, _ in columns)]), file=output)
    texts = [time_text, *(text for _, text in columns)]
    try:
        for batch in table.iter_batches():
            values = [_values(batch.column(i), types) for i in order]
            for row in zip(*values):
                fields = ("" if value is None else text(value) for text, value in zip(texts, row))
                print(",".join(fields), file=output)
    except (arrow.ArrowException, OSError) as error:
        raise _Mistake(f"the Parquet file is damaged: {error}") from error


# ---- MCAP ----

# what the exporter says of a field, see python/stride/export/_schemas.py
_COMMENT = re.compile(
    r" (?P<name>.+?)(?: \[(?P<unit>[^\[\]]*)\])?: (?P<type>\w+), (?P<variability>\w+)"
    r"(?:; array of (?P<shape>\d+(?: x \d+)*), row by row)?\n",
    re.DOTALL,
)
_TEXTS: dict[str, _Text] = {"Boolean": _truth, "String": _quoted, "Binary": _bytes}


class _Field:
    """One of a message, with as many columns as it has elements."""

    def __init__(self, path: list[str], comment: Any, component: str) -> None:
        self._path = path
        kind = {"Enumeration": "Int64"}.get(comment["type"], comment["type"])
        self._text = _TEXTS.get(kind, repr)
        self._is_array = comment["shape"] is not None
        held = kind.startswith("Float") and comment["variability"] != "continuous"
        if comment["unit"] and not kind.startswith("Float"):
            kind, held = "Float64", True
            self._text = _float_of(f"{component}.{comment['name']}")
        name = f"{component}.{comment['name']}"
        indices = _indices([int(size) for size in comment["shape"].split(" x ")]) if self._is_array else [""]
        self.headings = [
            _heading(name + index, comment["unit"] or "", kind + (" hold" if held else "")) for index in indices
        ]

    def texts(self, message: Any) -> list[str]:
        for part in self._path:
            message = getattr(message, part)
        if not self._is_array:
            return [self._text(message)]
        found = [self._text(element) for element in message]
        if len(found) != len(self.headings):
            raise _Mistake(f"a message has {len(found)} elements of {self.headings[0]}, not {len(self.headings)}")
        return found


def _indices(shape: list[int]) -> list[str]:
    """"[1,1]", "[1,2]", …, row by row."""
    found: list[list[int]] = [[]]
    for size in shape:
        found = [[*before, i] for before in found for i in range(1, size + 1)]
    return [f"[{','.join(map(str, index))}]" for index in found]


def _fields(file: Any, component: str) -> Iterator[_Field]:
    comments = {tuple(place.path): place.leading_comments for place in file.source_code_info.location}

    def below(message: Any, path: tuple[int, ...], names: list[str]) -> Iterator[_Field]:
        for i, field in enumerate(message.field):
            here = [*names, field.name]
            if field.type == field.TYPE_MESSAGE:
                inner = field.type_name.rpartition(".")[2]
                place = next(k for k, nested in enumerate(message.nested_type) if nested.name == inner)
                yield from below(message.nested_type[place], (*path, 3, place), here)
                continue
            comment = _COMMENT.fullmatch(comments.get((*path, 2, i), ""))
            if comment is None:
                raise _Mistake(f"the field '{'.'.join(here)}' of '{component}' has no description by stride")
            yield _Field(here, comment, component)

    return below(file.message_type[0], (4, 0), [])


class _Channel:
    """The signals of a component."""

    def __init__(self, schema: Any, component: str, first: int) -> None:
        pb2 = _module("google.protobuf.descriptor_pb2", _INSTALL_MCAP, "an MCAP file")
        pools = _module("google.protobuf.descriptor_pool", _INSTALL_MCAP, "an MCAP file")
        classes = _module("google.protobuf.message_factory", _INSTALL_MCAP, "an MCAP file")
        file = pb2.FileDescriptorSet.FromString(schema.data).file[0]
        pool = pools.DescriptorPool()
        pool.Add(file)
        self._make = classes.GetMessageClass(pool.FindMessageTypeByName(schema.name))
        self._fields = list(_fields(file, component))
        self.headings = [heading for field in self._fields for heading in field.headings]
        self.first = first  # of its columns
        self.row = 0  # at the present time

    def texts(self, data: bytes) -> list[str]:
        message = self._make.FromString(data)
        return [text for field in self._fields for text in field.texts(message)]


_INSTALL_MCAP = "pip install mcap protobuf zstandard"


def _first_time(reader: Any) -> int:
    """The time in the file [ns] of the simulated 0 s, which `--epoch` has set."""
    for attachment in reader.iter_attachments():
        if attachment.name == "run.json":
            start = json.loads(attachment.data).get("start", 0)
            return int(attachment.log_time) - round(float(start) * 1e9)
    return 0


def _seconds(nanoseconds: int) -> str:
    sign, count = ("-", -nanoseconds) if nanoseconds < 0 else ("", nanoseconds)
    return f"{sign}{count // 10**9}.{count % 10**9:09}"


def _channels(summary: Any) -> dict[int, _Channel]:
    found: dict[int, _Channel] = {}
    columns = 0
    for number, channel in sorted(summary.channels.items()):
        schema = summary.schemas.get(channel.schema_id)
        if schema is None or schema.encoding != "protobuf" or not schema.name.startswith("stride.signals."):
            continue
        component = channel.metadata.get("component", schema.name.rpartition(".")[2])
        found[number] = _Channel(schema, component, columns)
        columns += len(found[number].headings)
    if not found:
        topics = ", ".join(sorted(channel.topic for channel in summary.channels.values())[:20]) or "none"
        raise _Mistake(
            "there are no signals of stride in it: no topic has a schema stride.signals.COMPONENT, as those of 'stride "
            f"export' have; its topics: {topics}",
            "convert it to CSV or Parquet",
        )
    return found


def _write_mcap(file: Path, output: TextIO) -> None:
    mcap = _module("mcap.reader", _INSTALL_MCAP, "an MCAP file")
    errors = _module("mcap.exceptions", _INSTALL_MCAP, "an MCAP file")
    with file.open("rb") as stream:
        try:
            reader = mcap.make_reader(stream)
            summary = reader.get_summary()
        except (errors.McapError, OSError, ValueError) as error:
            raise _Mistake(f"this is not an MCAP file, or it is damaged: {error!r}") from error
        if summary is None:
            raise _Mistake("the MCAP file has no summary, so it is incomplete", "export the run again")
        channels = _channels(summary)
        headings = [heading for channel in channels.values() for heading in channel.headings]
        print(",".join(["time", *headings]), file=output)
        try:
            _write_messages(reader, channels, len(headings), output)
        except (errors.McapError, OSError, ValueError) as error:
            raise _Mistake(f"the MCAP file is damaged: {error!r}") from error


def _write_messages(reader: Any, channels: dict[int, _Channel], width: int, output: TextIO) -> None:
    """The messages of one time that are the first of their channels are one row, then the second ones."""
    begin = _first_time(reader)
    time: Union[int, None] = None
    rows: list[list[str]] = []

    def flush() -> None:
        for row in rows:
            print(",".join([_seconds(time - begin), *row]), file=output)  # type: ignore[operator]

    topics = [reader.get_summary().channels[number].topic for number in channels]
    for _, record, message in reader.iter_messages(topics=topics):
        if message.log_time != time:
            flush()
            time, rows = message.log_time, []
            for channel in channels.values():
                channel.row = 0
        channel = channels[record.id]
        if channel.row == len(rows):
            rows.append([""] * width)
        rows[channel.row][channel.first : channel.first + len(channel.headings)] = channel.texts(message.data)
        channel.row += 1
    flush()


def main(file: Path, csv: Path) -> int:
    write = _write_parquet if file.suffix.lower() == ".parquet" else _write_mcap
    try:
        with csv.open("w", encoding="utf-8", newline="\n") as output:
            write(file, output)
    except _Mistake as mistake:
        print(mistake)
        return _WRONG_FILE
    except Exception as error:  # of the packages that read it, for content that they do not expect
        is_parquet = write is _write_parquet
        kind = "a Parquet file that can be read" if is_parquet else "an MCAP file that 'stride export' wrote"
        print(f"this is not {kind}: {type(error).__name__}: {error}\n  hint: convert it to CSV")
        return _WRONG_FILE
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
