"""Units in Python: what they can do, and what is said of mistakes."""

import os
import re
import signal
import subprocess
import sys
import textwrap
import time
import zipfile

import numpy as np
import pytest
import stride
import stride.unit as su
from conftest import scenario

THERMOSTAT = """
    class Thermostat(su.Unit):
        '''Heats a room.

        Not a cellar.'''
        temperature = su.Input(float, unit="degC", start=15.0, description="of the room")
        power = su.Output(float, unit="W")
        gain = su.Parameter(2.0, unit="W/K", min=0)

        def step(self, now, end):
            self.power = self.gain * (20 - self.temperature)
"""


@pytest.fixture
def units(tmp_path, monkeypatch):
    """A working folder for units; packs them as their users do."""
    monkeypatch.chdir(tmp_path)

    class Folder:
        path = tmp_path

        @staticmethod
        def write(source, name="u"):
            (tmp_path / f"{name}.py").write_text(
                "import stride.unit as su\n" + textwrap.dedent(source), encoding="utf-8"
            )

        def pack(self, source, *options, name="u"):
            """Returns what is printed."""
            self.write(source, name)
            command = ["-m", "stride.unit", f"{name}.py", "-o", f"{name}.fmu", "--python", sys.executable, *options]
            done = subprocess.run([sys.executable, *command], capture_output=True, text=True, check=False)
            assert done.returncode == (0 if (tmp_path / f"{name}.fmu").exists() else 2)
            return done.stdout + done.stderr

        def run(self, source, *options, **settings):
            assert self.pack(source, *options) == ""
            return stride.run("u.fmu", **{"stop": 0.5, "step": 0.125, **settings})

    return Folder()


def last(run, name):
    return run.signals[name][-1]


def describe(fmu):
    with zipfile.ZipFile(fmu) as archive:
        return archive.read("modelDescription.xml").decode()


# ---- What they can do ----


def test_a_float32_that_decays_to_zero(units):
    run = units.run(
        """
        class U(su.Unit):
            y = su.Output("Float32", start=1e-30)

            def step(self, now, end):
                self.y = self.y * 1e-6
        """
    )
    assert list(run.signals["u.y"]) == [np.float32(1e-30), np.float32(1e-36), np.float32(1e-42), 0, 0]


def test_a_unit_with_inputs_outputs_and_parameters(units):
    run = units.run(THERMOSTAT, set={"u.gain": 3, "u.temperature": 16})
    assert run.signals["u.power"][-1] == 12
    assert run.units["u.power"] == "W"
    text = describe("u.fmu")
    assert 'description="Heats a room."' in text
    assert re.search(r'name="gain"[^>]* min="0"', text)
    with zipfile.ZipFile("u.fmu") as archive:
        assert str(units.path).encode() not in archive.read("resources/process.xml")
    before = (units.path / "u.fmu").read_bytes()
    units.pack(THERMOSTAT)
    assert (units.path / "u.fmu").read_bytes() == before
    # the file needs neither the class's file nor the package
    (units.path / "u.py").unlink()
    assert last(stride.run("u.fmu", stop=0.5), "u.power") == 10


MEASURES = """
    class Plant(su.Unit, units_of_measure={"furlong": (201.168, "m"), "oven": (10, "degC", 50)}):
        speed = su.Output(20.0, unit="m/s")
        torque = su.Output(2.0, unit="kN.m")
        way = su.Output(3.0, unit="furlong")
        heat = su.Output(25.0, unit="oven")
        rise = su.Output(10.0, unit="degC", relative=True)

        def step(self, now, end):
            pass

    class Gauge(su.Unit):
        speed = su.Input(0.0, unit="km/h")
        torque = su.Input(0.0, unit="Nm")
        way = su.Input(0.0, unit="ft")
        heat = su.Input(0.0, unit="degF")
        rise = su.Input(0.0, unit="degF", relative=True)
        bare = su.Input(5.0)

        def step(self, now, end):
            pass
"""


def test_units_of_measure_that_nothing_defines_or_that_are_redefined(units):
    said = units.pack("""
        class Cart(su.Unit, units_of_measure={"furlong": (201.168, "m"), "mile": (1609.344, "m"), "kn": (2, "m/s")}):
            pace = su.Output(1.0, unit="furlong/h")
            way = su.Output(1.0, unit="mile")
            wind = su.Output(1.0, unit="kn")
            load = su.Output(1.0, unit="sack")

            def step(self, now, end):
                pass
    """)
    assert "nothing defines 'sack', the unit of measure of 'load'" in said
    assert "the unit of measure 'kn' of 'wind' has a definition of its own" in said
    assert said.count("warning") == 2


