"""stride.run, what it returns, and stride.campaign."""

import gc
import importlib.util
import json
import os
import pathlib
import pickle
import shutil
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import stride
from conftest import CHECKS, processes_below, scenario


def test_a_run(folder):
    run = stride.run("test.ssd", set={"first.u": 1})
    assert run.passed and run.check() is run
    assert run.time[-1] == run.reached == 1
    assert run.signals["first.y"][-1] == pytest.approx(1 - np.exp(-1))
    assert run.signals["first.y"].dtype == np.float64
    with pytest.raises(ValueError, match="read-only"):
        run.signals["first.y"][0] = 1
    assert [verdict.name for verdict in run.verdicts][0] == "it does not overshoot"
    assert run.verdicts[0].margin == 0
    assert "first.y" in run.summary
    assert "passed" in repr(run)
    folder_of_it = run.folder
    del run
    assert not folder_of_it.exists()


def test_signals_outlive_their_run(folder):
    signals = stride.run("test.ssd", set={"first.u": 1}).signals
    assert signals["first.y"][-1] == pytest.approx(1 - np.exp(-1))


def test_results_belong_to_the_process_that_has_made_them(folder):
    run = stride.run("test.ssd", set={"first.u": 1})
    child = os.fork()
    if child == 0:
        del run
        gc.collect()
        os._exit(0)
    os.waitpid(child, 0)
    assert run.folder.is_dir()
    with pytest.raises(TypeError, match="name a folder, out="):
        pickle.dumps(run)
    kept = stride.run("test.ssd", set={"first.u": 1}, out="kept")
    assert pickle.loads(pickle.dumps(kept)).signals["first.y"][-1] == run.signals["first.y"][-1]


def test_signals_of_a_run_that_was_ended_at_once(folder):
    run = stride.run("test.ssd", set={"first.u": 1}, out="out")
    (folder / "out" / "signals.csv").write_text("")
    with pytest.raises(stride.InputError, match="is empty"):
        run.time


@pytest.mark.parametrize(
    ("value", "message"),
    [(["a b", "c"], "with blanks"), (["a", ""], "without a character"), (None, "None is no value")],
)
def test_values_that_no_option_can_have(folder, value, message):
    with pytest.raises(stride.InputError, match=message):
        stride.run("test.ssd", set={"first.u": value})


@pytest.mark.skipif(shutil.which("setpriv") is None, reason="there is no setpriv")
def test_it_ends_when_python_is_killed(folder):
    endless = "import stride; stride.run('test.ssd', stop=9e6, step=1e-3, out='out')"
    process = subprocess.Popen([sys.executable, "-c", endless])
    file = folder / "out" / "run.json"
    deadline = time.monotonic() + 60
    while not file.exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    process.kill()
    process.wait()
    while json.loads(file.read_text())["outcome"] == "running" and time.monotonic() < deadline:
        time.sleep(0.05)
    assert json.loads(file.read_text())["outcome"] == "interrupted"


def test_a_check_that_fails_is_no_exception(folder):
    run = stride.run("test.ssd", out="out")
    assert not run.passed
    assert [verdict.passed for verdict in run.verdicts] == [True, False]
    with pytest.raises(AssertionError, match="second.y eventually"):
        run.check()
    assert run.folder == folder / "out"


