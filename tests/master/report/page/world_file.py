"""Binary glTF files with what the page expects of a world, made in Python."""

import json
import math
import struct

FLOAT, UINT16 = 5126, 5123
KINDS = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}
#: From z up, as in MuJoCo, to y up, as in glTF.
UPRIGHT = [-math.sqrt(0.5), 0, 0, math.sqrt(0.5)]


class WorldFile:
    """Nodes below one root; those that move do so in the animation `run`, whose time 0 is the start of the run."""

    def __init__(self, start_time="0"):
        self.binary = b""
        self.json = {"asset": {"version": "2.0"}, "scene": 0,
                     "scenes": [{"nodes": [0], "extras": {"stride": {"startTime": start_time}}}],
                     "nodes": [{"name": "world", "rotation": UPRIGHT, "children": []}],
                     "meshes": [], "materials": [], "cameras": [], "accessors": [], "bufferViews": [],
                     "animations": [{"name": "run", "channels": [], "samplers": []}]}
        self.material([0.5, 0.5, 0.5])

    def accessor(self, values, width, kind=FLOAT):
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": 0}
        data = struct.pack(f"<{len(values)}{'f' if kind == FLOAT else 'H'}", *values)
        view["byteLength"] = len(data)
        self.binary += data + b"\0" * (-len(data) % 4)
        self.json["bufferViews"].append(view)
        entry = {"bufferView": len(self.json["bufferViews"]) - 1, "componentType": kind, "type": KINDS[width],
                 "count": len(values) // width}
        if width == 3 or width == 1:
            columns = [values[i::width] for i in range(width)]
            entry.update(min=[min(column) for column in columns], max=[max(column) for column in columns])
        self.json["accessors"].append(entry)
        return len(self.json["accessors"]) - 1

    def node(self, name, parent=0, **properties):
        self.json["nodes"].append({"name": name, **properties})
        index = len(self.json["nodes"]) - 1
        self.json["nodes"][parent].setdefault("children", []).append(index)
        return index

    def material(self, color, emissive=None):
        entry = {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 0}, "doubleSided": True}
        if emissive:
            entry["emissiveFactor"] = emissive
        self.json["materials"].append(entry)
        return len(self.json["materials"]) - 1

    def box(self, half, material=0):
        """A mesh: a box around the origin; of a half size of 0 it is a plane."""
        points, normals, indices = [], [], []
        for axis in range(3):
            for sign in (1, -1):
                first = len(points) // 3
                for across, up in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                    corner = [0.0, 0.0, 0.0]
                    corner[axis], corner[(axis + 1) % 3], corner[(axis + 2) % 3] = sign, across * sign, up
                    points += [c * h for c, h in zip(corner, half)]
                    normals += [float(sign * (i == axis)) for i in range(3)]
                indices += [first + i for i in (0, 1, 2, 0, 2, 3)]
        self.json["meshes"].append({"primitives": [{
            "attributes": {"POSITION": self.accessor(points, 3), "NORMAL": self.accessor(normals, 3)},
            "indices": self.accessor(indices, 1, UINT16), "material": material}]})
        return len(self.json["meshes"]) - 1

    def camera(self, name, parent, fovy=0.8, **properties):
        self.json["cameras"].append({"type": "perspective", "perspective": {"yfov": fovy, "znear": 0.01}})
        return self.node(name, parent, camera=len(self.json["cameras"]) - 1, **properties)

    def animate(self, node, path, times, values, interpolation="LINEAR"):
        run = self.json["animations"][0]
        run["samplers"].append({"input": self.accessor(times, 1), "interpolation": interpolation,
                                "output": self.accessor([x for value in values for x in value], len(values[0]))})
        run["channels"].append({"sampler": len(run["samplers"]) - 1, "target": {"node": node, "path": path}})

    def switch(self, node, times, are_on):
        """Shows a node now and then, by its scale."""
        self.animate(node, "scale", times, [[float(on)] * 3 for on in are_on], "STEP")

    def bytes(self, **buffer):
        """The file; `buffer` has other properties of its only buffer, such as the place of it elsewhere."""
        parts = {name: entry for name, entry in self.json.items() if entry}
        if not parts["animations"][0]["channels"]:
            del parts["animations"]
        parts["buffers"] = [{"byteLength": len(self.binary), **buffer}]
        text = json.dumps(parts).encode()
        text += b" " * (-len(text) % 4)
        chunks = [struct.pack("<I4s", len(text), b"JSON"), text, struct.pack("<I4s", len(self.binary), b"BIN\0"),
                  self.binary]
        length = 12 + sum(len(chunk) for chunk in chunks)
        return struct.pack("<4sII", b"glTF", 2, length) + b"".join(chunks)


def looking_down(x, y, height):
    """Where a camera is that sees from above, with y up in its picture; a camera looks along its -z."""
    return {"translation": [x, y, height]}


def sample(start_time="0"):
    """
    A red block that slides along x by 0.1 m/s for 10 s on a grey floor, a lamp on it that shines from 4 s to 6 s, a
    contact from 2 s to 8 s, a site on the block, and two cameras: `film` from above, `side`.
    """
    world = WorldFile(start_time)
    red, dark = world.material([0.9, 0.05, 0.05]), world.material([0, 0.02, 0])
    lit = world.material([0, 0, 0], [0, 1, 0])
    world.node("floor", mesh=world.box([2, 2, 0]))
    block = world.node("block", translation=[-0.5, 0, 0.1])
    world.animate(block, "translation", [0, 10], [[-0.5, 0, 0.1], [0.5, 0, 0.1]])
    world.node("block_box", block, mesh=world.box([0.1, 0.1, 0.1], red))
    for name, material, on in (("led", dark, False), ("led", lit, True)):
        lamp = world.node(name, block, mesh=world.box([0.05, 0.05, 0.02], material), translation=[0, 0, 0.12],
                          extras={"stride": "lamp", "on": on})
        world.switch(lamp, [0, 4, 6], [not on, on, not on])
    world.node("tip", block, translation=[0, 0, 0.15], extras={"stride": "site"})
    contact = world.node("contact.0", extras={"stride": "contact"})
    world.switch(contact, [0, 2, 8], [False, True, False])
    world.animate(contact, "translation", [0, 10], [[-0.5, 0, 0], [0.5, 0, 0]])
    world.camera("film", 0, **looking_down(0, 0, 2))
    world.camera("side", 0, translation=[0, -2, 0.3], rotation=[math.sqrt(0.5), 0, 0, math.sqrt(0.5)])
    return world.bytes()
