"""Units in Python: a class with variables and `step`, which becomes an FMU.

    import stride.unit as su

    class Thermostat(su.Unit):
        '''Heats a room.'''
        temperature = su.Input(float, unit="degC")
        power = su.Output(float, unit="W")
        gain = su.Parameter(200.0, unit="W/K")

        def step(self, now, end):
            self.power = max(0.0, self.gain * (20 - self.temperature))

`python -m stride.unit thermostat.py -o thermostat.fmu` packs it, together with this package, so that nothing but Python
has to be where it runs; numpy only if it has arrays. What a program and stride say to each other is in
docs/process-protocol.md.
"""

from __future__ import annotations

import os
import sys

from ._errors import UnitError
from ._time import Time
from ._unit import Unit
from ._variables import Input, MessageInput, MessageOutput, Output, Parameter

__all__ = ["Input", "MessageInput", "MessageOutput", "Output", "Parameter", "Time", "Unit", "UnitError", "main"]


def main(cls: type[Unit]) -> None:
    """At the end of a unit's file: runs the class for stride, or packs it, `python thermostat.py -o thermostat.fmu`.

    A file that is packed with `python -m stride.unit` need not call it; there, and where it is imported, it does nothing.
    """
    from ._process import checked, is_loading, serve

    is_imported = sys._getframe(1).f_globals.get("__name__") != "__main__"
    if is_imported or is_loading():
        return
    if len(sys.argv) > 1 or sys.stdin.isatty():
        from ._packing import command

        sys.exit(command([os.path.abspath(sys.argv[0]), "--class", cls.__name__, *sys.argv[1:]]))
    sys.exit(serve(lambda: checked(cls)))