def test_signals_of_each_type(types):
    run = stride.run("types.ssd", signals=["types.*.echo"], set={"types.string": 'a, "b"', "types.binary": b"\x01\xff"})
    assert run.signals["types.string.echo"][-1] == 'a, "b"'
    assert run.signals["types.binary.echo"][-1] == b"\x01\xff"
    assert run.signals["types.boolean.echo"].dtype == bool
    assert run.signals["types.uint64.echo"].dtype == np.uint64
    assert run.signals["types.colour.echo"][-1] in (1, "red")
    assert run.units["types.float64.echo"] in ("m", "")
    with pytest.raises(KeyError, match="no signal 'x' was recorded"):
        run.signals["x"]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: stride.run("test.ssd", help=True), "'help' is an option for a command line"),
        (lambda: stride.compare("a", "b", version=True), "'version' is an option for a command line"),
        (lambda: stride.compare("a", "b", json="c.json"), "'json' is an option for a command line"),
        (lambda: stride.run("test.ssd", progress="plain"), "'progress' is an option for a command line"),
        (lambda: stride.run("test.ssd", set={"a\0": 1}), "a name: a text has no NUL"),
        (lambda: stride.run("test.ssd", **{"x\0": 1}), "an option: a text has no NUL"),
        (lambda: stride.run("test.ssd", out="a\0"), "out: a text has no NUL"),
        (lambda: stride.run("test.ssd", out=3), "out is a text or a path, not 3"),
        (lambda: stride.run("test.ssd", out=""), "out: an empty name is that of no file and no folder"),
        (lambda: stride.run("test.ssd", parameters=b"p.ssv"), "an option is a text or a path, not b'p.ssv'"),
        (lambda: stride.run("test.ssd", swap={"first": b"a.fmu"}), "an option is a text or a path, not b'a.fmu'"),
        (lambda: stride.run("test.ssd", results="x"), "there is no 'results' here\n  hint: .* is out="),
        (lambda: stride.run(""), "the scenario: an empty name"),
        (lambda: stride.campaign("c.xosc", out=""), "out: an empty name"),
        (lambda: stride.campaign("."), r"there is no plan in this folder\n  hint: name the file of the campaign"),
        (lambda: stride.Run(""), "a folder of results: an empty name"),
        (lambda: stride.Campaign(""), "a folder of a campaign: an empty name"),
        (lambda: stride.compare("", "b"), "a folder of results: an empty name"),
        (lambda: stride.Simulation(3), "the scenario is a text or a path, not 3"),
        (lambda: stride.Simulation(b"test.ssd"), "the scenario is a text or a path, not b'test.ssd'"),
        (lambda: stride.Simulation("test.ssd", can_save=True).save(3), "the checkpoint is a text or a path, not 3"),
        (lambda: stride.export_mcap(3, "x.mcap"), "a folder of results is a text or a path, not 3"),
        (lambda: stride.compare("--help", "b"), "./--help: this is not a folder"),
        (lambda: stride.compare("a", None), "a folder of results is a text or a path, not None"),
        (lambda: stride.campaign("--help"), "./--help: the file does not exist"),
        (lambda: stride.Run("a\0"), "a folder of results: a text has no NUL"),
        (lambda: stride.campaign("c.xosc", case=1), "'case' runs cases without making the table"),
        (lambda: stride.run("a\0b"), "the scenario: a text has no NUL"),
        (lambda: stride.run("test.ssd", set={"first.u": "a\0"}), "a value: a text has no NUL"),
        (lambda: stride.run(b"test.ssd"), "the scenario is a text or a path, not b'test.ssd'"),
        (lambda: stride.run(3), "the scenario is a text or a path, not 3"),
        (lambda: stride.Simulation("test.ssd").intervene("force", None), "an intervention is a text, not None"),
    ],
)
def test_arguments_that_make_no_sense(folder, call, message):
    with pytest.raises(stride.InputError, match=message):
        call()


def test_a_file_and_a_date_for_another_tool(folder):
    pytest.importorskip("mcap")
    run = stride.run("test.ssd")
    with pytest.raises(stride.InputError, match="the MCAP file is a text or a path, not 3"):
        run.to_mcap(3)
    with pytest.raises(stride.InputError, match="3 is no date\n  hint: epoch is 'run' or a date"):
        run.to_mcap("x.mcap", epoch=3)


def test_runs_are_compared(folder):
    a = stride.run("test.ssd", set={"first.u": 1})
    assert stride.compare(a, a)
    b = stride.run("test.ssd", out="b", set={"first.u": 1, "second.time_constant": 0.5})
    comparison = stride.compare(a, "b", only=["second.y"])
    assert not comparison and not comparison.equal
    assert (comparison.first.kind, comparison.first.name) == ("signal", "second.y")
    difference = next(each for each in comparison.differences if each.kind == "signal")
    greatest = np.abs(a.signals["second.y"] - b.signals["second.y"]).max()
    assert difference.absolute.value == greatest
    assert [(each.kind, each.name, each.b) for each in comparison.inputs] == [
        ("option", "--set", "second.time_constant=0.5")
    ]
    assert comparison.summary.startswith("differ first at t = ")
    assert stride.compare(a, "b", tolerance={"second.y": 1})
    assert stride.compare(a, a).first is None


def test_what_cannot_be_compared(folder):
    with pytest.raises(stride.InputError, match="this is not a folder"):
        stride.compare("x", "y")


def test_pandas(folder):
    pandas = pytest.importorskip("pandas")
    table = stride.run("test.ssd", set={"first.u": 1}).to_pandas()
    assert isinstance(table, pandas.DataFrame)
    assert table["first.y"].iloc[-1] == pytest.approx(1 - np.exp(-1))
    assert table.index.name == "time"