def test_units_of_measure_that_people_use_and_that_a_unit_defines(units):
    assert units.pack(MEASURES, "--class", "Plant", name="plant") == ""
    assert units.pack(MEASURES, "--class", "Gauge", name="gauge") == ""
    names = ("speed", "torque", "way", "heat", "rise")
    text = scenario("plant=plant gauge=gauge", " ".join(f"plant.{name}>gauge.{name}" for name in names))
    connector = '<ssd:Connector name="bare" kind="input"><ssc:Real unit="psi"/></ssd:Connector>'
    text = text.replace(
        'source="gauge.fmu"/>', f'source="gauge.fmu"><ssd:Connectors>{connector}</ssd:Connectors></ssd:Component>'
    )
    (units.path / "s.ssd").write_text(text, encoding="utf-8")
    run = stride.run("s.ssd", stop=0.25, step=0.125, signals=["*"])
    values = {name: last(run, f"gauge.{name}") for name in names}
    assert values["speed"] == 72
    assert values["torque"] == 2000
    assert values["way"] == 3 * 660
    assert values["heat"] == pytest.approx(572)
    assert values["rise"] == 18
    assert run.units["gauge.bare"] == "psi"


def test_it_needs_no_package_and_no_numpy(units, monkeypatch):
    source = (
        THERMOSTAT
        + "        def finish(self):\n            import sys\n            assert not {'numpy', 'ctypes', 'typing'} & {*sys.modules}\n"
    )
    assert units.pack(source) == ""
    monkeypatch.delenv("PYTHONPATH")
    (units.path / "bare.sh").write_text(f'#!/bin/sh\nexec {sys.executable} -I -S "$@"\n')
    (units.path / "bare.sh").chmod(0o755)
    run = stride.run("u.fmu", stop=0.5, set={"u.process.program": "./bare.sh"})
    assert run.signals["u.power"][-1] == 10


def test_the_class_is_python_which_needs_no_stride_for_its_tests():
    class Sum(su.Unit):
        u = su.Input(float)
        y = su.Output(1.0)
        done = su.MessageOutput(str)

        def step(self, now, end):
            self.y += self.u * (end - now)
            self.done.send("yes")

    unit = Sum()
    unit.u = 2.0
    unit.step(0.0, 0.25)
    assert unit.y == 1.5
    assert Sum().y == 1


ECHO = """
    import numpy as np
    class Echo(su.Unit):
        {variables}
        def start(self):
            self.event(self.now)
        def event(self, now):
            for name in list(vars(type(self))):
                if name.endswith("_echo"):
                    setattr(self, name, getattr(self, name[:-5]))
        def step(self, now, end):
            self.event(now)
"""


@pytest.mark.parametrize(
    "type_, fmi, value, seen",
    [
        ("float", "Float64", 0.1, 0.1),
        ("'Float32'", "Float32", 0.1, np.float32(0.1)),
        ("int", "Int64", -(2**63), -(2**63)),
        ("np.uint8", "UInt8", 255, 255),
        ("bool", "Boolean", True, True),
        ("str", "String", "a <b> & \"c\" 'd'\tß", "a <b> & \"c\" 'd'\tß"),
        ("bytes", "Binary", b"\x00\xff", b"\x00\xff"),
    ],
)
def test_values_of_each_type(units, type_, fmi, value, seen):
    run = units.run(ECHO.format(variables=f"u = su.Input({type_}); u_echo = su.Output({type_})"), set={"u.u": value})
    assert run.signals["u.u_echo"][-1] == seen
    assert f'<{fmi} name="u_echo"' in describe("u.fmu")


@pytest.mark.parametrize(
    "variable, value",
    [
        ("float, shape=3", [0.1, -0.0, 2e300]),
        ("np.float32, shape=(2, 2)", [[0.5, 1], [2, 4]]),
        ("np.int16, shape=2", [-32768, 32767]),
        ("bool, shape=2", [True, False]),
    ],
)
def test_arrays_of_numpy(units, variable, value):
    assert units.pack(ECHO.format(variables=f"u = su.Input({variable}); u_echo = su.Output({variable})")) == ""
    with stride.Simulation("u.fmu", stop=1) as sim:
        sim["u.u"] = np.array(value)
        sim.step(0.01)
        assert (sim["u.u_echo"] == value).all()


