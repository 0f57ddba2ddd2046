"""Tables in Parquet and MCAP files as components, and what stride says of those that it cannot play."""

import os
import sys

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import stride
from conftest import scenario


def write(file, columns, units=None):
    """A Parquet file of arrays by name, with units of measure in the metadata of their fields."""
    arrays = {name: pa.array(values) if isinstance(values, list) else values for name, values in columns.items()}
    fields = [
        pa.field(name, array.type, metadata={"unit": units[name]} if name in (units or {}) else None)
        for name, array in arrays.items()
    ]
    pq.write_table(pa.table(list(arrays.values()), schema=pa.schema(fields)), file)


@pytest.fixture
def here(tmp_path, monkeypatch):
    """A working folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


CYCLE = {
    "time": [0.0, 2.0, 4.0, 4.0, 10.0],
    "wanted [m/s]": [0.0, 0.0, 3.0, 5.0, 5.0],
    "gear": pa.array([1, 1, None, 2, None], pa.int32()),
    "door": [True, False, None, None, None],
    "note": ["a", 'b, "c"', None, None, "d"],
}
CSV = """time,wanted [m/s],gear: Int32,door: Boolean,note
0,0,1,true,a
2,0,1,false,"b, ""c\"""
4,3,,,
4,5,2,,
10,5,,,d
"""


def played(file, **options):
    run = stride.run(file, step=0.5, no_idle_skip=True, **options)
    return run, {name.partition(".")[2]: list(values) for name, values in run.signals.items()}


def test_a_parquet_file_is_the_same_as_one_of_csv(here):
    write("cycle.parquet", CYCLE)
    (here / "cycle.csv").write_text(CSV, encoding="utf-8")
    ours, signals = played("cycle.parquet")
    theirs, expected = played("cycle.csv")
    assert signals == expected
    assert list(ours.time) == list(theirs.time)
    assert ours.units == theirs.units == {"cycle.wanted": "m/s", **{k: "" for k in ("cycle.gear", "cycle.door", "cycle.note")}}
    assert [signal["type"] for signal in ours.info["signals"]] == ["Float64", "Int32", "Boolean", "String"]


def test_types_and_units_of_measure_are_in_the_schema(here):
    write(
        "cycle.parquet",
        {
            "speed": pa.array([36.0, 72.0], pa.float32()),
            "count: hold": pa.array([1, 2], pa.uint16()),
            "height [m]": pa.array([1, 4], pa.int64()),
            "bytes": pa.array([b"\x01\xff", b""], pa.binary()),
            "kind": pa.array(["x", "y"]).dictionary_encode(),
            "time": pa.array([0, 1500], pa.duration("ms")),
        },
        {"speed": "km/h"},
    )
    run, signals = played("cycle.parquet")
    assert {signal["name"]: (signal["type"], signal["unit"]) for signal in run.info["signals"]} == {
        "cycle.speed": ("Float32", "km/h"),
        "cycle.count": ("UInt16", ""),
        "cycle.height": ("Float64", "m"),
        "cycle.bytes": ("Binary", ""),
        "cycle.kind": ("String", ""),
    }
    assert list(run.time) == [0, 0.5, 1, 1.5]
    assert signals["speed"] == [36, 48, 60, 72]
    assert signals["height"] == [1, 2, 3, 4]


def test_a_table_of_pandas_with_the_time_as_index(here):
    pandas = pytest.importorskip("pandas")
    table = pandas.DataFrame({"u": [0.0, 1.0]}, index=pandas.Index([0.0, 1.0], name="time"))
    table.to_parquet("cycle.parquet")
    _, signals = played("cycle.parquet")
    assert signals["u"] == [0, 0.5, 1]


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        ({"t": [0.0], "u": [1.0]}, r"cycle\.parquet: there is no column 'time'.*; there are: t, u"),
        ({"time": [0.0], "u": [[1.0]]}, r"column 'u': values of the type list<.*> cannot be played"),
        ({"time": pa.array([0], pa.timestamp("s")), "u": [1.0]}, r"column 'time' has values of the type timestamp"),
        (
            {"time": [0.0], "u [m]": pa.array([9007199254740993])},
            r"column 'u \[m\]': 9007199254740993 has more digits than a Float64.*\n.*leave the unit of measure out",
        ),
        ({"time": [0.0], "u: int": [1.0]}, r"cycle\.parquet:1: column 2: 'int' behind the colon .* did you mean 'Int32'"),
        ({"time": [1.0, 0.0], "u": [1.0, 1.0]}, r"cycle\.parquet:3: column 'time': 0\.0 is before"),
    ],
)
def test_a_wrong_parquet_file(here, columns, message):
    write("cycle.parquet", columns)
    with pytest.raises(stride.InputError, match=message):
        stride.run("cycle.parquet")


def test_a_heading_and_metadata_that_contradict_each_other(here):
    write("cycle.parquet", {"time": [0.0, 1.0], "v [km/h]": [36.0, 72.0]}, {"v [km/h]": "m/s"})
    expected = r"cycle\.parquet: column 'v \[km/h\]' is in 'km/h' by its heading, and in 'm/s' by the metadata"
    with pytest.raises(stride.InputError, match=expected):
        stride.run("cycle.parquet")
    write("cycle.parquet", {"time": [0.0, 1.0], "v [km/h]": [36.0, 72.0]}, {"v [km/h]": "km/h"})
    assert played("cycle.parquet")[0].units == {"cycle.v": "km/h"}
    write("cycle.parquet", {"time [ms]": [0.0, 1.0], "v": [36.0, 72.0]}, {"time [ms]": "s"})
    with pytest.raises(stride.InputError, match=r"column 'time \[ms\]' is in 'ms' by its heading, and in 's'"):
        stride.run("cycle.parquet")


@pytest.mark.parametrize("name", ["x.parquet", "x.mcap"])
def test_a_file_that_is_something_else(here, name):
    (here / name).write_bytes(b"no table" * 10)
    with pytest.raises(stride.InputError, match=f"{name}: this is not a"):
        stride.run(name)


def test_a_package_is_missing(here, monkeypatch):
    """A Python without packages is one with -S, which a script can be."""
    write("cycle.parquet", CYCLE)
    bare = here / "bare"
    bare.write_text(f'#!/bin/sh\nexec {sys.executable} -S "$@"\n', encoding="utf-8")
    bare.chmod(0o755)
    monkeypatch.setenv("STRIDE_PYTHON", str(bare))
    with pytest.raises(stride.InputError, match="is read by the Python module 'pyarrow'.*") as caught:
        stride.run("cycle.parquet")
    assert "pip install pyarrow" in str(caught.value)


def test_what_lies_beside_a_table_is_not_run(here):
    write("cycle.parquet", CYCLE)
    for name in ("pyarrow", "json", "sitecustomize"):
        (here / f"{name}.py").write_text("open('was_here', 'w').close()\n", encoding="utf-8")
    stride.run("cycle.parquet")
    assert not (here / "was_here").exists()


def test_a_packed_table_needs_no_python(here, monkeypatch):
    write("cycle.parquet", CYCLE)
    (here / "test.ssd").write_text(
        scenario("cycle=x filter=minimal", "cycle.wanted>filter.u").replace("x.fmu", "cycle.parquet"), encoding="utf-8"
    )
    first = stride.run("test.ssd")
    stride._program.output_of(["pack", "test.ssd", "-o", "test.ssp"])
    monkeypatch.setenv("STRIDE_PYTHON", "no_such_program")
    again = stride.run("test.ssp")
    assert {name: list(values) for name, values in again.signals.items()} == {
        name: list(values) for name, values in first.signals.items()
    }


def test_signals_that_were_exported_are_read_back(types):
    run = stride.run("types.ssd")
    run.to_mcap("again.mcap")
    os.rename("again.mcap", "back.mcap")
    back = stride.run("back.mcap", step=0.125, no_idle_skip=True)
    assert {name.partition(".")[2] for name in back.signals} == {*run.signals}
    for name, values in run.signals.items():
        assert list(back.signals[f"back.{name}"]) == list(values), name


def test_units_of_measure_and_dates_are_read_back(here):
    (here / "cycle.csv").write_text("time,speed [km/h],gear: Int32,level: Float64 hold\n0,0,1,1\n1,36,2,2\n", encoding="utf-8")
    run, signals = played("cycle.csv")
    run.to_mcap("dated.mcap", epoch="run")
    again, back = played("dated.mcap")
    assert list(again.time) == list(run.time)
    assert back == {f"cycle.{name}": values for name, values in signals.items()}
    assert [(s["name"], s["type"], s["unit"], s["variability"]) for s in again.info["signals"]] == [
        ("dated.cycle.speed", "Float64", "km/h", "continuous"),
        ("dated.cycle.gear", "Int32", "", "discrete"),
        ("dated.cycle.level", "Float64", "", "discrete"),
    ]


def test_an_mcap_file_of_others(here):
    from mcap.writer import Writer

    with open("other.mcap", "wb") as stream:
        writer = Writer(stream)
        writer.start()
        schema = writer.register_schema("Pose", "jsonschema", b"{}")
        channel = writer.register_channel("/pose", "json", schema)
        writer.add_message(channel, 0, b"{}", 0)
        writer.finish()
    with pytest.raises(stride.InputError, match=r"other\.mcap: there are no signals of stride in it.*: /pose"):
        stride.run("other.mcap")


@pytest.mark.parametrize("schema", [b"\xff\xff", b"", b"\n\x00"])
def test_an_mcap_file_with_a_schema_of_our_name(here, schema):
    from mcap.writer import Writer

    with open("other.mcap", "wb") as stream:
        writer = Writer(stream)
        writer.start()
        number = writer.register_schema("stride.signals.x", "protobuf", schema)
        channel = writer.register_channel("/signals/x", "protobuf", number)
        writer.add_message(channel, 0, b"", 0)
        writer.finish()
    with pytest.raises(stride.InputError, match=r"other\.mcap: this is not an MCAP file that 'stride export' wrote") as caught:
        stride.run("other.mcap")
    assert "Traceback" not in str(caught.value)


def test_a_damaged_mcap_file(here):
    (here / "cycle.csv").write_text("time,u\n0,0\n1,1\n", encoding="utf-8")
    run, _ = played("cycle.csv")
    run.to_mcap("run.mcap")
    whole = (here / "run.mcap").read_bytes()
    (here / "cut.mcap").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(stride.InputError, match=r"cut\.mcap: "):
        stride.run("cut.mcap")


def test_an_index_of_numpy_is_a_time(here):
    write("cycle.parquet", {"time [ms]": pa.array(np.arange(3)), "u": pa.array(np.arange(3.0))})
    run, signals = played("cycle.parquet", stop=0.002)
    assert run.time[-1] == 0.002
    assert signals["u"][-1] == 2