def test_messages(folder):
    (folder / "ticking.ssd").write_text(
        scenario(
            "ticker=ticker listener=listener",
            "ticker.tick.clock>listener.message.clock ticker.tick.number>listener.message.number"
            " ticker.tick.picoseconds>listener.message.picoseconds",
        )
    )
    run = stride.run("ticking.ssd", set={"ticker.period": 0.2})
    sent = [message for message in run.events if message.variable == "ticker.tick.number" and not message.received]
    assert [message.value for message in sent] == ["1", "2", "3"]
    assert sent[0].time == pytest.approx(0.2 * 2**0.5)


def test_the_report(folder):
    run = stride.run("test.ssd")
    try:
        page = run.report()
    except stride.InputError:
        pytest.skip("this build makes no reports")
    assert page.read_text().lstrip().lower().startswith("<!doctype html")
    assert "<iframe" in run._repr_html_()


@pytest.mark.parametrize(
    ("scenario_name", "options", "message"),
    [
        ("nowhere.ssd", {}, "nowhere.ssd"),
        ("test.ssd", {"set": {"first.v": 1}}, "first.v"),
        ("test.ssd", {"sett": 1}, "sett"),
        ("test.ssd", {"swap": {"first": "nowhere.fmu"}}, "nowhere.fmu"),
    ],
)
def test_mistakes(folder, scenario_name, options, message):
    with pytest.raises(stride.InputError, match=message):
        stride.run(scenario_name, **options)


def test_an_error_has_its_parts(folder):
    (folder / "test.ssd").write_text(scenario("first=minimal second=minimal", "first.y>second.uu", CHECKS))
    with pytest.raises(stride.InputError) as caught:
        stride.run("test.ssd")
    error = caught.value
    assert error.file.endswith("test.ssd") and error.line > 1
    assert error.component == "second"
    assert error.hint


_KILLED = """
import os, stride
sim = stride.Simulation("test.ssd", set={"first.u": 1}, results="out")
sim.step(0.5)
os.kill(os.getpid(), 9)
"""


def test_a_run_that_was_killed_has_not_passed(folder):
    subprocess.run([sys.executable, "-c", _KILLED])
    run = stride.Run("out")
    assert not run.passed and "failed" in repr(run)
    with pytest.raises(AssertionError, match="it is running"):
        run.check()


@pytest.mark.parametrize("text", ['{"outcome": ', "[]", '{"outcome": 1}', '"\udcff"', "[" * 100000])
def test_an_account_that_is_not_whole_is_an_error(folder, text):
    (folder / "out").mkdir()
    (folder / "out" / "run.json").write_text(text, errors="surrogateescape")
    with pytest.raises(stride.InputError, match=r"run.json(:1)?: the account is not whole") as caught:
        stride.Run("out")
    assert "stride report" in caught.value.hint and caught.value.hint in str(caught.value)


def test_a_folder_without_an_account(folder):
    with pytest.raises(stride.InputError, match="there is no such folder") as caught:
        stride.Run("nowhere")
    assert caught.value.hint is None
    (folder / "out").mkdir()
    with pytest.raises(stride.InputError, match=r"there is no run.json\n  hint: 'stride report .*out' shows"):
        stride.Run("out")


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (lambda info: info["checks"][0].pop("passed"), "an entry of 'checks' lacks 'passed'"),
        (lambda info: info["checks"][0].update(margin=3), "an entry of 'checks' lacks 'margin'"),
        (lambda info: info.update(verdicts=["good"]), "an entry of 'verdicts' is none"),
        (lambda info: info.update(reached="soon"), "there is no 'reached'"),
        (lambda info: info["files"].update(events=3), "'events' of its files is none"),
        (lambda info: info["signals"][0].update(type="Float16"), "a signal has the type 'Float16'"),
    ],
)
def test_members_of_an_account_that_no_run_writes(folder, edit, message):
    info = stride.run("test.ssd", out="out").info
    edit(info)
    (folder / "out" / "run.json").write_text(json.dumps(info))
    with pytest.raises(stride.InputError, match=message):
        stride.Run("out")


def damaged(folder, edit, name="signals.csv"):
    """A run whose file was changed as a text."""
    stride.run("test.ssd", out="out")
    file = folder / "out" / name
    file.write_text(edit(file.read_text()))
    return stride.Run("out")


