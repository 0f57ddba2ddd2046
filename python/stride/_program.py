"""What the program does, each time in a process of its own: runs and campaigns."""

from __future__ import annotations

import logging
import shutil
import signal
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Optional, TypeVar, Union

import numpy as np

from ._errors import Error, InputError, RunError, parse_error
from ._installed import program
from ._options import PathLike, file_word, path_of, refuse_keyword, words
from ._rows import read_table
from .results import Run, TemporaryFolder

__all__ = ["Campaign", "campaign", "run"]

AnyError = TypeVar("AnyError", bound=Error)

_ERROR = "stride: error: "
_WARNING = "stride: warning: "


def _command(arguments: list[str]) -> list[str]:
    """Of the program, which ends in order when Python is killed, where util-linux has the means for it."""
    setpriv = shutil.which("setpriv")
    tie = [setpriv, "--pdeathsig", "TERM", "--"] if setpriv else []
    return [*tie, str(program()), *arguments]


def _call(arguments: list[str], folder: Optional[PathLike] = None) -> tuple[int, str, str]:
    """Runs the program. Returns its exit code, and what it printed: results and messages.

    Ctrl-C ends it in order; a second one, where a unit does not come to an end.
    """
    process = subprocess.Popen(
        _command(arguments),
        cwd=folder,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        errors="replace",
        start_new_session=True,  # so that an interruption reaches it once, from here
    )
    try:
        output, messages = process.communicate()
    except BaseException:
        _end(process)
        raise
    return process.returncode, output, messages


def _end(process: subprocess.Popen[str]) -> None:
    """In order, at a second Ctrl-C meanwhile without waiting for a unit, and at a third one at once."""
    for number in (signal.SIGINT, signal.SIGINT, signal.SIGKILL):
        process.send_signal(number)
        try:
            process.communicate()
            return
        except BaseException:  # noqa: BLE001 - the one before it goes on
            continue


def output_of(arguments: list[str], folder: Optional[PathLike] = None) -> str:
    """What the program prints. Raises InputError with its error."""
    code, output, messages = _call(arguments, folder)
    if code != 0:
        raise _failure(messages, InputError)
    return output


def answer_of(arguments: list[str], file: Path) -> str:
    """What the program prints of a question whose answer may be no, with code 1, and is written to a file.

    Raises InputError where the question is wrong, and RunError where there is no answer.
    """
    code, output, messages = _call(arguments)
    if code == 2:
        raise _failure(messages, InputError)
    _warn(messages)
    if code not in (0, 1) or not file.is_file():
        raise _failure(messages, RunError)
    return output


def _failure(messages: str, kind: type[AnyError]) -> AnyError:
    """The error among the messages."""
    before, found, error = messages.partition(_ERROR)
    error = error.partition(f"\n{_WARNING}")[0]
    return parse_error((error if found else before).strip() or "the program has ended without a word", kind)


def _warn(messages: str) -> None:
    for warning in messages.partition(_ERROR)[0].split(_WARNING)[1:]:
        logging.getLogger("stride").warning("%s", warning.strip())


def run(scenario: PathLike, *, out: Optional[PathLike] = None, **options: Any) -> Run:
    """Runs a scenario to its end, in a process of its own.

    >>> run = stride.run("nfc_approach", set={"sensor.power.capacitance": 220e-6}, swap={"sensor": "new.fmu"})
    >>> run.signals["sensor.capacitor.voltage"].max()

    Args:
        scenario: A system file (.ssd), a package (.ssp), an FMU (.fmu), a table (.csv, .parquet, .mcap), or the name of
            a scenario that comes with stride, such as "nfc_approach".
        out: The folder of the results; None: a temporary one, which is removed with the Run that is returned, and its
            signals.
        options: Those of `stride run`, with "_" for "-"; a mapping or a list repeats the option: `stop=3`,
            `set={"sensor.gain": 2}`, `swap={"sensor": "new.fmu"}`, `isolate=True`, `film=0.1`,
            `signals=["sensor.*"]`. See `stride run --help`.

    Returns:
        What has happened. A bad verdict of a unit or a check is none of an exception; see `Run.passed`, `Run.check`.

    Raises:
        InputError: The scenario or an option is wrong.
        RunError: The run has failed on the way; its attribute `run` is what has happened up to there (None, where that could
            not be written: the disk is full, the program was killed).
    """
    return run_words([file_word(scenario, "the scenario")], out=out, **options)


