"""stride, a co-simulation master: FMI units, wired and run as an SSP scenario says.

    run = stride.run("nfc_approach")                     # a run, to its end
    run.signals["sensor.capacitor.voltage"]              # a numpy array
    run.verdicts                                         # of units and checks
    stride.compare(run, "before")                        # where it differs from another one, and why
    run.to_mcap("run.mcap")                              # for Foxglove, PlotJuggler and Rerun

    with stride.Simulation("x.ssd") as sim:              # step by step
        sim.step(until=1.5)
        sim["sensor.led"]

    stride.campaign("variations.xosc")                   # many of them

    import stride.unit as su                             # units in Python: help(stride.unit)

The program is on the PATH of the environment as `stride`; `python -m stride` is the same.
"""

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._errors import Error, InputError, MisuseError, RunError
    from ._installed import program
    from ._program import Campaign, campaign, run
    from .comparison import Comparison, Difference, Extreme, InputDifference, compare
    from .export import McapFile, export_mcap
    from .results import Run, Signals
    from .simulation import Message, Simulation, Variable, Verdict

__all__ = [
    "Campaign",
    "Comparison",
    "Difference",
    "Error",
    "Extreme",
    "InputDifference",
    "InputError",
    "McapFile",
    "Message",
    "MisuseError",
    "Run",
    "RunError",
    "Signals",
    "Simulation",
    "Variable",
    "Verdict",
    "campaign",
    "compare",
    "export_mcap",
    "program",
    "run",
]

# imported when they are used, so that the command `stride` does not wait for numpy
_MODULES = {
    "_errors": ("Error", "InputError", "MisuseError", "RunError"),
    "_installed": ("program",),
    "_program": ("Campaign", "campaign", "run"),
    "comparison": ("Comparison", "Difference", "Extreme", "InputDifference", "compare"),
    "export": ("McapFile", "export_mcap"),
    "results": ("Run", "Signals"),
    "simulation": ("Message", "Simulation", "Variable", "Verdict"),
}


def __getattr__(name: str) -> Any:
    for module, names in _MODULES.items():
        if name in names:
            globals()[name] = getattr(importlib.import_module(f".{module}", __name__), name)
            return globals()[name]
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return __all__