@pytest.mark.parametrize("cut", [1, 2, 4])
def test_a_last_row_that_was_cut_off_is_left_out(folder, caplog, cut):
    whole = stride.run("test.ssd")
    run = damaged(folder, lambda text: text[:-cut])
    assert list(run.time) == list(whole.time)[:-1]
    assert list(run.signals["second.y"]) == list(whole.signals["second.y"])[:-1]
    assert "its last line is cut off" in caplog.text


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (lambda text: text + "\n", r"signals.csv:\d+: there are 0 fields"),
        (lambda text: text[text.index("\n") + 1 :], "signals.csv:1: its columns are"),
        (lambda text: text.replace("\n", ",1\n", 3), "signals.csv:1: its columns are"),
        (lambda text: text.replace("\n0.5,", "\n0.5x,"), r"signals.csv:\d+: '0.5x' is no value of 'time'"),
        (lambda text: text.replace("\n0.5,", "\n0.1,"), "signals.csv:6: the time goes back, or is none: '0.1'"),
        (lambda text: text.replace("\n0.5,", "\nnan,"), "signals.csv:6: the time goes back, or is none: 'nan'"),
        (lambda text: text.replace("first.y,second.y", "second.y,first.y"), "signals.csv:1: its columns are time, second"),
        (lambda text: text[:12], "signals.csv is empty"),
    ],
)
def test_rows_that_no_run_writes_are_errors(folder, edit, message):
    run = damaged(folder, edit)
    with pytest.raises(stride.InputError, match=message):
        run.signals["second.y"]
    with pytest.raises(stride.InputError, match=message):
        run.time  # noqa: B018


@pytest.mark.parametrize("row", ["soon,0,a,b,sent,,", "nan,0,a,b,sent,,", "1,0,a,b,thrown,,", "1,-1.5,a,b,received,,"])
def test_messages_that_no_run_writes_are_errors(types, row):
    stride.run("types.ssd", out="out")
    file = pathlib.Path("out", "events.csv")
    file.write_text(file.read_text() + f"{row}\n")
    with pytest.raises(stride.InputError, match=r"events.csv:\d+: a value is wrong"):
        stride.Run("out").events  # noqa: B018


_NO_SPACE = """
import resource, stride
resource.setrlimit(resource.RLIMIT_FSIZE, (1, 1))
try:
    stride.run("test.ssd", out="out")
except stride.RunError as error:
    print(error.run, "File too large" in str(error))
"""


def test_a_run_whose_account_cannot_be_written_says_so(folder):
    done = subprocess.run([sys.executable, "-c", _NO_SPACE], capture_output=True, text=True)
    assert done.stdout == "None True\n", done.stdout + done.stderr


def test_options_may_be_numbers_of_numpy(folder):
    run = stride.run("test.ssd", set={"first.time_constant": np.linspace(0.1, 0.3, 2)[0]}, stop=np.float64(0.5))
    assert run.reached == 0.5


def test_a_run_that_fails_has_what_was_recorded(folder):
    (folder / "failing.ssd").write_text(scenario("thrower=thrower filter=minimal"))
    with pytest.raises(stride.RunError, match="the fuse has blown") as caught:
        stride.run("failing.ssd", set={"thrower.throw_at": 0.5})
    error = caught.value
    assert error.component == "thrower"
    assert error.run.reached == pytest.approx(0.375)
    assert len(error.run.signals["filter.y"]) == 4
    assert not error.run.passed


def test_a_unit_that_crashes_does_not_take_python_with_it(folder):
    (folder / "failing.ssd").write_text(scenario("faulty=faulty"))
    with pytest.raises(stride.RunError, match="SIGSEGV"):
        stride.run("failing.ssd", set={"faulty.fault": "segfault", "faulty.call": "step"})


_ENDLESS = """
import stride
print("begun", flush=True)
stride.run("test.ssd", stop=9e6, step=1e-3, out="out")
"""