def test_arrays_start_where_they_are_said_to(units):
    source = """
        class Pose(su.Unit):
            offset = su.Parameter([1.0, 2.0])
            pose = su.Output([[0.0, 0.5], [1.0, 1.5]])
            def step(self, now, end):
                self.pose[1] += self.offset  # in place
    """
    assert units.pack(source) == ""
    with stride.Simulation("u.fmu", stop=1) as sim:
        assert sim["u.pose"].tolist() == [[0, 0.5], [1, 1.5]]
        sim.step(until=0.001)
        assert sim["u.pose"][1].tolist() == [2, 3.5]


CISTERN = """
    import math

    class Cistern(su.Unit, early_return=True, split_invariant=True):
        '''The example of docs/process-protocol.md once more.'''
        capacity = su.Parameter(1.0, unit="m3", min=0)
        report_period = su.Parameter(0.5, unit="s", min=0.001)
        inflow = su.Input(float, unit="m3/s")
        volume = su.Output(float, unit="m3", depends_on=[])
        alarms = su.Output("UInt32", depends_on=[])
        order = su.MessageInput(str, name="order.text")
        alarm = su.MessageOutput(str, name="alarm.text")
        report = su.MessageOutput(str, name="report.text")

        def start(self):
            self.next_report = self.now.ps + round(self.report_period * 10**12)

        @order.receive
        def obey(self, text):
            if text == "empty":
                self.volume = 0.0

        def full_at(self, now):
            if self.volume >= self.capacity or self.inflow <= 0:
                return math.inf
            return now + math.ceil((self.capacity - self.volume) / self.inflow * 1e12)

        def step(self, now, end):
            now = now.ps
            while True:
                full_at = self.full_at(now)
                at = min(end.ps, full_at, self.next_report)
                volume = self.volume + self.inflow * ((at - now) / 1e12)
                self.volume = self.capacity if at == full_at else min(max(volume, 0.0), max(self.capacity, self.volume))
                now = at
                is_full, is_reported = at == full_at, at == self.next_report
                time = su.Time.from_ps(at)
                if is_full:
                    self.alarms += 1
                    self.alarm.send(f"full with {self.capacity!r} m3", time)
                if is_reported:
                    self.next_report += round(self.report_period * 10**12)
                    self.report.send(f"{self.volume!r} m3", time)
                if at == end.ps or self.early_return_allowed and (is_full or is_reported):
                    return time

        def next_event(self):
            return su.Time.from_ps(self.next_report)
"""


@pytest.mark.parametrize("options", [{}, {"isolate": True}])
def test_messages_and_early_returns_as_in_cpp(units, options):
    units.pack(CISTERN, name="python")
    for name, fmu in {"python": "python.fmu", "cpp": "cistern.fmu"}.items():
        (units.path / f"{name}.ssd").write_text(scenario(f"cistern={fmu[:-4]}"))
        stride.run(f"{name}.ssd", out=f"out_{name}", stop=2, set={"cistern.inflow": 0.7}, **options)
    for file in ("signals.csv", "events.csv"):
        text = (units.path / "out_python" / file).read_text()
        assert text == (units.path / "out_cpp" / file).read_text()
    assert "full with 1.0 m3" in text


def test_units_send_messages_to_each_other(units):
    assert (
        units.pack(
            """
        class Bell(su.Unit, early_return=True):
            ring = su.MessageOutput(int)
            count = 0
            def step(self, now, end):
                at = 0.3 + 0.2 * self.count
                if now < at <= end and self.early_return_allowed:
                    self.count += 1
                    self.ring.send(self.count)  # where the step ends
                    return at
    """,
            name="bell",
        )
        == ""
    )
    assert (
        units.pack(
            """
        class Ear(su.Unit):
            ring = su.MessageInput(int)
            heard = su.Output(float)
            @ring.receive
            def hear(self, number):
                self.heard = number + self.now
            def step(self, now, end): pass
    """,
            name="ear",
        )
        == ""
    )
    (units.path / "s.ssd").write_text(
        scenario("bell=bell ear=ear", "bell.ring.clock>ear.ring.clock bell.ring>ear.ring")
    )
    run = stride.run("s.ssd")
    received = [(event.time, event.value) for event in run.events if event.received and event.variable == "ear.ring"]
    assert [(pytest.approx(time), value) for time, value in received] == [
        (0.3, "1"),
        (0.5, "2"),
        (0.7, "3"),
        (0.9, "4"),
    ]
    assert run.signals["ear.heard"][-1] == 4.9


def test_next_events_are_communication_points(units):
    run = units.run(
        """
        class Clock(su.Unit):
            hour = su.Output(int)
            due = 0.2
            def event(self, now):
                if now == self.due:
                    self.hour += 1
                    self.due += 0.1
            def next_event(self):
                return self.due
            def step(self, now, end): pass
    """,
        step=0.25,
    )
    assert run.signals["u.hour"][-1] == 4
    assert {0.2, 0.3, 0.4} <= {round(time, 9) for time in run.time}


