"""The world of stride.export_mcap: a world.glb that is made here, as models and transforms."""

import json
import math
import struct

import numpy as np
import pytest
import stride
from mcap_test import Content

TURN = [-math.sqrt(0.5), 0, 0, math.sqrt(0.5)]
PICTURE = b"\x89PNG a picture"
TRIANGLE = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4")


def container(document, binary):
    text = json.dumps(document).encode()
    chunks = b""
    for kind, data, padding in ((0x4E4F534A, text, b" "), (0x004E4942, bytes(binary), b"\0")):
        data += padding * (-len(data) % 4)
        chunks += struct.pack("<II", len(data), kind) + data
    return struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks


class World:
    """A file as mujoco_world writes it: bodies, geoms, lamps, what is not shown, and an animation."""

    def __init__(self, nodes, start="0", interval=0.25):
        self.binary = bytearray()
        self.document = {
            "asset": {"version": "2.0", "extras": {"stride": {"startTime": start, "interval": interval}}},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": nodes,
            "bufferViews": [],
            "accessors": [],
            "images": [{"mimeType": "image/png", "bufferView": 0}],
            "textures": [{"source": 0}],
            "materials": [
                {"name": "red"},
                {"name": "painted", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
                {"name": "lit", "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2}}},
            ],
            "meshes": [],
            "animations": [{"name": "run", "samplers": [], "channels": []}],
        }
        self.view(PICTURE)
        for size, material in ((1, 0), (2, 1), (3, 2)):
            attributes = {"POSITION": self.accessor(TRIANGLE * size)}
            self.document["meshes"].append({"primitives": [{"attributes": attributes, "material": material}]})

    def view(self, data):
        self.document["bufferViews"].append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        self.binary += data + b"\0" * (-len(data) % 4)
        return len(self.document["bufferViews"]) - 1

    def accessor(self, values):
        values = np.asarray(values, "<f4")
        kind = "SCALAR" if values.ndim == 1 else f"VEC{values.shape[1]}"
        accessor = {
            "bufferView": self.view(values.tobytes()),
            "componentType": 5126,
            "count": len(values),
            "type": kind,
        }
        self.document["accessors"].append(accessor)
        return len(self.document["accessors"]) - 1

    def animate(self, node, path, times, values, interpolation="LINEAR"):
        animation = self.document["animations"][0]
        sampler = {"input": self.accessor(times), "output": self.accessor(values), "interpolation": interpolation}
        animation["samplers"].append(sampler)
        target = {"node": node, "path": path}
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1, "target": target})

    def bytes(self):
        self.document["buffers"] = [{"byteLength": len(self.binary)}]
        return container(self.document, self.binary)


def kind(name):
    return {"extras": {"stride": name}}


def turned(angle):
    """About z."""
    return [0, 0, math.sin(angle / 2), math.cos(angle / 2)]


def arm_world(**options):
    """An arm that turns by 2 rad in the first second, and a slide on it that moves in the second one."""
    world = World(
        [
            {"name": "world", "rotation": TURN, "children": [1, 2, 9, 10], **kind("body")},
            {"name": "floor", "mesh": 0, **kind("geom")},
            {"name": "arm", "translation": [0, 0, 1], "children": [3, 4, 8, 7], **kind("body")},
            {"name": "link", "mesh": 1, "translation": [0.5, 0, 0], "scale": [1, 2, 3], **kind("geom")},
            {"name": "slide", "children": [5, 6], **kind("body")},
            {"name": "led", "mesh": 0, "scale": [1, 1, 1], "extras": {"stride": "lamp", "on": False}},
            {"name": "led", "mesh": 2, "scale": [0, 0, 0], "children": [11], "extras": {"stride": "lamp", "on": True}},
            {"name": "tip", **kind("site")},
            {"name": "eye", "camera": 0, **kind("camera")},
            {"name": "sun", "extensions": {"KHR_lights_punctual": {"light": 0}}, **kind("light")},
            {"name": "contact.0", **kind("contact")},
            {"mesh": 0},
        ],
        **options,
    )
    world.animate(0, "translation", [0, 2], [[0, 0, 0]] * 2)
    world.animate(2, "rotation", [0, 1], [turned(0), turned(2)])
    world.animate(4, "translation", [0, 1, 2], [[0, 0, 0], [0, 0, 0], [4, 0, 0]])
    world.animate(5, "scale", [0, 0.6, 1.5], [[1] * 3, [0] * 3, [1] * 3], "STEP")
    world.animate(6, "scale", [0, 0.6, 1.5], [[0] * 3, [1] * 3, [0] * 3], "STEP")
    return world