def test_ctrl_c_ends_it_in_order(folder):
    process = subprocess.Popen(
        [sys.executable, "-c", _ENDLESS], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "begun\n"
    while not (folder / "out" / "signals.csv").exists():
        time.sleep(0.05)
    time.sleep(0.3)
    process.send_signal(signal.SIGINT)
    _, messages = process.communicate(timeout=60)
    assert "KeyboardInterrupt" in messages
    assert processes_below() == set()
    assert stride.Run("out").info["outcome"] == "interrupted"


_STUCK = """
import stride
stride.run("stuck.ssd", out="out")
"""


def test_a_second_ctrl_c_ends_a_run_whose_unit_does_not(folder):
    (folder / "stuck.ssd").write_text(scenario("unit=lying_hangs_in_step"))
    process = subprocess.Popen([sys.executable, "-c", _STUCK], stderr=subprocess.PIPE, text=True)
    while not (folder / "out" / "signals.csv").exists():
        time.sleep(0.05)
    for _ in range(2):
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
    _, messages = process.communicate(timeout=30)
    assert "KeyboardInterrupt" in messages
    assert processes_below() == set()


_CAMPAIGN = """<?xml version="1.0" encoding="UTF-8"?>
<OpenSCENARIO>
  <FileHeader revMajor="1" revMinor="1" date="2026-01-01T00:00:00" author="a test" description="inputs"/>
  <ParameterValueDistribution>
    <ScenarioFile filepath="test.ssd"/>
    <Deterministic>
      <DeterministicSingleParameterDistribution parameterName="first.u">
        <DistributionSet><Element value="0"/><Element value="1"/><Element value="1.5"/></DistributionSet>
      </DeterministicSingleParameterDistribution>
    </Deterministic>
  </ParameterValueDistribution>
  <stride:Campaign xmlns:stride="urn:org.stride:campaign:1">
    <stride:Aggregate name="end" signal="second.y" function="final"/>
  </stride:Campaign>
</OpenSCENARIO>
"""


@pytest.fixture
def campaign(folder):
    (folder / "inputs.xosc").write_text(_CAMPAIGN)
    return folder / "inputs.xosc"


def test_a_campaign(campaign):
    table = stride.campaign(campaign, jobs=1)
    assert len(table) == 3
    assert list(table["first.u"]) == [0, 1, 1.5]
    assert list(table["outcome"]) == ["failed", "passed", "passed"]
    assert [str(seed) for seed in table["seed"]] == [row["seed"] for row in table.rows]
    assert table["aggregate:end"][2] == pytest.approx(1.5 * table["aggregate:end"][1])
    assert not table.passed
    assert "2 of 3 cases passed" in repr(table)
    assert list(stride.campaign(campaign)["outcome"]) == list(table["outcome"])
    again = stride.campaign(table.folder)
    assert (again.folder, again.rows) == (table.folder, table.rows)


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (lambda text: text + "3\n", r"cases.csv:5: there are 1 fields"),
        (lambda text: "", "cases.csv:1: there is no column case, seed or outcome"),
        (lambda text: text.replace("\n1,", "\nx,"), "cases.csv: column 'case': "),
    ],
)
def test_a_table_of_cases_that_no_campaign_writes(campaign, edit, message):
    file = stride.campaign(campaign).folder / "cases.csv"
    file.write_text(edit(file.read_text()))
    with pytest.raises(stride.InputError, match=message):
        stride.Campaign(file.parent)["case"]


def test_what_is_in_a_campaign(campaign):
    table = stride.campaign(campaign)
    assert "first.u" in table and "x" not in table and 3 not in table
    assert [row["first.u"] for row in table] == ["0", "1", "1.5"]


def test_a_campaign_in_pandas(campaign):
    pytest.importorskip("pandas")
    table = stride.campaign(campaign).to_pandas()
    assert table.loc[1, "outcome"] == "passed"


def test_a_campaign_that_is_wrong(campaign):
    campaign.write_text(_CAMPAIGN.replace("first.u", "first.v"))
    with pytest.raises(stride.InputError, match="has no such variable"):
        stride.campaign(campaign)
    with pytest.raises(stride.InputError, match="nowhere.xosc"):
        stride.campaign("nowhere.xosc")


def package_at(folder):
    """The module that finds the program, of a copy of the package in this folder."""
    folder.mkdir(parents=True)
    source = pathlib.Path(stride.__file__).with_name("_installed.py")
    spec = importlib.util.spec_from_file_location("installed_elsewhere", shutil.copy(source, folder))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def program_at(prefix):
    program = prefix / "bin/stride"
    program.parent.mkdir(parents=True)
    program.write_bytes(b"\x7fELF")
    program.chmod(0o755)
    return program


def test_the_program_of_an_installation_is_found_around_its_package(tmp_path, monkeypatch):
    monkeypatch.delenv("STRIDE_PREFIX")
    monkeypatch.setenv("PATH", "/nowhere")
    installed = package_at(tmp_path / "share/stride/python/stride")
    with pytest.raises(FileNotFoundError, match="set STRIDE_PREFIX to the folder that stride is installed"):
        installed.program()
    program = program_at(tmp_path)
    assert installed.program() == program


def test_the_program_in_the_path_is_found_from_a_checkout(tmp_path, monkeypatch):
    monkeypatch.delenv("STRIDE_PREFIX")
    program = program_at(tmp_path / "installed")
    monkeypatch.setenv("PATH", str(program.parent))
    assert package_at(tmp_path / "checkout/python/stride").program() == program
    program.write_text("#!/usr/bin/python3\n")  # as a wheel has it, which calls the package
    with pytest.raises(FileNotFoundError):
        package_at(tmp_path / "other/python/stride").program()
