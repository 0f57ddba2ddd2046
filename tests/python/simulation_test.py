"""stride.Simulation: a run, step by step."""

import copy
import gc
import math
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
import stride
from conftest import processes_below, scenario


def test_it_is_advanced_and_looked_at(folder):
    with stride.Simulation("test.ssd", set={"first.u": 1, "second.time_constant": 0.5}) as sim:
        assert (sim.time, sim.start_time, sim.stop_time) == (0, 0, 1)
        assert sim.step(until=0.5) == 0.5
        assert sim.step(0.25) == 0.75
        assert sim["second.u"] == sim["first.y"] == pytest.approx(1 - math.exp(-0.75))
        assert not sim.is_over
        assert sim.run() == 1
        assert sim.is_over
        assert [verdict.passed for verdict in sim.end()] == [True, True]
        assert sim.end_reason == "completed"
        assert sim.has_ended


def test_what_is_set_counts_at_once_and_in_the_next_step(folder):
    with stride.Simulation("test.ssd") as sim:
        sim.step(until=0.3)
        sim["first.u"] = 2
        assert sim["first.u"] == 2
        sim.step(until=0.8)
        assert sim["first.y"] == pytest.approx(2 * (1 - math.exp(-0.5)))
        assert sim.time_ps == 800_000_000_000


def test_results_are_those_of_a_run(folder):
    with stride.Simulation("test.ssd", set={"first.u": 1}, results="stepped") as sim:
        sim.step(until=0.5)
        sim.run()
    whole = stride.run("test.ssd", set={"first.u": 1}, out="whole")
    stepped = stride.Run("stepped")
    assert (stepped.folder / "signals.csv").read_bytes() == (whole.folder / "signals.csv").read_bytes()
    assert stepped.verdicts == whole.verdicts


@pytest.mark.parametrize("unit", ["own_checksum", "own_names", "own_names_static", "every_symbol"])
def test_a_unit_calls_its_own_functions(folder, unit):
    (folder / "own.ssd").write_text(scenario(f"unit={unit}"), encoding="utf-8")
    with stride.Simulation("own.ssd") as sim:
        sim.run()
        assert sim["unit.own"] == sim["unit.called"] > 0
    signals = stride.run("own.ssd", out="own").signals
    assert signals["unit.own"][-1] == signals["unit.called"][-1]


def test_units_that_bring_along_libraries_of_one_name_have_their_own_ones(folder):
    simulations = []
    for answer in (1, 2, 3, 4, 3):
        (folder / "own.ssd").write_text(scenario(f"unit=bundling_{answer}"), encoding="utf-8")
        simulations.append(stride.Simulation("own.ssd"))
    for answer, sim in zip((1, 2, 3, 4, 3), simulations):
        sim.run()
        assert sim["unit.value"] == answer
        assert sim["unit.own"] == sim["unit.called"]
        sim.close()


def test_units_have_their_own_ones_of_what_a_process_has_once(folder):
    simulations = []
    for answer in (1, 2, 1):
        (folder / "own.ssd").write_text(scenario(f"unit=only_one_{answer}"), encoding="utf-8")
        simulations.append(stride.Simulation("own.ssd"))
    for answer, sim in zip((1, 2, 1), simulations):
        sim.run()
        assert (sim["unit.value"], sim["unit.own"]) == (answer, 2)
        sim.close()


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("float64", 0.1),
        ("float32", 0.5),
        ("int8", -128),
        ("uint64", 2**64 - 1),
        ("int64", -(2**63)),
        ("boolean", True),
        ("colour", 4),
        ("string", "größer 🛰"),
        ("string", ""),
        ("binary", b"\x00\xff"),
        ("binary", b""),
        ("float64", np.float32(0.25)),
    ],
)
def test_values_come_back(types, name, value):
    with stride.Simulation("types.ssd") as sim:
        sim[f"types.{name}"] = value
        sim.step(0.25)
        assert sim[f"types.{name}.echo"] == value
        assert type(sim[f"types.{name}.echo"]) in (bool, int, float, str, bytes)


def test_arrays_keep_their_shape(types):
    with stride.Simulation("types.ssd") as sim:
        assert sim["types.matrix"].tolist() == [[1, 2, 3], [4, 5, 6]]
        sim["types.matrix"] = np.array([[6, 5, 4], [3, 2, 1]])
        sim.step(0.25)
        assert sim["types.matrix.echo"].tolist() == [[6, 5, 4], [3, 2, 1]]
        words = sim["types.words"]
        sim["types.words"] = np.full(words.shape, "ö", dtype=object)
        sim["types.blobs"] = [bytearray(b"\x01"), memoryview(b"\x01")]
        sim.step(0.25)
        assert (sim["types.words.echo"] == "ö").all()
        assert (sim["types.blobs.echo"] == b"\x01").all()


