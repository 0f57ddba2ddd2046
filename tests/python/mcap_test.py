"""stride.export_mcap and `stride export`, read back by the reader of MCAP's own package."""

import csv
import os
import subprocess
import sys
from collections import defaultdict
from datetime import datetime, timezone
from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest
import stride
from conftest import scenario
from google.protobuf.descriptor_pb2 import FileDescriptorSet
from google.protobuf.descriptor_pool import DescriptorPool
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory


class Content:
    """Of an MCAP file: its messages by topic, each with its time [ns]."""

    def __init__(self, file):
        with open(file, "rb") as stream:
            reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
            self.summary = reader.get_summary()
            self.metadata = {each.name: each.metadata for each in reader.iter_metadata()}
            self.attachments = {each.name: each.data for each in reader.iter_attachments()}
            self.messages = defaultdict(list)
            self.times = []
            for schema, channel, message, decoded in reader.iter_decoded_messages(log_time_order=False):
                assert message.publish_time == message.log_time
                assert message.sequence == len(self.messages[channel.topic])
                self.messages[channel.topic].append((message.log_time, decoded))
                self.times.append(message.log_time)
        assert self.times == sorted(self.times)
        self.channels = {each.topic: each for each in self.summary.channels.values()}

    def schema(self, topic):
        return self.summary.schemas[self.channels[topic].schema_id]

    def log(self, time=None):
        return [
            (entry.Level.Name(entry.level), entry.name, entry.message)
            for at, entry in self.messages["/log"]
            if time is None or at == time
        ]


