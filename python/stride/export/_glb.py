"""glTF 2.0 in its binary container: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html"""

from __future__ import annotations

import copy
import json
import struct
from collections.abc import Callable
from typing import Any

import numpy as np

_MAGIC = 0x46546C67
_JSON = 0x4E4F534A
_BINARY = 0x004E4942
_COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
_SIZES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
_FLOAT = 5126

# z-up, as in MuJoCo, to y-up, as in glTF
Z_TO_Y_UP = [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]


class NotShown(ValueError):
    """A file that is damaged, or other than it is shown here; the text says how."""


class Glb:
    """The document and the binary chunk of a file."""

    def __init__(self, data: bytes) -> None:
        if len(data) < 12:
            raise NotShown("it is too short")
        magic, version, length = struct.unpack_from("<III", data)
        if magic != _MAGIC or version != 2:
            raise NotShown("it is no binary glTF 2.0")
        if length != len(data):
            raise NotShown(f"it has {len(data)} bytes where its header says {length}")
        chunks: dict[int, memoryview] = {}
        at = 12
        while at + 8 <= length:
            size, kind = struct.unpack_from("<II", data, at)
            if at + 8 + size > length:
                raise NotShown("a chunk is cut off")
            chunks.setdefault(kind, memoryview(data)[at + 8 : at + 8 + size])
            at += 8 + size
        if _JSON not in chunks:
            raise NotShown("it has no chunk of JSON")
        self.document: dict[str, Any] = json.loads(bytes(chunks[_JSON]))
        if not isinstance(self.document, dict):
            raise NotShown("its JSON is no object")
        self.binary = chunks.get(_BINARY, memoryview(b""))
        for index, accessor in enumerate(self.document.get("accessors", [])):
            self._require_elements(index, accessor)

    def _require_elements(self, index: int, accessor: dict[str, Any]) -> None:
        if "bufferView" not in accessor or accessor["count"] == 0:
            return
        size = _COMPONENTS[accessor["type"]] * _SIZES[accessor["componentType"]]
        stride = self.document["bufferViews"][accessor["bufferView"]].get("byteStride", size)
        end = accessor.get("byteOffset", 0) + (accessor["count"] - 1) * stride + size
        if end > len(self.view(accessor["bufferView"])):
            raise NotShown(f"accessor {index} has more elements, {accessor['count']}, than its buffer view has room for")

    def view(self, index: int) -> memoryview:
        """The bytes of a buffer view."""
        view = self.document["bufferViews"][index]
        if view["buffer"] != 0:
            raise NotShown("it has a buffer in another file")
        begin, size = int(view.get("byteOffset", 0)), int(view["byteLength"])
        if begin < 0 or size < 0 or begin + size > len(self.binary):
            raise NotShown(f"buffer view {index} is beyond its end")
        return self.binary[begin : begin + size]

    def floats(self, index: int) -> np.ndarray:
        """An accessor of float, as float64; a row for each element."""
        accessor = self.document["accessors"][index]
        view = self.document["bufferViews"][accessor["bufferView"]]
        if accessor["componentType"] != _FLOAT or "sparse" in accessor or "byteStride" in view:
            raise NotShown(f"accessor {index} is not one of tightly packed floats")
        width, count = _COMPONENTS[accessor["type"]], accessor["count"]
        data = self.view(accessor["bufferView"])
        values = np.frombuffer(data, "<f4", count * width, accessor.get("byteOffset", 0)).reshape(count, width)
        if not np.isfinite(values).all():
            raise NotShown(f"accessor {index} has values that are no numbers")
        return values.astype(float)

    def part(self, nodes: list[int], *, with_scale: bool = True) -> bytes:
        """A file with some of its nodes, what is below them, and only what these need. It is turned to y-up."""
        return _Part(self).bytes(nodes, with_scale)


