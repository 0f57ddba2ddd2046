"""stride in pytest: scenarios and their checks as tests, runs that tests share, cases of campaigns.

    def test_it_answers(stride_run):
        run = stride_run("nfc_approach.ssd", set={"sensor.power.capacitance": 220e-6})
        assert run.signals["sensor.led"].any()

    @pytest.mark.stride_campaign("variations.xosc")
    def test_each_case(stride_case):
        stride_case.run().check()

`pytest scenario.ssd` runs a scenario and is a test for each of its checks, and so are packages (.ssp) and FMUs; the ini
option `stride_scenarios` lists patterns of those that are found in folders, too.
"""

from __future__ import annotations

import contextlib
import copy
import csv
import fnmatch
import itertools
import os
import re
import shlex
import tempfile
import threading
import zipfile
from collections import Counter, defaultdict
from collections.abc import Generator, Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Callable, Optional, Union
from xml.parsers import expat

import pytest

from ._errors import Error, InputError, MisuseError, RunError
from ._options import word_of, words
from ._program import output_of, run, run_words
from .results import Run

_CHECKS = "urn:org.stride:scenario:1 Checks"

RunFunction = Callable[..., Run]
_runs = pytest.StashKey[list[Run]]()


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addini(
        "stride_scenarios",
        "patterns of scenarios (.ssd, .ssp, .fmu) that are tests wherever they are found, beside those named on the command line",
        type="args",
        default=[],
    )


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line(
        "markers",
        "stride_campaign(file): the test is called for each case of this campaign (.xosc), with the fixture stride_case",
    )


# ---- Runs ----


#: Of a file: its path, size and time of change.
_Stamp = tuple[str, int, int]


def _stamps(run: Run) -> list[_Stamp]:
    """Of all that it was made from, of what would be found in its place, which may not be there, and of its account."""
    provenance = run.info["provenance"]
    folder = Path(provenance["commands"][0]["folder"])
    sources = [folder / source["path"] for source in provenance["sources"]]
    searched = {folder, *(source.parent for source in sources), *map(Path, os.environ.get("STRIDE_UNITS", "").split(":"))}
    names = {source.name for source in sources}
    files = {*sources, *(place / name for place in searched for name in names), run.folder / "run.json"}
    below = {file for folder in files if folder.is_dir() for file in folder.rglob("*")}  # of an unpacked unit
    return [_stamp(file) for file in sorted(files | below)]


def _stamp(file: Path) -> _Stamp:
    try:
        status = file.stat()
    except OSError:
        return str(file), -1, 0
    return str(file), status.st_size, status.st_mtime_ns


@dataclass(frozen=True)
class _Made:
    """A run, or what it has failed with, and the files that it was made from."""

    run: Union[Run, RunError]
    files: list[_Stamp]

    @property
    def is_valid(self) -> bool:
        return all(_stamp(Path(path)) == (path, size, time) for path, size, time in self.files)

    def shared(self) -> Run:
        """Without what other tests may have changed of it."""
        if isinstance(self.run, RunError):
            raise self.run
        with contextlib.suppress(InputError):
            self.run.signals  # noqa: B018 - one for all, which reads its file once
        shared = copy.copy(self.run)
        shared.info = copy.deepcopy(self.run.info)
        return shared