def nanoseconds(text):
    return int((Decimal(text) * 10**9 + Decimal("0.5")) // 1)


def export(run, **options):
    return Content(run.to_mcap("run.mcap", **options).file)


def test_each_value_of_the_signals(folder):
    run = stride.run("test.ssd", set={"first.u": 1}, out="out")
    content = export(run)
    for name in ("first", "second"):
        messages = content.messages[f"/signals/{name}"]
        assert [message.y for _, message in messages] == list(run.signals[f"{name}.y"])
        assert [time for time, _ in messages] == [125000000 * row for row in range(9)]
        assert content.schema(f"/signals/{name}").name == f"stride.signals.{name}"
        assert content.schema(f"/signals/{name}").encoding == "protobuf"


def test_values_of_each_type(types):
    run = stride.run(
        "types.ssd",
        out="out",
        set={
            "types.float32": 0.1,
            "types.float64": -0.0,
            "types.int8": -128,
            "types.int64": -(2**63),
            "types.uint64": 2**64 - 1,
            "types.boolean": True,
            "types.string": 'a, "b" °\n',
            "types.binary": b"\x01\xff",
            "types.matrix": np.arange(6.0).reshape(2, 3) / 3,
            "types.words": ["one", "two"],
        },
    )
    content = export(run)
    message = content.messages["/signals/types"][-1][1]
    for name in ("float32", "float64", "int8", "int64", "uint64", "boolean", "string", "binary", "colour"):
        expected = run.signals[f"types.{name}.echo"][-1]
        assert getattr(message, name).echo == expected, name
    assert np.signbit(message.float64.echo)
    assert list(message.matrix.echo) == [
        run.signals[f"types.matrix.echo[{i},{j}]"][-1] for i in (1, 2) for j in (1, 2, 3)
    ]
    assert list(message.words.echo) == ["one", "two"] and list(message.flags.echo) == [False] * 3
    assert content.channels["/signals/types"].metadata["unit:float64.echo"] == "m"


@pytest.mark.parametrize("value", ["nan", "inf", "-inf", "5e-324", "1.7976931348623157e+308"])
def test_values_that_json_has_not(types, value):
    run = stride.run("types.ssd", out="out", signals="types.float64.echo")
    file = run.folder / "signals.csv"
    lines = file.read_text().splitlines()
    file.write_text("\n".join([lines[0], f"0,{value}"]) + "\n")
    ((_, message),) = export(run).messages["/signals/types"]
    assert repr(message.float64.echo) == repr(float(value))


def test_some_elements_of_an_array_have_fields_of_their_own(types):
    """As those of FMI 2, which has no arrays: `--signals` may record some of them."""
    run = stride.run("types.ssd", out="out", signals=["types.matrix.echo"])
    run.info["signals"] = [each for each in run.info["signals"] if each["name"].endswith(("[2,1]", "[1,3]"))]
    (run.folder / "signals.csv").write_text('time,"types.matrix.echo[1,3]","types.matrix.echo[2,1]"\n0,3,4\n')
    ((_, message),) = export(run).messages["/signals/types"]
    assert (message.matrix.echo_1_3, message.matrix.echo_2_1) == (3, 4)


NAMES = [
    "a", "A", "a.b", "a.B", "a.b.c", "a_b", "aB", "der(x.y)", "der(der(x.y))", "'quoted.name'", "'it\\'s'.z", "1st",
    "ü", "_", "__x", "x_", ".", "..", "a..b", "class", "None", "Clear", "HasField", "DESCRIPTOR",
    "SerializeToString", "w[1].speed", "w[2].speed", "v[1]", "v[2]", "m[1,1]", "m[1,2]", "n[2]", "n[1]", "[1]",
    "f(", "Capacitor", "capacitor.voltage", "capacitor_.voltage", "empty[0]", "a" * 300, "new\nline",
]  # fmt: skip


def test_names_of_any_kind(folder):
    run = stride.run("test.ssd", set={"first.u": 1}, out="out")
    run.info["signals"] = [
        {"name": f"first.{name}", "unit": "", "type": "Float64", "variability": "continuous"} for name in NAMES
    ]
    with (run.folder / "signals.csv").open("w", newline="") as lines:
        csv.writer(lines).writerows([["time", *(f"first.{name}" for name in NAMES)], range(len(NAMES) + 1)])
    content = export(run)
    ((_, message),) = content.messages["/signals/first"]
    (file,) = FileDescriptorSet.FromString(content.schema("/signals/first").data).file
    found = {}
    for location in file.source_code_info.location:
        name, _, described = location.leading_comments[1:].rpartition(": Float64, continuous")
        entry, value = file.message_type[0], message
        for kind, index in zip(location.path[2::2], location.path[3::2]):
            if kind == 3:
                nested = entry.nested_type[index]
                (into,) = (each for each in entry.field if each.type_name.endswith(f".{nested.name}"))
                entry, value = nested, dict((key.name, item) for key, item in value.ListFields())[into.name]
            else:
                values = {key.name: item for key, item in value.ListFields()}[entry.field[index].name]
                found[name] = list(values) if "array" in described else values
    numbers = {name: float(number) for number, name in enumerate(NAMES, start=1)}
    for name in ("v", "m"):
        both = [each for each in NAMES if each.startswith(f"{name}[")]
        numbers[name] = [numbers.pop(each) for each in both]
    assert found == numbers


@pytest.mark.parametrize(
    ("components", "topics"),
    [
        (["a.b", "a"], ["/signals/a/b", "/signals/a"]),
        (["a b", "a_b"], ["/signals/a_b", "/signals/a_b_2"]),
        (["log", "ü"], ["/signals/log", "/signals/_"]),
    ],
)
def test_topics_of_components(folder, components, topics):
    run = stride.run("test.ssd", set={"first.u": 1}, out="out")
    run.info["units"] = [{"name": name} for name in components]
    run.info["signals"] = [
        {"name": f"{name}.y", "unit": "", "type": "Float64", "variability": "continuous"} for name in components
    ]
    (run.folder / "signals.csv").write_text(f"time,{','.join(f'{name}.y' for name in components)}\n0,1,2\n")
    content = export(run)
    assert [content.messages[topic][0][1].y for topic in topics] == [1, 2]
    assert [content.channels[topic].metadata["component"] for topic in topics] == components


def test_schemas_describe_themselves(types):
    content = export(stride.run("types.ssd", out="out"))
    pool, comments = DescriptorPool(), []
    for file in FileDescriptorSet.FromString(content.schema("/signals/types").data).file:
        pool.Add(file)
        comments += [location.leading_comments for location in file.source_code_info.location]
    assert pool.FindMessageTypeByName("stride.signals.types").fields_by_name["float64"]
    assert " float64.echo [m]: Float64, continuous\n" in comments
    assert " matrix.echo: Float64, continuous; array of 2 x 3, row by row\n" in comments


def test_times_are_rounded_to_nanoseconds(folder):
    run = stride.run("test.ssd", set={"first.u": 1}, out="out")
    file = run.folder / "signals.csv"
    times = ["0", "0.0000000004", "0.000000000500", "1.5", "1.5", "9007199.254740993499"]
    rows = file.read_text().splitlines()
    file.write_text("\n".join([rows[0], *(f"{time},1,2" for time in times)]) + "\n")
    content = export(run)
    assert [time for time, _ in content.messages["/signals/first"]] == [nanoseconds(time) for time in times]
    assert content.messages["/signals/first"][-1][0] == 9007199254740993


def test_dates(folder):
    run = stride.run("test.ssd", set={"first.u": 1}, out="out")
    begin = 1795752591 * 10**9
    for epoch in ("2026-11-27T04:09:51Z", datetime(2026, 11, 27, 4, 9, 51, tzinfo=timezone.utc)):
        content = export(run, epoch=epoch)
        assert [time for time, _ in content.messages["/signals/first"]] == [begin + 125000000 * row for row in range(9)]
        assert content.messages["/log"][-1][1].timestamp.ToNanoseconds() == begin + 10**9
    date = datetime.fromisoformat(run.info["provenance"]["date"].replace("Z", "+00:00"))
    assert export(run, epoch="run").times[0] == int(date.timestamp()) * 10**9
    with pytest.raises(stride.InputError, match="'yesterday' is no date"):
        export(run, epoch="yesterday")
    with pytest.raises(stride.InputError, match="no time for 0 s"):
        export(run, epoch="1969-01-01")


@pytest.fixture
def messages(tmp_path, monkeypatch):
    """A run with messages of several types, and an intervention."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "ticking.ssd").write_text(scenario("ticker=ticker"))
    return stride.run("ticking.ssd", set={"ticker.period": 0.2}, out="out")


def test_each_message(messages):
    with (messages.folder / "events.csv").open(newline="") as lines:
        rows = list(csv.DictReader(lines))
    assert rows
    content = export(messages)
    topics = {topic: iter(found) for topic, found in content.messages.items()}
    for row in rows:
        name = f"{row['component']}.{row['variable']}"
        time, message = next(topics[f"/messages/{name.replace('.', '/')}"])
        assert time == nanoseconds(row["time"])
        found = (message.direction, str(message.index), message.payload, message.content)
        assert found == (row["direction"], row["index"], row["payload"], row["content"])
        entry = ("INFO", row["component"], f"{row['variable']} {row['direction']}: {row['payload']}".removesuffix(": "))
        assert entry in content.log(time)
    assert sum(topic.startswith("/messages/") for topic in topics) == len({row["variable"] for row in rows})


def test_what_payloads_mean(messages):
    (messages.folder / "events.csv").write_text(
        "time,index,component,variable,direction,payload,content\n"
        '0.5,1,ticker,frame,sent,00e8ff,"set_led ""1"""\n'
        "0.5,2,ticker,force,intervention,,begins\n"
        "0.6,0,ticker,value,sent,21.49,\n"
        "0.6,0,ticker,value,sent,true,\n"
        "0.6,0,ticker,value,sent,1 2,\n"
    )
    content = export(messages)
    numbers = [message.number for _, message in content.messages["/messages/ticker/value"]]
    assert numbers[:2] == [21.49, 1] and np.isnan(numbers[2])
    ((time, message),) = content.messages["/messages/ticker/frame"]
    assert np.isnan(message.number)
    assert (time, message.data, message.content) == (500000000, b"\x00\xe8\xff", 'set_led "1"')
    assert content.log(time)[:2] == [
        ("INFO", "ticker", 'frame sent: set_led "1"'),
        ("WARNING", "ticker", "force: begins"),
    ]