@pytest.fixture
def run(folder):
    return stride.run("test.ssd", set={"first.u": 1}, stop=2, out="out")


def put(run, component, data):
    below = run.folder / "units" / component
    below.mkdir(parents=True)
    (below / "world.glb").write_bytes(data)


def export(run):
    return Content(run.to_mcap("run.mcap").file)


def document_of(model):
    """JSON, and the binary chunk."""
    magic, version, length, size, _ = struct.unpack_from("<IIIII", model)
    assert (magic, version, length) == (0x46546C67, 2, len(model))
    return json.loads(model[20 : 20 + size]), model[28 + size :]


def positions(model, node):
    document, binary = document_of(model)
    attributes = document["meshes"][document["nodes"][node]["mesh"]]["primitives"][0]["attributes"]
    accessor = document["accessors"][attributes["POSITION"]]
    view = document["bufferViews"][accessor["bufferView"]]
    return np.frombuffer(binary, "<f4", 3 * accessor["count"], view["byteOffset"]).reshape(-1, 3)


def test_each_pose(run):
    put(run, "robot", arm_world().bytes())
    content = export(run)
    found = content.messages["/world/robot/transforms"]
    assert content.schema("/world/robot/transforms").name == "foxglove.FrameTransforms"
    assert [time for time, _ in found] == [250000000 * k for k in range(9)]
    first = {entry.child_frame_id: entry for entry in found[0][1].transforms}
    assert {name: entry.parent_frame_id for name, entry in first.items()} == {"arm": "world", "slide": "arm"}
    assert first["arm"].translation.z == 1
    for time, message in found:
        seconds = time / 1e9
        for entry in message.transforms:
            assert entry.timestamp.ToNanoseconds() == time
            if entry.child_frame_id == "arm":
                rotation = entry.rotation
                expected = turned(2 * min(seconds, 1))
                assert [rotation.x, rotation.y, rotation.z, rotation.w] == pytest.approx(expected, abs=1e-7)
            else:
                assert entry.translation.x == pytest.approx(4 * max(seconds - 1, 0))
    # what stands still is not repeated, but for its keyframes, from which on it moves
    moving = [[entry.child_frame_id for entry in message.transforms] for _, message in found]
    assert moving == [["arm", "slide"], ["arm"], ["arm"], ["arm"], ["arm", "slide"], *[["slide"]] * 4]


def test_the_start_of_a_run_and_keyframes_between_samples(run):
    world = arm_world(start="1.5", interval=0.4)
    world.animate(2, "translation", [0, 0.7], [[0, 0, 0], [0, 0, 7]])
    put(run, "robot", world.bytes())
    times = [time for time, _ in export(run).messages["/world/robot/transforms"]]
    milliseconds = sorted({*range(0, 2000, 400), 700, 1000, 2000})
    assert times == pytest.approx([(1500 + each) * 10**6 for each in milliseconds], abs=100)


def test_models_of_bodies(run):
    put(run, "robot", arm_world().bytes())
    content = export(run)
    ((time, update),) = content.messages["/world/robot/scene"]
    assert time == 0 and content.schema("/world/robot/scene").name == "foxglove.SceneUpdate"
    assert [(each.id, each.frame_id, each.frame_locked) for each in update.entities] == [
        ("world", "world", True),
        ("arm", "arm", True),
    ]
    (floor,), (link,) = (entity.models for entity in update.entities)
    assert floor.media_type == "model/gltf-binary" and floor.pose.orientation.w == 1
    assert (floor.scale.x, floor.scale.y, floor.scale.z) == (1, 1, 1)
    document, binary = document_of(link.data)
    root, node = document["nodes"]
    assert root == {"rotation": pytest.approx(TURN), "children": [1]}
    assert node == {"name": "link", "mesh": 0, "translation": [0.5, 0, 0], "scale": [1, 2, 3]}
    assert (positions(link.data, 1) == 2 * TRIANGLE).all() and (positions(floor.data, 1) == TRIANGLE).all()
    view = document["bufferViews"][document["images"][0]["bufferView"]]
    assert binary[view["byteOffset"] :][: view["byteLength"]] == PICTURE
    assert [material["name"] for material in document["materials"]] == ["painted"]
    assert "images" not in document_of(floor.data)[0]


def test_lamps_are_switched_at_their_instants(run):
    put(run, "robot", arm_world().bytes())
    content = export(run)
    found = content.messages["/world/robot/lamps/led"]
    assert [time for time, _ in found] == [0, pytest.approx(600000000, abs=50), 1500000000]
    shown = []
    for _, update in found:
        (entity,) = update.entities
        assert (entity.id, entity.frame_id) == ("led", "slide")
        (model,) = entity.models
        document, _ = document_of(model.data)
        assert "scale" not in document["nodes"][1]
        shown.append([material["name"] for material in document["materials"]])
    assert shown == [["red"], ["lit", "red"], ["red"]]  # a halo is below the one that is lit
    document, _ = document_of(found[1][1].entities[0].models[0].data)
    assert document["extensionsUsed"] == ["KHR_materials_emissive_strength"]
    assert len(document["nodes"]) == 3