def run_words(
    arguments: list[str], *, out: Optional[PathLike] = None, folder: Optional[PathLike] = None, **options: Any
) -> Run:
    """Likewise, of the words behind `stride run`, in this working folder."""
    refuse_keyword(options, "results", "out")
    keeper = None
    if out is None:
        keeper = TemporaryFolder()
        out = keeper.name
    results = Path(path_of(out, "out")).absolute()
    code, output, messages = _call(["run", *arguments, f"--out={results}", "--progress=none", *words(options)], folder)
    if code == 2:
        raise _failure(messages, InputError)
    _warn(messages)
    try:
        result = Run(results, output, keeper)
    except InputError:  # of run.json, of which the program has said why it is not there
        raise _failure(messages, RunError) from None
    if code == 0 or (code == 1 and result.error is None and result.info["outcome"] != "interrupted"):
        return result
    failure = _failure(messages, RunError)
    failure.run = result
    raise failure


class Campaign:
    """The cases of a campaign that have been run.

    Attributes:
        folder: With the table and the page.
        columns: The names of the table's columns: "case", the parameters, "outcome", and so on.
        rows: A list of the cases, each a dict of the columns' texts.
        summary: What the program has printed.
    """

    def __init__(self, folder: Union[str, Path], summary: str = "") -> None:
        """Reads cases.csv in this folder. Raises InputError if there is none."""
        self.folder = Path(path_of(folder, "a folder of a campaign")).absolute()
        self.summary = summary
        table = self.folder / "cases.csv"
        if not table.is_file():
            raise InputError(f"{self.folder} has no table of cases", file=str(table))
        self.columns, found = read_table(table)
        if not {"case", "seed", "outcome"} <= {*self.columns}:
            raise InputError(f"{table}:1: there is no column case, seed or outcome", file=str(table), line=1)
        self.rows = [dict(zip(self.columns, row)) for row in found]

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[dict[str, str]]:
        """The cases."""
        return iter(self.rows)

    def __contains__(self, column: object) -> bool:
        return column in self.columns

    def __getitem__(self, column: str) -> np.ndarray:
        """A column: numbers, where all that is there are numbers (NaN: there is none), and texts otherwise."""
        if column not in self.columns:
            raise KeyError(f"no column '{column}'; there are: {', '.join(self.columns)}")
        texts = [row[column] for row in self.rows]
        if column in ("case", "seed"):  # a seed has more digits than a float
            try:
                return np.array([int(text) for text in texts], dtype=np.uint64)
            except (ValueError, OverflowError) as error:
                raise InputError(f"{self.folder / 'cases.csv'}: column '{column}': {error}") from None
        try:
            return np.array([float(text) if text else np.nan for text in texts])
        except ValueError:
            return np.array(texts, dtype=object)

    @property
    def passed(self) -> bool:
        """Whether there are cases, and all of them passed."""
        return bool(self.rows) and all(row["outcome"] == "passed" for row in self.rows)

    def to_pandas(self) -> Any:
        """The table as a pandas DataFrame whose index is the case."""
        import pandas

        table = pandas.DataFrame({column: self[column] for column in self.columns})
        table["case"] = table["case"].astype(int)
        return table.set_index("case")

    def report(self) -> Path:
        """The page of the campaign."""
        return self.folder / "campaign.html"

    def __repr__(self) -> str:
        passed = sum(row["outcome"] == "passed" for row in self.rows)
        return f"<stride.Campaign: {passed} of {len(self)} cases passed, in {self.folder}>"


def campaign(file: PathLike, *, out: Optional[PathLike] = None, **options: Any) -> Campaign:
    """Runs the cases of a campaign that have no record yet, and returns the table of all.

    >>> table = stride.campaign("two_filters.xosc", jobs=2)
    >>> table["aggregate:end"].min()

    Args:
        file: The campaign (.xosc), or the folder of one that has begun.
        out: Its folder; None: campaigns/ and its name, in the working folder.
        options: Those of `stride campaign run`.

    Raises:
        InputError: The campaign, its scenario or an option is wrong.
        RunError: The campaign could not be run. Cases that fail are none of an exception.
    """
    file = file_word(file, "the campaign")
    for name in ("case", "cases"):
        if options.get(name) is not None:
            raise InputError(f"'{name}' runs cases without making the table; stride.run runs a scenario like a case")
    refuse_keyword(options, "results", "out")
    if out is None and Path(file).is_dir():  # of a campaign that has begun, or the program says that it is none
        folder, place = Path(file), []
    else:
        folder = Path("campaigns", Path(file).stem) if out is None else Path(path_of(out, "out"))
        place = [f"--out={folder}"]
    code, output, messages = _call(["campaign", "run", file, *place, "--progress=none", *words(options)])
    if code == 2:
        raise _failure(messages, InputError)
    _warn(messages)
    if code not in (0, 1) or not (folder / "cases.csv").is_file():
        raise _failure(messages, RunError)
    return Campaign(folder, output)