def test_steps_that_were_not_ordinary_are_in_the_log_in_order(messages):
    (messages.folder / "activity.csv").write_text(
        "time,until,component,kind\n"
        "0,0,a,event\n"
        "0.1,0.15,a,early return\n"
        "0.1,0.2,b,undone\n"
        "0.15,0.3,c,rejection\n"
        "0,0.3,a,idle\n"
    )
    content = export(messages)
    assert content.log(100000000) == [("DEBUG", "b", "its step to 0.2 s was rolled back")]
    assert content.log(150000000) == [
        ("DEBUG", "a", "early return from its step of 0.1 s"),
        ("WARNING", "c", "it rejected the step to 0.3 s"),
    ]


def test_checks_are_in_the_log(folder):
    (folder / "test.ssd").write_text(
        scenario(
            "first=minimal",
            annotation='<stride:Checks><stride:Always name="low" signal="first.y" max="0.5"/>'
            '<stride:Final signal="first.y" min="0"/></stride:Checks>',
        )
    )
    run = stride.run("test.ssd", set={"first.u": 1}, out="out")
    log = export(run).log()
    (failed,) = (check for check in run.info["checks"] if check["passed"] is False)
    assert ("ERROR", "low", f"the check fails: {failed['text']}") in export(run).log(nanoseconds(str(failed["time"])))
    assert [entry[:2] for entry in log[-3:-1]] == [("ERROR", "low"), ("INFO", run.info["checks"][1]["name"])]
    assert log[-1] == ("INFO", "root", "the run is completed")
    entry = export(run).messages["/log"][0][1]
    assert (entry.file, entry.line) == ("test.ssd", failed["line"])