def test_variables_are_described(types):
    with stride.Simulation("types.ssd") as sim:
        matrix = sim.variables["types.matrix"]
        assert (matrix.type, matrix.causality, matrix.shape) == ("Float64", "input", (2, 3))
        frame = sim.variables["types.receive.frame"]
        assert frame.is_message and frame.clocks == ("types.receive.clock",)
        assert sim.variables["types.gained"].unit == "m"
        assert not sim.variables["types.gained"].is_relative
        assert "types.gain" in sim and "types.nothing" not in sim
        assert "types.float32" in list(sim)


def test_a_difference_is_known(folder):
    (folder / "gain.ssd").write_text(scenario("unit=gain"), encoding="utf-8")
    with stride.Simulation("gain.ssd") as sim:
        assert sim.variables["unit.k"].is_relative


def test_messages_are_sent_and_received(types):
    with stride.Simulation("types.ssd") as sim:
        sim.step(0.25)
        sim.send("types.receive.frame", b"\x07\x08")
        sim.step(0.25)
        sim.send("types.receive.clock", **{"receive.frame": b"\x09"})
        sim.step(0.25)
        received = [(m.time, m.variable, m.value) for m in sim.messages() if m.received]
        assert received == [(0.25, "types.receive.frame", b"\x07\x08"), (0.5, "types.receive.frame", b"\x09")]
        assert sim.messages() == []


def test_interventions(folder):
    with stride.Simulation("test.ssd") as sim:
        sim.step(until=0.25)
        sim.intervene("force", "second.u=3@0.5..0.75")
        sim.intervene("set_at", "first.u=1@0.5")
        sim.step(until=0.625)
        assert sim["second.u"] == 3
        assert sim["first.u"] == 1
        sim["first.u"] = 0
        sim.run()
        assert sim["second.u"] == sim["first.y"]


def test_a_checkpoint_goes_on(folder):
    with stride.Simulation("test.ssd", set={"first.u": 1}, can_save=True) as sim:
        sim.step(until=0.5)
        sim.save("half.zip")
        sim.run()
        end = sim["second.y"]
    with stride.Simulation("test.ssd", set={"first.u": 1}, checkpoint="half.zip") as sim:
        assert sim.time == 0.5
        sim.run()
        assert sim["second.y"] == end


# ---- Mistakes ----


def test_errors_say_what_and_where(folder):
    with stride.Simulation("test.ssd") as sim:
        with pytest.raises(stride.InputError, match="is fed by 'first.y'") as caught:
            sim["second.u"] = 1
        assert (caught.value.component, caught.value.variable) == ("second", "u")
        assert "force" in caught.value.hint
        with pytest.raises(stride.InputError, match="did you mean 'second.y'"):
            sim["second.yy"]
        with pytest.raises(stride.InputError, match="later than"):
            sim.step(until=-1)
        with pytest.raises(stride.InputError, match="would go back"):
            sim.step(-1)
        with pytest.raises(stride.InputError, match="shorter than a picosecond"):
            sim.step(1e-13)
        with pytest.raises(stride.InputError, match="would go back"):
            sim.step(-(10**400))
        with pytest.raises(stride.InputError, match="a number"):
            sim.step("soon")
        with pytest.raises(stride.InputError, match="a number"):
            sim.step(until=math.nan)
        with pytest.raises(stride.MisuseError, match="and not both"):
            sim.step()
        with pytest.raises(stride.MisuseError, match="can_save"):
            sim.save("x.zip")
        with pytest.raises(stride.InputError, match="is a text, not 7"):
            sim[7]
    with pytest.raises(stride.MisuseError, match="is closed"):
        sim.step(1)
    sim.close()
    assert repr(sim) == "<stride.Simulation, closed>"


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"sett": {"first.u": 1}}, "there is no setting 'sett'"),
        ({"set": {"first.v": 1}}, "first.v"),
        ({"stop": "soon"}, "soon"),
        ({"swap": {"first": "nowhere.fmu"}}, "nowhere.fmu"),
        ({"checkpoint": "nowhere.zip"}, "nowhere.zip"),
        ({"checkpoint": 3}, "checkpoint is a text or a path, not 3"),
        ({"checkpoint": ""}, "checkpoint: an empty name is that of no file"),
        ({"results": 3}, "results is a text or a path, not 3"),
        ({"results": b"out"}, "results is a text or a path, not b'out'"),
        ({"results": ""}, "results: an empty name is that of no file and no folder"),
        ({"out": "out"}, "there is no 'out' here\n  hint: the folder of the results is results="),
        ({"can_save": "x"}, "can_save= is True or False, not 'x'"),
        ({"messages": 2**64}, "messages= is a number of messages"),
    ],
)
def test_wrong_options(folder, options, message):
    with pytest.raises(stride.InputError, match=message):
        stride.Simulation("test.ssd", **options)
    assert [each.name for each in folder.iterdir()] == ["test.ssd"]