def test_times_are_compared_to_the_picosecond():
    now, due = su.Time(0.3), 0.1 + 0.2
    assert now == due and now >= due and now <= due and due == now and due <= now
    assert not now < due and not now != due and not due > now
    assert su.Time.from_ps(299_999_999_999) < now < su.Time.from_ps(300_000_000_001)
    assert now < float("inf") and now != "0.3"
    with pytest.raises(TypeError):
        now < "0.3"
    assert su.Time(1e6).ps == 10**18


def test_times_are_exact_and_in_the_unit_of_time(units):
    run = units.run("""
        class Watch(su.Unit, time_unit="us", early_return=True):
            last = su.Output(int)
            tick = su.MessageOutput(str)
            def step(self, now, end):
                self.last = end.ps
                if now.ps == 0 and self.early_return_allowed:
                    self.tick.send("odd")
                    return su.Time.from_ps(123_456_789)
    """)
    assert run.events[0].time == pytest.approx(123_456_789e-12, abs=1e-15)
    assert run.signals["u.last"][-1] == 500_000_000_000


def test_the_end_of_the_simulation_logs_and_folders(units, caplog):
    with caplog.at_level("INFO", logger="stride"):
        run = units.run(
            """
            import os, sys
            class Ends(su.Unit):
                y = su.Output(str)
                def start(self):
                    self.warn("careful \\x01")
                    with open(os.path.join(self.results, "note.txt"), "w") as file:
                        file.write(self.instance_name)
                def step(self, now, end):
                    print("printed")
                    print("<sync time='0'/>", file=sys.__stdout__, flush=True)
                    os.write(1, b"written\\n")
                    os.system("echo from a shell")
                    self.y = sys.stdin.read() + "nothing"
                    if end >= 0.25:
                        self.end_simulation()
        """,
            out="out",
        )
    assert run.reached == 0.25
    assert run.signals["u.y"][-1] == "nothing"
    assert (units.path / "out/units/u/note.txt").read_text() == "u"
    assert "careful \\x01" in caplog.text


def test_files_classes_and_a_file_outside(units):
    (units.path / "helper.py").write_text("FACTOR = 3.0\n")
    (units.path / "table.txt").write_text("7")
    source = """
        import pathlib
        from helper import FACTOR
        class Base(su.Unit):
            y = su.Output(float)
            def step(self, now, end): self.y = FACTOR
        class One(Base):
            def start(self):
                self.y = float(pathlib.Path(self.resources, "table.txt").read_text())
        class Two(Base):
            z = su.Output(float)
    """
    assert "expected one class that derives from stride.unit.Unit, there are: Base, One, Two" in units.pack(source)
    assert "u.py: there is no unit 'Three'; its units are: Base, One, Two" in units.pack(source, "--class", "Three")
    run = units.run(source, "--class=One", "--file=helper.py", "--file=table.txt")
    assert (run.signals["u.y"][0], run.signals["u.y"][-1]) == (7, 3)
    run = units.run(source, "--class=Two", "--outside")
    assert list(run.signals) == ["u.y", "u.z"]
    units.write(source.replace("self.y = FACTOR", "self.y = -FACTOR"))
    assert last(stride.run("u.fmu", stop=0.5), "u.y") == -3


@pytest.mark.parametrize("name", ["u.py", "process.xml", "stride_unit.pyz", "table.txt"])
def test_names_of_files_clash(units, name):
    (units.path / "other").mkdir()
    (units.path / "table.txt").touch()
    (units.path / "other" / name).touch()
    said = units.pack(THERMOSTAT, "--file=table.txt", f"--file=other/{name}")
    assert f"other/{name}: the FMU has another file of this name; call it otherwise" in said


def test_the_fmu_has_the_name_of_the_class(units):
    assert units.pack(THERMOSTAT) == ""
    assert 'modelName="Thermostat"' in describe("u.fmu")
    assert 'modelIdentifier="process"' in describe("u.fmu")


def test_the_interpreter_is_said_where_it_may_be_another_one(units, monkeypatch):
    units.write(THERMOSTAT)
    other = units.path / "other" / "python3"
    other.parent.mkdir()
    other.write_text("#!/bin/sh\necho /another/prefix\n")
    other.chmod(0o755)
    monkeypatch.setenv("PATH", f"{other.parent}:{os.environ['PATH']}")
    command = [sys.executable, "-m", "stride.unit", "u.py", "-o", "u.fmu"]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stderr
    assert said.startswith(f"stride.unit: warning: u.fmu: the first 'python3' in PATH runs it (here {other})")
    assert said.endswith(f"to choose this one: --python {sys.executable}\n")
    assert subprocess.run([*command, "--python", "python3"], capture_output=True, text=True, check=True).stderr == ""