def test_a_run_that_has_failed(folder):
    (folder / "failing.ssd").write_text(scenario("thrower=thrower filter=minimal"))
    with pytest.raises(stride.RunError) as caught:
        stride.run("failing.ssd", set={"thrower.throw_at": 0.5}, out="out")
    content = export(caught.value.run)
    assert len(content.messages["/signals/filter"]) == 4
    (level, _, text) = content.log()[-1]
    assert level == "FATAL" and "the fuse has blown" in text
    assert "the fuse has blown" in content.metadata["stride"]["error"]


_KILLED = """
import os, stride
sim = stride.Simulation("test.ssd", set={"first.u": 1}, results="out")
sim.step(0.5)
os.kill(os.getpid(), 9)
"""


def test_a_run_that_was_killed(folder, caplog):
    subprocess.run([sys.executable, "-c", _KILLED])
    file = folder / "out" / "signals.csv"
    file.write_text("time,first.y,second.y\n0,0.5,0\n0.125,0.2")
    content = export(stride.Run("out"))
    assert [message.y for _, message in content.messages["/signals/first"]] == [0.5]
    assert "its last line is cut off" in caplog.text
    assert content.log() == [("ERROR", "root", "the run was killed")]
    file.write_text('time,first.y,second.y\n0,0.5,0\n0.125,0.2,"\n')
    assert len(export(stride.Run("out")).messages["/signals/first"]) == 1
    file.write_text("")
    assert export(stride.Run("out")).messages["/signals/first"] == []


def test_files_that_are_empty(folder, caplog):
    stride.run("test.ssd", set={"first.u": 1}, out="out")
    for name in ("signals.csv", "events.csv"):
        Path("out", name).write_text("")
    content = export(stride.Run("out"))
    assert content.messages["/signals/first"] == []
    for name in ("signals.csv", "events.csv"):
        assert f"{name} is empty" in caplog.text