def test_a_closed_one_cannot_be_entered(folder):
    with stride.Simulation("test.ssd") as sim:
        pass
    with pytest.raises(stride.MisuseError, match="is closed"), sim:
        pass


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("int8", 128, "Int8"),
        ("int8", 0.5, "Int8"),
        ("uint8", -1, "UInt8"),
        ("int32", True, "Int32"),
        ("boolean", 2, "Boolean"),
        ("float64", "1", "Float64"),
        ("float64", [1.0], "Float64"),
        ("float64", None, "Float64"),
        ("float32", 1e300, "Float32"),
        ("float32", 1e-50, "Float32"),
        ("matrix", [1.0, 2.0], "shape"),
        ("string", b"x", "text"),
        ("words", ["a"], r"an array of text \(str\) with the shape \(2,\), not \['a'\]"),
        ("words", [["a", "b"]], r"with the shape \(2,\)"),
        ("words", "ab", r"with the shape \(2,\)"),
        ("words", 3, r"with the shape \(2,\)"),
        ("blobs", [b"a", b"b", b"c"], r"an array of bytes with the shape \(2,\)"),
        ("blobs", ["a", "b"], "an array of bytes"),
        ("string", "a\0b", "NUL"),
        ("binary", "x", "bytes"),
        ("colour", 3, "3 is none of the items of its type: "),
        ("receive.clock", 1, "clock"),
        ("receive.frame", b"x", "is a message"),
        ("float64.echo", 1, "computed by the unit"),
    ],
)
def test_values_that_are_none_of_a_variable(types, name, value, message):
    with stride.Simulation("types.ssd") as sim:
        with pytest.raises(stride.InputError, match=message) as caught:
            sim[f"types.{name}"] = value
        assert (caught.value.component, caught.value.variable) == ("types", name)


def test_a_message_is_sent_and_not_set(types):
    with stride.Simulation("types.ssd") as sim:
        with pytest.raises(stride.InputError) as caught:
            sim["types.receive.frame"] = b"x"
        assert caught.value.hint == 'send it: sim.send("types.receive.frame", …)'


def test_messages_that_nobody_receives(types):
    with stride.Simulation("types.ssd") as sim:
        with pytest.raises(stride.InputError, match="'types.receive.frame' has two values"):
            sim.send("types.receive.frame", b"x", **{"receive.frame": b"y"})
        for name, value in [("types.float64", 1.0), ("types.send.frame", b"x"), ("types.receive.clock", 3)]:
            with pytest.raises(stride.InputError):
                sim.send(name, value)


@pytest.mark.parametrize("name", ["a\0b", "\ud800"])
def test_texts_that_no_c_text_can_be(types, name):
    with stride.Simulation("types.ssd") as sim:
        with pytest.raises(stride.InputError, match="NUL|UTF-8"):
            sim["types.string"] = name
        with pytest.raises(stride.InputError, match="NUL|UTF-8"):
            sim.intervene("set-at", f"types.string={name}@0.5")
    with pytest.raises(stride.InputError, match="NUL|UTF-8"):
        stride.Simulation("types.ssd", set={"types.string": name})


def test_verdicts_are_there_behind_the_end_only(folder):
    with stride.Simulation("test.ssd", set={"first.u": np.float64(1)}) as sim:
        sim.run()
        with pytest.raises(stride.MisuseError, match="before the run has ended"):
            sim.verdicts
    assert [verdict.passed for verdict in sim.verdicts] == [True, True]


