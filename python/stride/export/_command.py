"""`stride export`, the command of this package."""

from __future__ import annotations

import argparse
import logging
import re
import sys
from typing import Optional

from .._errors import Error, InputError

_GOOD, _FAILED, _WRONG_INPUT = 0, 1, 2


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> None:  # type: ignore[override]
        print(f"stride: error: {_readable(message)}\n  hint: 'stride export --help' lists the options", file=sys.stderr)
        raise SystemExit(_WRONG_INPUT)


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="stride export",
        description="Write the results of a run as a file of another tool.",
        epilog="Exit codes: 0 good, 1 the file cannot be written, 2 the input was wrong.",
        allow_abbrev=False,
    )
    parser.add_argument("results", metavar="RESULTS", help="the folder of a run")
    parser.add_argument(
        "--mcap", metavar="FILE", required=True, help="an MCAP file, for Foxglove, PlotJuggler and Rerun"
    )
    parser.add_argument(
        "--epoch",
        metavar="DATE",
        help="the date of the simulated 0 s: 'run', when the run was made, or one such as 2026-11-27T04:09:51Z;"
        " without it, times are simulated time",
    )
    return parser


def _readable(text: str) -> str:
    """Cannot control the terminal, nor look like another message."""
    shown = "".join(c if c.isprintable() or c == "\n" else c.encode("unicode_escape").decode() for c in text)
    return re.sub(r"\n(?!  )", "\n  ", shown)


class _Formatter(logging.Formatter):
    def format(self, record: logging.LogRecord) -> str:
        return f"stride: warning: {_readable(record.getMessage())}"


def main(arguments: Optional[list[str]] = None) -> int:
    """Returns the exit code."""
    options = _parser().parse_args(arguments)
    warnings = logging.StreamHandler()
    warnings.setFormatter(_Formatter())
    logger = logging.getLogger("stride")
    logger.addHandler(warnings)
    try:
        from . import export_mcap

        made = export_mcap(options.results, options.mcap, epoch=options.epoch)
    except KeyboardInterrupt:
        print("stride: error: interrupted", file=sys.stderr)
        return _FAILED
    except (Error, ImportError, OSError) as error:
        print(f"stride: error: {_readable(str(error))}", file=sys.stderr)
        return _WRONG_INPUT if isinstance(error, (InputError, ImportError)) else _FAILED
    finally:
        logger.removeHandler(warnings)
    print(f"{_readable(str(made.file))}: {made.messages} messages of {len(made.topics)} topics")
    return _GOOD