def test_pictures(folder):
    run = stride.run("test.ssd", out="out", set={"first.u": 1})
    film = run.folder / "units" / "a%2Fb" / "film"
    film.mkdir(parents=True)
    (film / "0.jpg").write_bytes(b"\xff\xd8 a picture")
    (film / "1.png").write_bytes(b"\x89PNG another")
    (film / "frames.csv").write_text("time,file\n0,0.jpg\n0.5,1.png\n")
    content = export(run)
    found = [(time, image.format, image.data) for time, image in content.messages["/film/a_b"]]
    assert found == [(0, "jpeg", b"\xff\xd8 a picture"), (500000000, "png", b"\x89PNG another")]
    assert content.channels["/film/a_b"].metadata == {"component": "a/b"}
    assert content.schema("/film/a_b").name == "foxglove.CompressedImage"


@pytest.mark.parametrize("name", ["../../../../secret.jpg", "link.jpg", "fifo.jpg", "gone.jpg", "0.txt"])
def test_a_film_leads_to_no_other_file(folder, caplog, name):
    run = stride.run("test.ssd", out="out", set={"first.u": 1})
    film = run.folder / "units" / "first" / "film"
    film.mkdir(parents=True)
    (folder / "secret.jpg").write_text("secret")
    (film / "link.jpg").symlink_to(folder / "secret.jpg")
    os.mkfifo(film / "fifo.jpg")
    (film / "0.txt").write_text("text")
    (film / "frames.csv").write_text(f"time,file\n0,{name}\n")
    assert export(run).messages["/film/first"] == []
    assert f"there is no picture '{name}'" in caplog.text


def test_what_the_run_was_made_from(folder):
    run = stride.run("test.ssd", out="out", set={"first.u": 1})
    content = export(run)
    assert content.attachments == {"run.json": (run.folder / "run.json").read_bytes()}
    assert content.metadata["stride"]["scenario"].endswith("test.ssd")
    assert content.metadata["stride"]["outcome"] == "completed"
    assert content.metadata["stride"]["command"].startswith("stride run")


def test_the_same_results_give_the_same_bytes(messages):
    first = Path(messages.to_mcap("a.mcap").file).read_bytes()
    assert first == Path(messages.to_mcap("b.mcap").file).read_bytes()
    script = "import stride; stride.export_mcap('out', 'c.mcap')"
    for seed in ("1", "2"):
        subprocess.run([sys.executable, "-c", script], env={**os.environ, "PYTHONHASHSEED": seed}, check=True)
        assert Path("c.mcap").read_bytes() == first


def test_a_long_run_needs_no_memory_for_all_of_it(folder):
    run = stride.run("test.ssd", out="out", set={"first.u": 1})
    with (run.folder / "signals.csv").open("w") as lines:
        lines.write("time,first.y,second.y\n")
        for row in range(100_000):
            lines.write(f"{row},{row / 7},{row / 3}\n")
    script = (
        "import resource, stride.export._log, stride\n"
        "stride.export_mcap('short', 'short.mcap')\n"
        "before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n"
        "made = stride.export_mcap('out', 'long.mcap')\n"
        "print(made.messages, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)\n"
    )
    stride.run("test.ssd", out="short", set={"first.u": 1})
    found = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True).stdout
    messages, kilobytes = map(int, found.split())
    assert messages > 200_000 and kilobytes < 16_000


def command(*words, **options):
    return subprocess.run([sys.executable, "-m", "stride", "export", *words], capture_output=True, text=True, **options)