@pytest.mark.parametrize("raised", [TimeoutError, SystemExit])
def test_what_a_handler_of_a_signal_raises_ends_a_step(folder, raised):
    def handle(_number, _frame):
        raise raised

    before = signal.signal(signal.SIGALRM, handle)
    try:
        with stride.Simulation("test.ssd", stop=9e6, step=1e-3) as sim:
            signal.setitimer(signal.ITIMER_REAL, 0.3)
            with pytest.raises(raised):
                sim.run()
            assert sim.end_reason == "interrupted"
        assert signal.getsignal(signal.SIGALRM) is handle
    finally:
        signal.signal(signal.SIGALRM, before)


def test_a_step_cannot_be_closed_by_a_handler(folder):
    seen = []
    sim = stride.Simulation("test.ssd", stop=9e6, step=1e-3)

    def handle(_number, _frame):
        with pytest.raises(stride.MisuseError, match="is in a step"):
            sim.close()
        seen.append("refused")
        raise TimeoutError

    before = signal.signal(signal.SIGALRM, handle)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with pytest.raises(TimeoutError):
            sim.run()
    finally:
        signal.signal(signal.SIGALRM, before)
    assert seen == ["refused"]
    sim.close()


def test_one_with_isolated_units_is_opened_beside_threads(folder):
    results = {}

    def simulate(key, isolate):
        with stride.Simulation("test.ssd", set={"first.u": 1}, isolate=isolate) as sim:
            sim.run()
            results[key] = sim["second.y"]

    threads = [threading.Thread(target=simulate, args=(i, i % 2 == 1)) for i in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=120)
    assert len(results) == 8 and len(set(results.values())) == 1


def test_a_unit_that_fails(folder):
    (folder / "failing.ssd").write_text(scenario("thrower=thrower"))
    with stride.Simulation("failing.ssd", set={"thrower.throw_at": 0.5}) as sim:
        with pytest.raises(stride.RunError, match="the fuse has blown") as caught:
            sim.run()
        assert caught.value.component == "thrower"
        assert caught.value.time == pytest.approx(0.375)
        assert sim.end_reason == "failed"
        with pytest.raises(stride.MisuseError, match="has failed"):
            sim.step(0.1)


def test_a_unit_that_crashes_in_a_process_of_its_own(folder):
    (folder / "failing.ssd").write_text(scenario("faulty=faulty"))
    crash = {"faulty.fault": "segfault", "faulty.call": "step"}
    with stride.Simulation("failing.ssd", isolate=True, set=crash) as sim:
        with pytest.raises(stride.RunError, match="SIGSEGV"):
            sim.run()


# ---- Living together ----


def _open_files():
    return len(os.listdir("/proc/self/fd"))


def _memory():
    with open("/proc/self/statm") as numbers:
        return int(numbers.read().split()[1]) * os.sysconf("SC_PAGESIZE")


@pytest.mark.parametrize("isolate", [False, True])
def test_a_hundred_simulations_leave_nothing(folder, isolate):
    def simulate():
        with stride.Simulation("test.ssd", isolate=isolate, results="out") as sim:
            sim.step(until=0.5)
            return sim["first.y"]

    for _ in range(20):
        simulate()
    gc.collect()
    files, memory = _open_files(), _memory()
    for _ in range(80):
        simulate()
    gc.collect()
    assert _open_files() == files
    assert _memory() - memory < 8 << 20
    assert processes_below() == set()


def test_a_library_that_cannot_be_unloaded_is_loaded_once(folder):
    def libraries():
        with open("/proc/self/maps") as maps:
            return {line.split()[-1] for line in maps if "/registrar.so" in line}

    (folder / "registrar.ssd").write_text(scenario("unit=registrar"), encoding="utf-8")
    for _ in range(5):
        with stride.Simulation("registrar.ssd") as sim:
            sim.run()
            assert sim["unit.listeners"] == 1
    assert len(libraries()) == 1


def test_one_that_is_forgotten_is_closed(folder):
    files = _open_files()
    sim = stride.Simulation("test.ssd", isolate=True)
    assert processes_below()
    del sim
    assert processes_below() == set()
    assert _open_files() == files


