"""Types of protobuf that are made here: the signals of a component, and messages."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any, Callable, Optional, Union

from ._names import Scope, identifier, parts
from ._packages import package

_BOOLEANS = {"true": True, "false": False, "1": True, "0": False}

_Convert = Callable[[str], Any]

# type of FMI: type of protobuf, its value from the text in signals.csv
_TYPES: dict[str, tuple[str, _Convert]] = {
    "Float64": ("DOUBLE", float),
    "Float32": ("FLOAT", float),
    **{f"Int{bits}": ("INT32", int) for bits in (8, 16, 32)},
    **{f"UInt{bits}": ("UINT32", int) for bits in (8, 16, 32)},
    "Int64": ("INT64", int),
    "UInt64": ("UINT64", int),
    "Enumeration": ("INT64", int),
    "Boolean": ("BOOL", _BOOLEANS.__getitem__),
    "String": ("STRING", str),
    "Binary": ("BYTES", bytes.fromhex),
}


@dataclass(frozen=True)
class Column:
    """Of signals.csv. `name` is that in its component."""

    index: int
    name: str
    type: str
    unit: str
    variability: str


@dataclass(frozen=True)
class _Field:
    """A scalar or an array, with its columns; `shape` is None for a scalar."""

    name: str
    columns: tuple[Column, ...]
    shape: Optional[tuple[int, ...]]

    @property
    def comment(self) -> str:
        column = self.columns[0]
        shape = "" if self.shape is None else f"; array of {' x '.join(map(str, self.shape))}, row by row"
        unit = f" [{column.unit}]" if column.unit else ""
        return f" {self.name}{unit}: {column.type}, {column.variability}{shape}\n"


_ELEMENT = re.compile(r"(?P<base>.+)\[(?P<indices>\d+(?:,\d+)*)\]", re.DOTALL)


def _fields(columns: Iterable[Column]) -> list[_Field]:
    """Columns that are all elements of an array, in their order, are one field."""
    groups: list[tuple[str, list[tuple[Column, tuple[int, ...]]]]] = []
    for column in columns:
        match = _ELEMENT.fullmatch(column.name)
        base = match["base"] if match else column.name
        indices = tuple(map(int, match["indices"].split(","))) if match else ()
        if match and groups and groups[-1][0] == base and _alike(groups[-1][1][0], (column, indices)):
            groups[-1][1].append((column, indices))
        else:
            groups.append((base, [(column, indices)]))
    fields = []
    for base, elements in groups:
        shape = _shape([indices for _, indices in elements])
        if shape:
            fields.append(_Field(base, tuple(column for column, _ in elements), shape))
        else:
            fields += [_Field(column.name, (column,), None) for column, _ in elements]
    return fields


def _alike(a: tuple[Column, tuple[int, ...]], b: tuple[Column, tuple[int, ...]]) -> bool:
    return (a[0].type, a[0].unit, len(a[1])) == (b[0].type, b[0].unit, len(b[1]))


def _shape(indices: list[tuple[int, ...]]) -> Optional[tuple[int, ...]]:
    """None where some elements are missing, as by `--signals`, and of a scalar."""
    shape = indices[-1]
    expected: list[tuple[int, ...]] = [()]
    for size in shape:
        expected = [(*before, i) for before in expected for i in range(1, size + 1)]
        if len(expected) > len(indices):
            return None
    return shape if shape and expected == indices else None


def _methods() -> list[str]:
    """Of messages in Python, which a field of that name would hide."""
    return [name for name in dir(package("google.protobuf.message").Message) if not name.startswith("_")]


@dataclass
class _Group:
    """The fields below a part of their names."""

    scope: Scope = field(default_factory=lambda: Scope(_methods()))
    members: dict[str, Union[_Group, _Field]] = field(default_factory=dict)
    groups: dict[str, str] = field(default_factory=dict)

    def below(self, part: str) -> _Group:
        if part not in self.groups:
            self.groups[part] = self.scope.take(identifier(part))
            self.members[self.groups[part]] = _Group()
        group = self.members[self.groups[part]]
        assert isinstance(group, _Group)
        return group

    def add(self, item: _Field) -> None:
        *outer, last = parts(item.name)
        group = self
        for part in outer:
            group = group.below(part)
        group.members[group.scope.take(identifier(last))] = item


class _FileBuilder:
    """A file with one message, which has a comment for each field."""

    def __init__(self, space: str, name: str) -> None:
        pb2 = package("google.protobuf.descriptor_pb2")
        file = f"{space.replace('.', '/')}/{name}.proto"
        self.file = pb2.FileDescriptorProto(name=file, package=space, syntax="proto3")
        self.message = self.file.message_type.add(name=name)

    def comment(self, path: list[int], text: str) -> None:
        self.file.source_code_info.location.add(path=path, span=[0, 0, 0], leading_comments=text)

    def add_group(self, message: Any, scope: str, path: list[int], group: _Group) -> None:
        """`scope` is the full name of the message, `path` where it is in the file."""
        for number, (name, member) in enumerate(group.members.items()):
            entry = message.field.add(name=name, number=_number(number), label=_label(member))
            if isinstance(member, _Field):
                entry.type = getattr(type(entry), f"TYPE_{_TYPES[member.columns[0].type][0]}")
                self.comment([*path, 2, number], member.comment)
            else:
                # no name of a field, since those differ in more than case
                inner = name[0].upper() + name[1:] if name[0].islower() else f"{name}_"
                entry.type = type(entry).TYPE_MESSAGE
                entry.type_name = f"{scope}.{inner}"
                nested = message.nested_type.add(name=inner)
                self.add_group(nested, entry.type_name, [*path, 3, len(message.nested_type) - 1], member)


def _label(member: Union[_Group, _Field]) -> int:
    """Of protobuf: 1 optional, 3 repeated."""
    return 3 if isinstance(member, _Field) and member.shape is not None else 1


def _number(position: int) -> int:
    """Those from 19000 to 19999 are protobuf's own."""
    number = position + 1
    return number if number < 19000 else number + 1000