def test_a_lamp_that_is_never_switched(run):
    world = arm_world()
    world.document["animations"][0]["channels"] = world.document["animations"][0]["channels"][:3]
    put(run, "robot", world.bytes())
    ((_, update),) = export(run).messages["/world/robot/lamps/led"]
    assert document_of(update.entities[0].models[0].data)[0]["materials"] == [{"name": "red"}]


def test_a_world_without_motion(run):
    world = arm_world()
    del world.document["animations"]
    put(run, "robot", world.bytes())
    ((time, message),) = export(run).messages["/world/robot/transforms"]
    assert time == 0 and [entry.child_frame_id for entry in message.transforms] == ["arm", "slide"]


def test_two_worlds_have_frames_of_their_own(run):
    put(run, "left", arm_world().bytes())
    put(run, "right", arm_world().bytes())
    content = export(run)
    for side in ("left", "right"):
        transforms = content.messages[f"/world/{side}/transforms"][0][1].transforms
        assert [entry.child_frame_id for entry in transforms] == [f"{side}/arm", f"{side}/slide"]
        assert content.messages[f"/world/{side}/scene"][0][1].entities[0].frame_id == f"{side}/world"


def test_frames_have_names_of_their_own(run):
    world = arm_world()
    world.document["nodes"][2]["name"] = world.document["nodes"][4]["name"] = "arm"
    world.document["nodes"][0]["name"] = ""
    put(run, "robot", world.bytes())
    transforms = export(run).messages["/world/robot/transforms"][0][1].transforms
    assert [(each.parent_frame_id, each.child_frame_id) for each in transforms] == [("node 0", "arm"), ("arm", "arm 2")]


def damaged(change):
    world = arm_world()
    change(world.document)
    return world.bytes()


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"no glTF at all",
        arm_world().bytes()[:-8],
        container([], b""),
        damaged(lambda document: document["nodes"][4].update(children=[2])),
        damaged(lambda document: document["nodes"][4].update(children=[77])),
        damaged(lambda document: document["nodes"][2].update(matrix=[1] * 16, translation=None)),
        damaged(lambda document: document["nodes"][0].update(rotation=[0, 0, 0, 1])),
        damaged(lambda document: document["bufferViews"][-1].update(byteLength=10**9)),
        damaged(lambda document: document["animations"][0]["samplers"][1].update(interpolation="CUBICSPLINE")),
        damaged(lambda document: document["asset"]["extras"]["stride"].update(startTime="soon")),
        damaged(lambda document: document.pop("meshes")),
        damaged(lambda document: document.pop("nodes")),
        damaged(lambda document: document["accessors"][0].update(count=10**9)),
        damaged(lambda document: document.update(scenes=[{"nodes": [0, 1]}])),
    ],
)
def test_a_file_that_is_damaged_is_left_out(run, caplog, data):
    put(run, "robot", data)
    content = export(run)
    assert "world.glb is left out: " in caplog.text
    assert not [topic for topic in content.channels if topic.startswith("/world")]
    assert len(content.messages["/signals/first"]) == 17


def test_the_same_world_gives_the_same_bytes(run):
    put(run, "robot", arm_world().bytes())
    files = [run.to_mcap(name).file.read_bytes() for name in ("a.mcap", "b.mcap")]
    assert files[0] == files[1]


def test_a_world_of_mujoco(tmp_path, monkeypatch):
    """Its LED shines when the signal says so, to the precision of a keyframe."""
    monkeypatch.chdir(tmp_path)
    try:
        run = stride.run("nfc_approach", scene=0.5, stop=14.5, no_checks=True, signals="sensor.led", out="out")
    except stride.InputError as error:
        if "--scene" not in str(error):
            raise
        pytest.skip("this stride writes no world.glb")
    content = export(run)
    times = [time for time, _ in content.messages["/world/world/lamps/led"]]
    lit = run.time[run.signals["sensor.led"].argmax()]
    assert times == [0, pytest.approx(lit * 1e9, abs=1000)]
    frames = {entry.child_frame_id for entry in content.messages["/world/world/transforms"][0][1].transforms}
    ((_, scene),) = content.messages["/world/world/scene"]
    assert {entity.frame_id for entity in scene.entities} <= {"world", *frames}