def test_two_at_once_and_in_threads(folder):
    one = stride.Simulation("test.ssd", set={"first.u": 1})
    other = stride.Simulation("test.ssd", set={"first.u": 2})
    for until in (0.25, 0.5):
        one.step(until=until)
        other.step(until=until)
    threads = [threading.Thread(target=sim.run) for sim in (one, other)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert other["second.y"] == pytest.approx(2 * one["second.y"])
    one.close()
    other.close()


def _in_fork(sim, answer):
    try:
        sim.step(0.1)
    except stride.MisuseError as error:
        answer.put(str(error))


def test_a_fork_is_refused(folder):
    context = multiprocessing.get_context("fork")
    answer = context.Queue()
    with stride.Simulation("test.ssd") as sim:
        child = context.Process(target=_in_fork, args=(sim, answer))
        child.start()
        assert "fork" in answer.get(timeout=30)
        child.join()
        sim.run()


def test_it_cannot_be_copied(folder):
    with stride.Simulation("test.ssd") as sim:
        for copied in (copy.copy, copy.deepcopy, pickle.dumps):
            with pytest.raises(TypeError, match="cannot be copied"):
                copied(sim)


def test_results_that_cannot_be_written_are_an_error_of_the_end(folder):
    with pytest.raises(stride.RunError, match="signals.csv"):
        with stride.Simulation("test.ssd", results="out") as sim:
            sim.step(0.5)
            (folder / "out" / "signals.csv").unlink()
            (folder / "out" / "signals.csv").mkdir()
            (folder / "out" / "run.json").unlink()
            (folder / "out" / "run.json").mkdir()


def test_nan_is_a_value_as_it_is_for_the_program(types):
    with stride.Simulation("types.ssd") as sim:
        sim["types.float64"] = math.nan
        assert math.isnan(sim["types.float64"])


def test_handlers_of_the_caller_are_not_taken_for_those_of_units(folder, caplog):
    with stride.Simulation("test.ssd") as sim:
        before = signal.signal(signal.SIGUSR1, lambda *_: None)
        sim.run()
    signal.signal(signal.SIGUSR1, before)
    assert [record.message for record in caplog.records] == []


def _mapped(library):
    with open("/proc/self/maps") as maps:
        return sum(library in line for line in maps)


def test_the_libraries_of_units_go_with_them(folder):
    with stride.Simulation("box_drop", stop=0.1) as sim:
        sim.run()
        assert _mapped("mujoco_world.so") > 0
    assert _mapped("mujoco_world.so") == 0


_DAEMON = """
import stride, threading, time
sim = stride.Simulation("test.ssd", stop=9e6, step=1e-3)
threading.Thread(target=sim.run, daemon=True).start()
while sim.time == 0:
    time.sleep(0.01)
print("ends", flush=True)
"""


def test_a_step_of_a_daemon_thread_ends_with_python(folder):
    ended = subprocess.run([sys.executable, "-c", _DAEMON], capture_output=True, text=True, timeout=120)
    assert (ended.returncode, ended.stdout) == (0, "ends\n"), ended.stderr


_ENDLESS = """
import stride, sys
with stride.Simulation("test.ssd", stop=9e6, step=1e-3, results="out") as sim:
    print("begun", flush=True)
    try:
        sim.run()
    except KeyboardInterrupt:
        print(sim.end_reason, sim.time > 0, flush=True)
        raise
"""


def test_ctrl_c_ends_it_in_order(folder):
    process = subprocess.Popen(
        [sys.executable, "-c", _ENDLESS], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "begun\n"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert out == "interrupted True\n"
    assert "KeyboardInterrupt" in err
    assert stride.Run("out").info["outcome"] == "interrupted"


def test_an_enumeration_is_set_by_number_or_name(types):
    with stride.Simulation("types.ssd") as sim:
        for value, number in [(4, 4), ("green", 2), ("blue", 4)]:
            sim.step(0.1)
            sim["types.colour"] = value
            assert sim["types.colour"] == number
        with pytest.raises(stride.InputError) as caught:
            sim["types.colour"] = "blau"
        text = "'types.colour': 'blau' is not a value for it, expected one of red (1), green (2), blue (4)"
        assert (str(caught.value), caught.value.file) == (text, None)
        assert (caught.value.component, caught.value.variable) == ("types", "colour")
        with pytest.raises(stride.InputError, match="a text has no NUL"):
            sim["types.colour"] = "a\0"


def test_a_unit_alone_takes_the_names_of_its_variables(folder):
    with stride.Simulation("minimal.fmu", stop=1, set={"u": 1}, signals=["y"]) as sim:
        sim["u"] = 2
        sim.step(until=0.5)
        assert sim["y"] == sim["minimal.y"] > 0
        assert sim["u"] == 2
        with pytest.raises(stride.InputError, match="did you mean 'minimal.time_constant'"):
            sim["tim_constant"]