def test_a_file_can_run_and_pack_itself(units):
    assert units.pack(THERMOSTAT + "\n    su.main(Thermostat)\n") == ""
    assert stride.run("u.fmu", stop=0.5).reached == 0.5
    assert subprocess.run([sys.executable, "u.py", "-o", "u.fmu", "--python", "python3"], check=True, capture_output=True).stderr == b""
    imported = [sys.executable, "-c", "import u; print(u.Thermostat().gain)"]
    assert subprocess.run(imported, check=True, capture_output=True).stdout == b"2.0\n"
    commands = (
        '<open protocol="1" instance="i" resources=""/>\n<input value=\'4\' name="temperature"/>\n<start time="0"/>\n'
    )
    commands += '<time-unit picoseconds="1000"/>\n<step may-stop="false" size="5"/>\n<end/>\n'
    done = subprocess.run([sys.executable, "u.py"], input=commands, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == [
        '<output name="power" value="0.0"/>',
        '<sync time="0"/>',
        '<output name="power" value="32.0"/>',
        '<sync time="5"/>',
    ]


def test_verify_passes(units):
    assert units.pack(CISTERN) == ""
    checks = ["load", "description", "values", "dependencies", "events", "calls", "splitting", "reset", "instances"]
    options = [f"--check={check}" for check in checks]
    done = subprocess.run([stride.program(), "verify", "u.fmu", *options], capture_output=True, text=True, check=False)
    assert "0 failed" in done.stdout, done.stdout
    assert done.returncode == 0


# ---- Mistakes in the class ----

STEP = "def step(self, now, end): pass"


@pytest.mark.parametrize(
    "body, expected",
    [
        ("no_step = True", "the class U has no step(self, now, end)"),
        ("step = None", "the class U has no step(self, now, end)"),
        ("def step(self, now): pass", "U.step(self, now): expected step(self, now, end)"),
        ("def event(self): pass", "U.event(self): expected event(self, now)"),
        ("def start(self, now): pass", "U.start(self, now): expected start(self)"),
        ("def next_event(self, now): pass", "U.next_event(self, now): expected next_event(self)"),
        ("def trace(self, file): pass", "U.trace(self, file): expected trace(self, file, signals)"),
        ("def finish(): pass", "U.finish(): expected finish(self)"),
        ("finish = 3", "U.finish: expected finish(self), is 3"),
        ("def __init__(self, gain): pass", "U.__init__(self, gain): expected __init__(self)"),
        ("m = su.MessageInput(str)\n        @m.receive\n        def obey(self): pass", "U.obey(self): expected obey(self, value)"),
        ("def event(self, now): yield", "U.event: expected a method without yield or async"),
        ("async def finish(self): pass", "U.finish: expected a method without yield or async"),
        ("now = 3.0", "U.now: each unit has something of this name; choose another one"),
        ("def results(self): pass", "U.results: each unit has something of this name"),
        ("y = su.Output(complex)", "<class 'complex'> is neither a type nor a start value: expected float, int, bool"),
        ("y = su.Output(float, start='high')", "U.y: start: expected a float, is 'high' (str)"),
        ("y = su.Output('UInt8', start=256)", "U.y: start: expected a number of the type UInt8, from 0 to 255, is 256"),
        (
            "y = su.Output(float, shape=2, start=[1.0])",
            "expected an array of float64 with the shape (2,), is one of float64",
        ),
        ("y = su.Output(str, shape=2)", "shape: expected of numbers and bool only"),
        (
            "event = su.Input(bool)",
            "U.event: each unit has something of this name; choose another one, and give name='event'",
        ),
        ("a = su.Input(bool, name='x')\n        b = su.Output(int, name='x')", "U.b: 'a' has the name 'x', too"),
        (
            "m = su.MessageInput(str)\n        n = su.Output(int, name='m.clock')",
            "U.n: 'm' has the name 'm.clock', too",
        ),
        ("y = su.Output(float)\n        def y(self): pass", "'y' is defined twice; give one of both another name"),
        ("y = su.Output(float, depends_on=['v'])", "U.y: depends_on: there is no input 'v'"),
        ("y = su.Output(float, color=1)", "Output(…): there is no color=…; known are: depends_on, description, discrete"),
        ("y = su.Output(float, unti='m')", "Output(…): there is no unti=…; did you mean unit=…?"),
        ("y = su.MessageInput(str, mimetype='x')", "MessageInput(…): there is no mimetype=…; did you mean mime_type=…?"),
        ("a = su.Output(float)\n        y = su.Output('hello', unit='m')", "U.y: unit: expected of Float32 and Float64 only"),
        (
            "y = su.Input(int, unit='m')",
            "U.y: unit: expected of Float32 and Float64 only, is of Int64; write Input(float, unit='m')",
        ),
        ("a = su.Output(bool, discrete=True)\n        y = su.Output(bool, name='no name')", "'no name'"),
        ("y = su.Output(float, name='process.program')", "'process.program'"),
        ("1/0", "ZeroDivisionError: division by zero (u.py:4, in U)"),
        ("y = su.Output(1, unit='K', relative=True)", "U.y: unit: expected of Float32 and Float64 only"),
        ("y = su.Output(1.0, relative=True)", "relative() is for variables with a unit of measure"),
        ("y = su.Output(1.0, min=2)", "U.y: start: 1.0 is beyond min=2; give another start, or another min"),
        ("y = su.Input(float, shape=2, start=[0, 9.5], max=9)", "U.y: start: [0, 9.5] is beyond max=9"),
        ("y = su.Output('float32')", "there is no type 'float32'; expected Float32, or for the text 'float32' (str, start="),
        ("y = su.Output('double')", "there is no type 'double'; expected Float64, or"),
        ("y = su.Output('numpy.float32')", "there is no type 'numpy.float32'; expected Float32, or"),
        ("y = su.Output('integer')", "there is no type 'integer'; expected Int32, or"),
        ("y = su.Output('Flaot64')", "there is no type 'Flaot64'; expected Float64, or"),
        ("y = su.Output('Float32', start=1e-50)", "U.y: start: 1e-50 is too near to 0 for a Float32; write 0.0"),
        ("y = su.Output('flaot')", "there is no type 'flaot'; expected float (Float64), or for the text 'flaot'"),
        ("y = su.Output('Enumeration')", "there is no type 'Enumeration'; expected Float64, Float32, Int8,"),
        ("y = su.Output(float, min='low')", "U.y: min: expected a number, is 'low' (str)"),
        ("y = su.Output('on', max=1)", "U.y: max: expected of numbers only"),
        ("y = su.Output(float('nan'), max=1)", "U.y: start: nan is beyond max=1"),
        ("y = su.Output('Float16')", "there is no type 'Float16'; expected Float64, Float32, Int8,"),
    ],
)
def test_mistakes_in_a_class(units, body, expected):
    step = "" if "step" in body else STEP
    said = units.pack(f"""
    class U(su.Unit):
        {body}
        {step}
    """)
    assert "stride.unit: error: " in said
    assert expected in said


@pytest.mark.parametrize(
    "source, expected",
    [
        ("", "there are: none"),
        ("def", "SyntaxError"),
        ("import sys\nsys.exit(0)", "it ends Python (0) where it is only to define a class"),
    ],
)
def test_mistakes_in_a_file(units, source, expected):
    assert expected in units.pack(source)


def test_no_program(units, monkeypatch):
    monkeypatch.setenv("STRIDE_PREFIX", "/nowhere")
    monkeypatch.setenv("PATH", "/nowhere")
    assert "there is no program /nowhere/bin/stride" in units.pack(THERMOSTAT)


def test_no_file(units):
    command = [sys.executable, "-m", "stride.unit", "none.py", "-o", "u.fmu"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr.startswith("stride.unit: error: [Errno 2] No such file or directory: '")


def test_a_text_may_look_like_a_type():
    assert su.Output(str, start="float32").start == "float32"
    for text in ("", "hello", "on", "stride", "a string", "points", "flat", "init", "hint"):
        assert (su.Output(text).type_name, su.Output(text).start) == ("String", text)


def test_words_behind_the_base_are_checked_with_the_class(units):
    said = units.pack("class U(su.Unit, time_unit='min'):\n    def step(self, now, end): pass\n")
    assert 'U: time-unit="min" is not known: expected ps, ns, us, ms or s' in said


@pytest.mark.parametrize(
    "word, expected",
    [
        ("splitinvariant", "class U(Unit, …): there is no splitinvariant=…; did you mean split_invariant=…?"),
        ("Maximum_Step", "there is no Maximum_Step=…; did you mean maximum_step=…?"),
        ("colour", "there is no colour=…; known are: early_return, maximum_step, split_invariant, time_unit"),
    ],
)
def test_misspelt_words_behind_the_base(units, word, expected):
    assert expected in units.pack(f"class U(su.Unit, {word}=True):\n    def step(self, now, end): pass\n")


def test_a_unit_option_that_is_not_known():
    with pytest.raises(su.UnitError, match="erly_return"):
        type(su.Unit)("U", (su.Unit,), {}, erly_return=True)


# ---- Mistakes in a run ----


def failure(units, source, **settings):
    with pytest.raises(stride.RunError) as caught:
        units.run(source, **settings)
    return caught.value


@pytest.mark.parametrize(
    "assignment, expected",
    [
        ("self.y = 'on'", "output 'y': expected a float, is 'on' (str)"),
        ("self.y = None", "output 'y': expected a float, is None (NoneType)"),
        ("self.y = True", "output 'y': expected a float, is True (bool)"),
        ("self.i = 1.5", "output 'i': expected an int, is 1.5 (float)"),
        (
            "self.i = 2**63",
            "output 'i': expected a number of the type Int64, from -9223372036854775808 to 9223372036854775807",
        ),
        ("self.f = 1e300", "output 'f': expected a number of the type Float32, from -3.4028234663852886e+38 to"),
        ("self.y = 10**400", "output 'y': expected a number of the type Float64, from -1.7976931348623157e+308 to"),
        ("self.g = [1e300, 0]", "output 'g': expected an array of float32 with the shape (2,), has elements beyond that"),
        ("self.b = 1", "output 'b': expected a bool, is 1 (int)"),
        ("self.s = b'x'", "output 's': expected a str, is b'x' (bytes)"),
        ("self.s = '\\x01'", "output 's': a str cannot have the character '\\x01' here, but bytes can"),
        ("self.d = 'x'", "output 'd': expected bytes, is 'x' (str)"),
        (
            "self.a = [1.0]",
            "output 'a': expected an array of uint8 with the shape (2,), is one of float64 with the shape (1,)",
        ),
        (
            "self.a = [1, 256]",
            "output 'a': expected an array of uint8 with the shape (2,), has elements beyond that: [1, 256]",
        ),
        ("self.u = 1/0", "ZeroDivisionError: division by zero (u.py:16, in step)"),
        ("self.u = 3.0", "input 'u': the unit has changed it, which stride alone does"),
        ("self.v = self.v + 1", "input 'v': the unit has changed it"),
        ("self.p = 2.0", "parameter 'p': the unit has changed it"),
        ("del self.u", "input 'u': the unit has changed it"),
        ("self.m = 'x'", "message 'm': the unit has assigned it; send it: self.m.send(value)"),
        ("self.o = 'x'", "message 'o': the unit has assigned it; it comes to the method behind @o.receive"),
        ("self.now = 3.0", "self.now: the unit has assigned it, which stride alone does"),
        ("self.results = 3", "self.results: the unit has assigned it"),
        ("del self.resources", "self.resources: the unit has assigned it"),
        ("self.early_return_allowed = True", "self.early_return_allowed: the unit has assigned it"),
        ("del self.y", "output 'y': it was deleted"),
        ("self.v[0] = 1", "ValueError: assignment destination is read-only (u.py:16, in step)"),
        ("raise SystemExit", "SystemExit (u.py:16, in step)"),
        ("return 0.3", "step() returned 0.3 s, but this step has to end at 0.375 s: end early only where"),
        ("return 0.2", "step() returned 0.2 s; expected from 0.25 s to 0.375 s"),
        ("return 'x'", "step() returned 'x'; expected None, or the instant"),
        ("self.due = 0.1", "next_event() returned 0.1 s; expected None, or an instant after 0.375 s"),
        ("self.m.send(3)", "TypeError: message 'm': expected a str, is 3 (int) (u.py:16, in step)"),
        ("self.m.send('x', at=0.1)", "ValueError: message 'm': at=0.1 is not in this step, from 0.25 s to 0.375 s"),
    ],
)
def test_mistakes_in_a_step(units, assignment, expected):
    error = failure(
        units,
        f"""
    class U(su.Unit):
        u = su.Input(float)
        v = su.Input(float, shape=2); p = su.Parameter(1.0)
        y = su.Output(float)
        i = su.Output(int)
        b = su.Output(bool)
        s = su.Output(str)
        d = su.Output(bytes)
        a = su.Output('UInt8', shape=2); f = su.Output('Float32'); g = su.Output('Float32', shape=2)
        m = su.MessageOutput(str); o = su.MessageInput(str)
        due = None
        def step(self, now, end):
            if now >= 0.25:
                {assignment}
        def next_event(self):
            return self.due
    """,
    )
    assert error.component == "u"
    assert error.time == 0.25
    assert f"fails: {expected}" in str(error)
    assert error.run.reached == 0.25


def test_a_parameter_that_is_assigned_before_stride_sets_it(units):
    source = THERMOSTAT + "\n        def __init__(self): self.gain = 3.0\n"
    assert "fails: parameter 'gain': the unit has changed it" in str(failure(units, source))


def test_mistakes_at_the_start_and_at_the_end(units):
    assert "RuntimeError: no (u.py:4, in start)" in str(
        failure(
            units,
            """
        class U(su.Unit):
            def start(self): raise RuntimeError("no")
            def step(self, now, end): pass
    """,
        )
    )


AT_THE_END = """
    class U(su.Unit):
        u = su.Input(float)
        y = su.Output(float, shape=2); s = su.Output(str)
        m = su.MessageOutput(str)
        private = None
        def step(self, now, end): self.y = [end, 0]
        def finish(self):
            {body}
"""


@pytest.mark.parametrize(
    "body, expected",
    [
        ("raise OSError('late')", "OSError: late (u.py:10, in finish)"),
        ("self.y[1] = 3", "output 'y': finish() has assigned it, but the run has ended"),
        ("self.s = 3", "output 's': finish() has assigned it, but the run has ended"),
        ("self.m.send('x')", "message 'm': finish() has sent it, but the run has ended"),
        ("self.u = 3.0", "input 'u': the unit has changed it"),
        ("self.now = 3.0", "self.now: the unit has assigned it"),
    ],
)
def test_mistakes_at_the_end(units, body, expected):
    error = failure(units, AT_THE_END.format(body=body))
    assert f"fails: {expected}" in error.text.partition("\n")[0]
    assert error.run.reached == 0.5


def test_what_is_said_and_kept_at_the_end_is_no_mistake(units, caplog):
    body = "self._sent = self._ends = self.y = self.y; self.warn('bye')"
    assert units.run(AT_THE_END.format(body=body)).passed
    assert "bye" in caplog.text


def test_what_is_said_before_a_mistake_is_logged(units, caplog):
    failure(units, THERMOSTAT + "            self.warn('too hot'); 1/0\n")
    assert "too hot" in caplog.text


@pytest.mark.parametrize("name", ["now", "results", "early_return_allowed"])
def test_names_of_each_unit_that_are_assigned_before_the_start(units, name):
    source = THERMOSTAT + f"\n        def __init__(self): self.{name} = []\n"
    assert f"fails: self.{name}: the unit has assigned it" in str(failure(units, source))


def test_the_whole_traceback_is_there(units):
    error = failure(
        units,
        """
        def below(x):
            return {}[x]
        class U(su.Unit):
            def step(self, now, end): below("key")
    """,
    )
    assert "fails: KeyError: 'key' (u.py:4, in below)" in str(error)
    assert 'u.py", line 6, in step' in str(error)
    assert "stride_unit" not in str(error).partition("standard error:")[2]


def test_a_class_that_has_changed_outside(units):
    units.run(THERMOSTAT, "--outside")
    units.write(THERMOSTAT.replace("gain", "factor"))
    with pytest.raises(
        stride.RunError, match="the class Thermostat has no parameter 'gain', which its FMU has: pack it again"
    ):
        stride.run("u.fmu", stop=0.5)


def test_a_missing_interpreter(units):
    units.write(THERMOSTAT)
    command = [sys.executable, "-m", "stride.unit", "u.py", "-o", "u.fmu", "--python", "python9"]
    subprocess.run(command, check=True)
    with pytest.raises(stride.RunError, match="cannot start 'python9': it is in no folder of PATH"):
        stride.run("u.fmu", stop=0.5)
    assert stride.run("u.fmu", stop=0.5, set={"u.process.program": sys.executable}).passed


def test_a_missing_module(units):
    (units.path / "helper.py").write_text("")
    error = failure(units, "import helper\n" + textwrap.dedent(THERMOSTAT))
    assert "fails: ModuleNotFoundError: No module named 'helper' (u.py:2, in <module>)" in str(error)


def test_the_package_is_light():
    code = "import sys, stride.unit; sys.exit('numpy' in sys.modules or 'ctypes' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], env={**os.environ}, check=False).returncode == 0


_LOOPING = """
import stride
with stride.Simulation("u.fmu", stop=1, set={"u.process.time_limit": 2}) as sim:
    print("begun", flush=True)
    sim.run()
"""


def test_ctrl_c_waits_for_a_unit_no_longer_than_its_time_limit(units):
    assert units.pack("""
    class U(su.Unit):
        def step(self, now, end):
            while True: pass
    """) == ""
    command = [sys.executable, "-c", _LOOPING]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "begun\n"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    _, messages = process.communicate(timeout=30)
    assert "KeyboardInterrupt" in messages