class _Part:
    """Copies what is referred to, once, with new numbers."""

    def __init__(self, source: Glb) -> None:
        self._source = source
        self._document: dict[str, Any] = {"asset": {"version": "2.0", "generator": "stride"}}
        self._binary = bytearray()
        self._copied: dict[tuple[str, int], int] = {}
        self._change: dict[str, Callable[[dict[str, Any]], None]] = {
            "meshes": self._mesh,
            "accessors": self._accessor,
            "materials": self._textures_below,
            "textures": self._texture,
            "images": self._image,
        }

    def bytes(self, nodes: list[int], with_scale: bool) -> bytes:
        root: dict[str, Any] = {"rotation": Z_TO_Y_UP}
        made = self._document["nodes"] = [root]
        self._document |= {"scene": 0, "scenes": [{"nodes": [0]}]}
        root["children"] = [self._node(node) for node in nodes]
        if not with_scale:
            for child in root["children"]:
                made[child].pop("scale", None)
        if extensions := sorted(_extensions(self._document)):
            self._document["extensionsUsed"] = extensions
        if self._binary:
            self._document["buffers"] = [{"byteLength": len(self._binary)}]
        text = json.dumps(self._document, sort_keys=True, separators=(",", ":")).encode()
        chunks = _chunk(_JSON, text, b" ") + (_chunk(_BINARY, bytes(self._binary), b"\0") if self._binary else b"")
        return struct.pack("<III", _MAGIC, 2, 12 + len(chunks)) + chunks

    def _node(self, index: int) -> int:
        node = self._source.document["nodes"][index]
        made = self._document["nodes"]
        new = {key: node[key] for key in ("name", "translation", "rotation", "scale", "matrix") if key in node}
        made.append(new)
        number = len(made) - 1
        if "mesh" in node:
            new["mesh"] = self._copy("meshes", node["mesh"])
        if children := [self._node(child) for child in node.get("children", [])]:
            new["children"] = children
        return number

    def _copy(self, kind: str, index: int) -> int:
        key = kind, index
        if key not in self._copied:
            item = copy.deepcopy(self._source.document[kind][index])
            if kind == "bufferViews":
                self._move(index, item)
            elif kind in self._change:
                self._change[kind](item)
            made = self._document.setdefault(kind, [])
            made.append(item)
            self._copied[key] = len(made) - 1
        return self._copied[key]

    def _refer(self, item: dict[str, Any], key: str, kind: str) -> None:
        if key in item:
            item[key] = self._copy(kind, item[key])

    def _mesh(self, mesh: dict[str, Any]) -> None:
        for primitive in mesh["primitives"]:
            for attributes in (primitive["attributes"], *primitive.get("targets", [])):
                for name in attributes:
                    self._refer(attributes, name, "accessors")
            self._refer(primitive, "indices", "accessors")
            self._refer(primitive, "material", "materials")

    def _accessor(self, accessor: dict[str, Any]) -> None:
        self._refer(accessor, "bufferView", "bufferViews")
        for part in accessor.get("sparse", {}).values():
            if isinstance(part, dict):
                self._refer(part, "bufferView", "bufferViews")

    def _textures_below(self, item: dict[str, Any]) -> None:
        """A material, and what is in it: "…Texture" has the index of a texture."""
        for key, below in item.items():
            if isinstance(below, dict):
                if key.endswith("Texture"):
                    self._refer(below, "index", "textures")
                self._textures_below(below)

    def _texture(self, texture: dict[str, Any]) -> None:
        self._refer(texture, "source", "images")
        self._refer(texture, "sampler", "samplers")

    def _image(self, image: dict[str, Any]) -> None:
        self._refer(image, "bufferView", "bufferViews")

    def _move(self, index: int, view: dict[str, Any]) -> None:
        self._binary += b"\0" * (-len(self._binary) % 4)
        view["byteOffset"] = len(self._binary)
        self._binary += self._source.view(index)


def _chunk(kind: int, data: bytes, padding: bytes) -> bytes:
    data += padding * (-len(data) % 4)
    return struct.pack("<II", len(data), kind) + data


def _extensions(item: Any) -> set[str]:
    """Of all that is in it."""
    if isinstance(item, list):
        return set().union(*map(_extensions, item))
    if not isinstance(item, dict):
        return set()
    own = set(item["extensions"]) if isinstance(item.get("extensions"), dict) else set()
    return own.union(*map(_extensions, item.values()))