class _Runs:
    """Runs each scenario once for each set of options, also one that fails, as long as its files are the same."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._made: dict[Any, _Made] = {}
        self._locks: defaultdict[Any, threading.Lock] = defaultdict(threading.Lock)
        self._lock = threading.Lock()  # of the locks
        self._numbers = itertools.count(1)

    def new_folder(self, name: str) -> Path:
        return self._folder / f"{next(self._numbers):03}-{name}"

    def run(self, scenario: Any, **options: Any) -> Run:
        _refuse_out(options)
        name = word_of(scenario, "the scenario")
        settings = sorted(item for item in os.environ.items() if item[0].startswith("STRIDE_"))
        key = (os.getcwd(), name, *sorted(words(options)), *settings)  # files are named from the folder
        with self._lock:
            lock = self._locks[key]
        with lock:  # threads of a test that want the same run wait for it
            if key not in self._made or not self._made[key].is_valid:
                self._made[key] = self._make(name, options)
            return self._made[key].shared()

    def _make(self, scenario: str, options: dict[str, Any]) -> _Made:
        try:
            made = run(scenario, out=self.new_folder(Path(scenario).stem), **options)
        except RunError as error:
            if error.run is None:  # nothing says what it was made from
                raise
            return _Made(error, _stamps(error.run))
        return _Made(made, _stamps(made))


def _refuse_out(options: dict[str, Any]) -> None:
    if "out" in options:
        raise MisuseError(
            "results are where pytest keeps temporary folders, and go with them; stride.run takes the folder 'out'"
        )


_session_runs = pytest.StashKey[_Runs]()
_first_use = threading.Lock()


def _runs_of(config: pytest.Config) -> _Runs:
    """Those of the session, for tests, items and cases."""
    with _first_use:
        if _session_runs not in config.stash:
            factory = getattr(config, "_tmp_path_factory")  # noqa: B009 - what pytest's fixture returns
            config.stash[_session_runs] = _Runs(factory.mktemp("stride"))
        return config.stash[_session_runs]


def _noted(node: pytest.Item, make: Callable[[], Run]) -> Run:
    """The run that is made, kept as one at which the test has looked, also one that has failed."""
    noted = node.stash.setdefault(_runs, [])
    try:
        noted.append(make())
    except RunError as error:
        if error.run is not None:
            noted.append(error.run)
        raise
    return noted[-1]


@pytest.fixture
def stride_run(request: pytest.FixtureRequest) -> RunFunction:
    """`stride.run`, which runs a scenario with the same options once in the session, for all tests.

    The report is named where a test fails. Files of results stay where pytest keeps temporary folders.
    """

    def made(scenario: Any, **options: Any) -> Run:
        return _noted(request.node, lambda: _runs_of(request.config).run(scenario, **options))

    return made


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, Any, None]:
    outcome = yield
    report = outcome.get_result()
    if report.when != "call" or not report.failed:
        return
    for made in item.stash.get(_runs, []):
        try:
            place = str(made.report())
        except InputError:
            place = str(made.folder)
        report.sections.append(("stride", f"{place}\n{made.summary}"))
        html = item.config.pluginmanager.getplugin("html")
        if html is not None:  # pytest-html shows it beside the test
            report.extras = [*getattr(report, "extras", []), html.extras.url(place, name="stride report")]


# ---- Scenarios as tests ----


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> Optional[pytest.Collector]:
    if file_path.suffix not in (".ssd", ".ssp", ".fmu"):
        return None
    is_named = parent.session.isinitpath(file_path)
    patterns = parent.config.getini("stride_scenarios")
    if not is_named and not any(fnmatch.fnmatch(file_path.name, pattern) for pattern in patterns):
        return None
    return ScenarioFile.from_parent(parent, path=file_path)


class ScenarioFile(pytest.File):
    """A scenario: a test that it runs to its end and its units judge it well, and one for each check."""

    def collect(self) -> Iterable[pytest.Item]:
        yield RunItem.from_parent(self, name="run")
        checks = _checks(self.path)
        lines = Counter(line for line, _ in checks)
        taken = {"run"}
        for line, name in checks:
            test = _free_name(name.translate(_NAMES).replace("::", ": "), taken)
            taken.add(test)
            yield CheckItem.from_parent(self, name=test, line=line, check=name if lines[line] > 1 else None)


def _free_name(name: str, taken: set[str]) -> str:
    """The name, or else with the first number with which there is none yet."""
    numbered = itertools.chain([name], (f"{name} ({number})" for number in itertools.count(2)))
    return next(each for each in numbered if each not in taken)


_NAMES = str.maketrans("[]", "()")  # what pytest takes for its own in the name of a test, as "::"


def _checks(scenario: Path) -> list[tuple[int, str]]:
    """The line and the name of each check; one without a name is called by what it checks."""
    found: list[tuple[int, str]] = []
    names: list[str] = []
    parser = expat.ParserCreate(namespace_separator=" ")

    def start(name: str, attributes: dict[str, str]) -> None:
        if names and names[-1] == _CHECKS:
            kind = name.rpartition(" ")[2]
            fallback = f"{kind} {attributes.get('signal', '')} (line {parser.CurrentLineNumber})"
            found.append((parser.CurrentLineNumber, attributes.get("name") or fallback))
        names.append(name)

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda _name: names.pop()
    try:
        parser.Parse(_system(scenario), True)
    except (expat.ExpatError, zipfile.BadZipFile, KeyError):
        return []  # the run says what is wrong
    return found


def _system(scenario: Path) -> bytes:
    """The file with the checks; an FMU has none."""
    if scenario.suffix == ".ssd":
        return scenario.read_bytes()
    with zipfile.ZipFile(scenario) as package:
        return package.read("SystemStructure.ssd")


class _Verdict(Exception):
    """A verdict that is a bad one."""


class _ScenarioItem(pytest.Item):
    """Of a scenario, whose items have one run in common, and what it has failed with."""

    line: Optional[int] = None

    def scenario_run(self) -> Run:
        return _noted(self, lambda: _runs_of(self.config).run(self.path))

    def repr_failure(self, excinfo: Any, style: Any = None) -> Any:
        if isinstance(excinfo.value, (Error, _Verdict)):
            return f"{excinfo.value}{self._other_way(getattr(excinfo.value, 'hint', None))}"
        return super().repr_failure(excinfo)

    def _other_way(self, hint: Optional[str]) -> str:
        """Where a hint names an option of `stride run`, which pytest has not."""
        option = re.search(r"--([a-z][-a-z]*)", hint or "")
        if option is None:
            return ""
        keyword = option[1].replace("-", "_")
        return f"\n  pytest has no --{option[1]}: a test in Python has, stride_run({self.path.name!r}, {keyword}=…)"

    def reportinfo(self) -> tuple[Path, Optional[int], str]:
        return self.path, None if self.line is None else self.line - 1, f"{self.path.name}: {self.name}"


class RunItem(_ScenarioItem):
    """The scenario runs to its end, and its units judge it well."""

    def runtest(self) -> None:
        bad = [each for each in self.scenario_run().info["verdicts"] if each["passed"] is False]
        if bad:
            raise _Verdict("\n".join(f"{each['component']}: {each['text']}" for each in bad))


class CheckItem(_ScenarioItem):
    """A check of the scenario, which begins in this line of it, and is called so if others do, too."""

    def __init__(self, *, line: int, check: Optional[str], **further: Any) -> None:
        super().__init__(**further)
        self.line = line
        self.check = check

    def runtest(self) -> None:
        verdicts = [check for check in self.scenario_run().info["checks"] if check["line"] == self.line]
        named = [check for check in verdicts if check["name"] == self.check]
        verdicts = named or verdicts
        bad = [check for check in verdicts if check["passed"] is False]
        if bad:
            raise _Verdict("\n".join(f"{check['name']}: {check['text']}" for check in bad))
        if not all(check["passed"] for check in verdicts) or not verdicts:
            pytest.skip("; ".join(check["text"] for check in verdicts) or "it was not made")


# ---- Campaigns ----


@dataclass(frozen=True)
class Case:
    """A case of a campaign.

    Attributes:
        campaign: The file.
        number: As `stride campaign run --case` takes it.
        parameters: Their values, as texts.
    """

    campaign: Path
    number: int
    parameters: dict[str, str]
    _node: Any = field(default=None, repr=False, compare=False)

    def run(self, **options: Any) -> Run:
        """Runs it, and what `stride.run` takes besides."""
        _refuse_out(options)
        words = shlex.split(_plan(self.campaign, f"--case={self.number}"))[2:]
        folder = _runs_of(self._node.config).new_folder(f"case-{self.number:06}")
        return _noted(self._node, lambda: run_words(words, out=folder, folder=self.campaign.parent, **options))


def _plan(campaign: Path, *options: str) -> str:
    return output_of(["campaign", "plan", campaign.name, *options], campaign.parent)


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    if "stride_case" not in metafunc.fixturenames:
        if any(marker.name == "stride_campaign" for marker in metafunc.definition.own_markers):
            raise pytest.UsageError(
                f"{metafunc.function.__name__} has the mark stride_campaign: take the cases, with the fixture stride_case"
            )
        return
    marker = metafunc.definition.get_closest_marker("stride_campaign")
    if marker is None or len(marker.args) != 1 or not isinstance(marker.args[0], (str, os.PathLike)):
        raise pytest.UsageError(
            f"{metafunc.function.__name__} has the fixture stride_case: name its campaign,"
            ' @pytest.mark.stride_campaign("FILE.xosc")'
        )
    file = Path(metafunc.definition.path).parent / marker.args[0]
    if not file.is_file():
        raise pytest.UsageError(f"{metafunc.function.__name__}: there is no campaign {file}")
    try:
        cases = _cases(file)
    except InputError as error:
        raise pytest.UsageError(str(error)) from None
    metafunc.parametrize("stride_case", cases, ids=[f"case {case.number}" for case in cases], indirect=True)


def _cases(file: Path) -> list[Case]:
    with tempfile.TemporaryDirectory(prefix="stride-") as folder:
        _plan(file, f"--out={folder}")
        with (Path(folder) / "plan.csv").open(newline="", encoding="utf-8") as lines:
            rows = list(csv.DictReader(lines))
    others = ("case", "seed", "hash")
    return [
        Case(file, int(row["case"]), {key: value for key, value in row.items() if key not in others}) for row in rows
    ]


@pytest.fixture
def stride_case(request: pytest.FixtureRequest) -> Case:
    """A case of the campaign that `@pytest.mark.stride_campaign` names; the test is called for each."""
    case: Case = request.param
    return replace(case, _node=request.node)
