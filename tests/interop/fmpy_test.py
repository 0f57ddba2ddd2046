"""fmpy_test.py FMU [--validate-only]: FMPy finds nothing wrong with the unit's description, and simulates it, without and with Event Mode."""

import math
import sys

import numpy as np
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu


def outputs(description):
    """The outputs that FMPy can record: not clocked, no clocks, no binaries."""
    skipped = ("Clock", "Binary")
    return [v.name for v in description.modelVariables
            if v.causality == "output" and v.type not in skipped and not v.clocks]


def simulate(path, event_mode):
    """What is wrong with a short simulation."""
    problems = []
    recorded = outputs(read_model_description(path))
    result = simulate_fmu(path, start_time=0.0, stop_time=0.05, output_interval=1e-3, output=recorded,
                          fmi_type="CoSimulation", use_event_mode=event_mode, early_return_allowed=event_mode)
    end = result["time"][-1]
    if not math.isclose(end, 0.05, abs_tol=1e-9):
        problems.append(f"the simulation ended at {end} s instead of 0.05 s")
    for name in result.dtype.names[1:]:
        column = result[name]
        if np.issubdtype(column.dtype, np.floating) and not np.all(np.isfinite(column)):
            problems.append(f"{name} is not finite")
    print(f"event mode {event_mode}: {len(result)} rows, {len(recorded)} outputs, end {end} s")
    return problems


def main(path, validate_only=False):
    problems = [f"validation: {problem}" for problem in validate_fmu(path)]
    if not validate_only:
        problems += simulate(path, event_mode=False) + simulate(path, event_mode=True)
    for problem in problems:
        print(f"FAILED: {problem}")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], "--validate-only" in sys.argv[2:]))