@dataclass(frozen=True)
class Schema:
    """A type: its name, its class, and what an MCAP file says of it."""

    name: str
    make: Any
    data: bytes


def _schema(file: Any) -> Schema:
    pool = package("google.protobuf.descriptor_pool").DescriptorPool()
    pool.Add(file)
    name = f"{file.package}.{file.message_type[0].name}"
    make = package("google.protobuf.message_factory").GetMessageClass(pool.FindMessageTypeByName(name))
    files = package("google.protobuf.descriptor_pb2").FileDescriptorSet(file=[file])
    return Schema(name, make, files.SerializeToString(deterministic=True))


def known_schema(name: str) -> Schema:
    """One of Foxglove's: "Log"."""
    make = getattr(package(f"foxglove_schemas_protobuf.{name}_pb2"), name)
    files = package("mcap_protobuf.schema").build_file_descriptor_set(make)
    return Schema(f"foxglove.{name}", make, files.SerializeToString(deterministic=True))


def message_schema() -> Schema:
    """Of what events.csv has of a message."""
    builder = _FileBuilder("stride", "Message")
    fields = {
        "direction": ("STRING", "sent or received"),
        "index": ("UINT32", "the event iteration at this instant"),
        "payload": ("STRING", "as in events.csv: Binary in hexadecimal digits"),
        "number": ("DOUBLE", "the payload, where it is one number or Boolean; else NaN"),
        "data": ("BYTES", "the bytes of a Binary payload whose content is known"),
        "content": ("STRING", "the meaning of a Binary payload"),
    }
    for number, (name, (kind, comment)) in enumerate(fields.items()):
        entry = builder.message.field.add(name=name, number=number + 1, label=1)
        entry.type = getattr(type(entry), f"TYPE_{kind}")
        builder.comment([4, 0, 2, number], f" {comment}\n")
    return _schema(builder.file)


class ComponentSignals:
    """Makes a message of each row, from the columns of one component."""

    def __init__(self, schema_name: str, columns: list[Column]) -> None:
        tree = _Group()
        for item in _fields(columns):
            tree.add(item)
        builder = _FileBuilder("stride.signals", schema_name)
        builder.add_group(builder.message, f".stride.signals.{schema_name}", [4, 0], tree)
        self.schema = _schema(builder.file)
        self.units = {column.name: column.unit for column in columns if column.unit}
        self._message = self.schema.make()
        self._scalars: list[tuple[Any, str, int, _Convert]] = []
        self._arrays: list[tuple[Any, list[int], _Convert]] = []
        self._plan(self._message, tree)

    def _plan(self, message: Any, group: _Group) -> None:
        for name, member in group.members.items():
            if isinstance(member, _Group):
                self._plan(getattr(message, name), member)
                continue
            indices = [column.index for column in member.columns]
            convert = _TYPES[member.columns[0].type][1]
            if member.shape is None:
                self._scalars.append((message, name, indices[0], convert))
            else:
                self._arrays.append((getattr(message, name), indices, convert))

    def encode(self, row: list[str]) -> bytes:
        """Raises ValueError or KeyError for a text that is no value of its type."""
        for message, name, index, convert in self._scalars:
            setattr(message, name, convert(row[index]))
        for array, indices, convert in self._arrays:
            array[:] = [convert(row[index]) for index in indices]
        encoded: bytes = self._message.SerializeToString(deterministic=True)
        return encoded
