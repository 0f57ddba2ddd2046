"""`python -m stride`, and the commands `stride` and `stride-robot` of the environment."""

import os
import signal
import sys
from typing import NoReturn

from ._installed import program


def _become(name: str) -> NoReturn:
    """Replaces this process by the program, which so gets the signals, and answers with its exit code."""
    file = program(name)
    # Python ignores them, and a program inherits what is ignored: `stride … | head` would end with an error
    for ignored in (signal.SIGPIPE, signal.SIGXFSZ):
        signal.signal(ignored, signal.SIG_DFL)
    os.execv(file, [name, *sys.argv[1:]])


def main() -> NoReturn:
    if sys.argv[1:2] == ["export"]:  # the one command that needs packages of Python
        from .export._command import main as export

        sys.exit(export(sys.argv[2:]))
    _become("stride")


def robot() -> NoReturn:
    _become("stride-robot")


if __name__ == "__main__":
    main()