def test_the_command(folder):
    stride.run("test.ssd", out="out", set={"first.u": 1})
    done = command("out", "--mcap", "run.mcap")
    assert (done.returncode, done.stderr) == (0, "")
    content = Content("run.mcap")
    assert done.stdout == f"run.mcap: {len(content.times)} messages of {len(content.channels)} topics\n"
    assert command("out", "--mcap=dated.mcap", "--epoch=run").returncode == 0
    assert Content("dated.mcap").times[0] > 10**18


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        (["nowhere", "--mcap=x.mcap"], 2, "nowhere is no folder of results"),
        (["out"], 2, "required: --mcap"),
        (["out", "--mcap=x.mcap", "--epoc=run"], 2, "--epoc=run"),
        (["out", "--mcap=x.mcap", "--epoch=soon"], 2, "'soon' is no date"),
        (["out", "--mcap=gone/x.mcap"], 2, "there is no folder"),
        (["out", "--mcap=out"], 2, "it is a folder"),
        (["out", "--mcap=out/run.json"], 2, "is one of the results"),
        (["out", "--mcap=link.mcap"], 2, "is one of the results"),
        (["out", "--mcap=/dev/full"], 1, "cannot write /dev/full: No space left on device"),
        (["wrong", "--mcap=x.mcap"], 2, "signals.csv:3: a value is wrong"),
        (["back", "--mcap=x.mcap"], 2, "signals.csv:4: a value is wrong: the time goes back to 0.5"),
        (["short", "--mcap=x.mcap"], 2, "signals.csv:2: there are 2 fields; expected 3"),
        (["other", "--mcap=x.mcap"], 2, "signals.csv:1: its columns are time, a"),
    ],
)
def test_mistakes(folder, words, code, message):
    for name in ("out", "wrong", "back", "short", "other"):
        stride.run("test.ssd", out=name, set={"first.u": 1})
    (folder / "wrong" / "signals.csv").write_text("time,first.y,second.y\n0,1,2\n1,2,x\n")
    (folder / "back" / "signals.csv").write_text("time,first.y,second.y\n0,1,2\n1,2,3\n0.5,2,3\n")
    (folder / "short" / "signals.csv").write_text("time,first.y,second.y\n0,1\n1,2,3\n")
    (folder / "other" / "signals.csv").write_text("time,a\n0,1\n")
    (folder / "link.mcap").symlink_to("out/signals.csv")
    done = command(*words)
    assert (done.returncode, done.stdout) == (code, "")
    assert done.stderr.startswith("stride: error: ") and message in done.stderr
    assert "Traceback" not in done.stderr
    assert not list(folder.rglob("*.part")) and not Path("x.mcap").exists()
    assert stride.Run("out").info["outcome"] == "completed"


def test_what_it_prints_cannot_control_the_terminal(folder):
    run = stride.run("test.ssd", out="out", set={"first.u": 1})
    film = run.folder / "units" / "first" / "film"
    film.mkdir(parents=True)
    (film / "frames.csv").write_text('time,file\n0,"\x1b[2J\u202e\nstride: error: no.jpg"\n')
    done = command("out", "--mcap", "run.mcap")
    assert done.returncode == 0
    assert done.stderr.endswith("there is no picture '\\x1b[2J\\u202e\n  stride: error: no.jpg'\n")


def test_a_file_stays_where_the_new_one_fails(folder):
    stride.run("test.ssd", out="out", set={"first.u": 1})
    (folder / "out" / "signals.csv").write_text("time,first.y,second.y\n0,1,2\n1,2,x\n")
    Path("run.mcap").write_text("an older one")
    assert command("out", "--mcap=run.mcap").returncode == 2
    assert Path("run.mcap").read_text() == "an older one"


def test_a_package_that_is_missing(folder):
    stride.run("test.ssd", out="out", set={"first.u": 1})
    (folder / "blocked").mkdir()
    (folder / "blocked" / "sitecustomize.py").write_text("import sys\nsys.modules['mcap'] = None\n")
    path = os.pathsep.join([str(folder / "blocked"), *filter(None, [os.environ.get("PYTHONPATH")])])
    done = command("out", "--mcap=run.mcap", env={**os.environ, "PYTHONPATH": path})
    assert done.returncode == 2
    assert "'mcap', which is not installed\n  hint: pip install 'stride-cosim[mcap]'" in done.stderr
