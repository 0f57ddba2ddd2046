"""pyssp_standard_test.py STRIDE FOLDER: a package that pyssp_standard has written is run by stride as it is, and what
`stride complete` has written is read by pyssp_standard. The units are those of python_units/. Results go into FOLDER."""

import os
import pathlib
import shutil
import subprocess
import sys

from pyssp_standard.common_content_ssc import TypeBoolean, TypeInteger, TypeReal, TypeString
from pyssp_standard.ssd import SSD, Component, Connection, Connector, DefaultExperiment, ParameterBinding, System as Group
from pyssp_standard.ssp import SSP
from pyssp_standard.ssv import SSV

from python_units_test import build, python_library, skipped_without_python_library
from reference_master import Master
from stride_run import System, differences, run_file

WIRES = [("first.y", "second.u"), ("count.steps", "echo.stride"), ("count.running", "echo.up")]
START_VALUES = {"first.u": 1.5, "first.time_constant": 0.25, "second.time_constant": 0.1, "count.stride": 3}
TYPES = {"u": TypeReal(None), "y": TypeReal(None), "time_constant": TypeReal(None), "steps": TypeInteger(),
         "stride": TypeInteger(), "running": TypeBoolean(), "up": TypeBoolean(), "label": TypeString()}


def connector(name, kind):
    return Connector(name=name, kind=kind, type_=TYPES[name])


def component(name, fmu, inputs, outputs, parameters=()):
    made = Component()
    made.name, made.component_type, made.source = name, "application/x-fmu-sharedlibrary", f"resources/{fmu.name}"
    made.connectors = [connector(name, kind) for names, kind in
                       ((inputs, "input"), (outputs, "output"), (parameters, "parameter")) for name in names]
    return made


def wire(start, end):
    (start_element, start_connector), (end_element, end_connector) = start, end
    return Connection(start_element=start_element, start_connector=start_connector,
                      end_element=end_element, end_connector=end_connector)


def write_package(path, values, fmus):
    """The second filter is in a system of its own, and the values are in a file of their own."""
    with SSV(values, mode="w", name="values") as ssv:
        for name, value in START_VALUES.items():
            kind, unit = ("Integer", None) if isinstance(value, int) else ("Real", "1")  # it writes no Real without a unit
            ssv.add_parameter(name.replace("second", "inner.second"), kind, value=value, unit=unit)
    low_pass, counter = fmus["low_pass_fmi3"], fmus["counter_fmi2"]
    with SSP(path, mode="w") as package:
        for file in (low_pass, counter, values):
            package.add_resource(file)
        with package.system_structure as ssd:
            ssd.name, ssd.version = "outer", "1.0"
            ssd.system = Group(name="outer")
            inner = Group(name="inner")
            inner.connectors = [connector("u", "input"), connector("y", "output")]
            inner.elements = [component("second", low_pass, ["u"], ["y"], ["time_constant"])]
            inner.connections = [wire((None, "u"), ("second", "u")), wire(("second", "y"), (None, "y"))]
            ssd.system.elements = [component("first", low_pass, ["u"], ["y"], ["time_constant"]), inner,
                                   component("count", counter, ["stride"], ["steps", "running"]),
                                   component("echo", counter, ["stride", "up"], ["steps"])]
            ssd.system.connections = [wire(("first", "y"), ("inner", "u")), wire(("count", "steps"), ("echo", "stride")),
                                      wire(("count", "running"), ("echo", "up"))]
            ssd.system.parameter_bindings = [ParameterBinding(source=f"resources/{values.name}")]
            ssd.default_experiment = DefaultExperiment()
            ssd.default_experiment.start_time, ssd.default_experiment.stop_time = 0.0, 1.0
            if warnings := ssd.check_connections():
                raise ValueError(warnings)


def check_theirs(program, fmus, folder, environment):
    package = folder / "theirs.ssp"
    write_package(package, folder / "values.ssv", fmus)
    flat = System({"first": fmus["low_pass_fmi3"], "second": fmus["low_pass_fmi3"], "count": fmus["counter_fmi2"],
                   "echo": fmus["counter_fmi2"]}, WIRES, START_VALUES, step="0.05", stop="1")
    expected = {name.replace("second", "inner.second"): column for name, column in Master(flat).run().items()}
    return differences(run_file(program, package, folder / "stride", "--step", flat.step, environment=environment), expected)


def check_ours(program, fmus, folder, environment):
    """Every connector and connection of ours is there."""
    ssd_file = folder / "ours.ssd"
    system = System({"first": fmus["low_pass_fmi2"], "second": fmus["low_pass_fmi2"]}, [("first.y", "second.u")])
    ssd_file.write_text(system.ssd(), encoding="utf-8")
    subprocess.run([program, "complete", str(ssd_file)], check=True, env={**os.environ, **environment})
    with SSD(ssd_file, mode="r") as ssd:
        found = {(element.name, one.name, one.kind) for element in ssd.system.elements for one in element.connectors}
        wires = [(c.start_element, c.start_connector, c.end_element, c.end_connector) for c in ssd.system.connections]
    expected = {(name, variable, kind) for name in system.units for variable, kind in (("u", "input"), ("y", "output"))}
    problems = [] if expected <= found else [f"the connectors are {sorted(found)}"]
    return problems + ([] if wires == [("first", "y", "second", "u")] else [f"the connections are {wires}"])


def main(program, folder):
    if (code := skipped_without_python_library()) is not None:
        return code
    folder = pathlib.Path(folder).resolve()
    shutil.rmtree(folder, ignore_errors=True)
    fmus = build(folder / "fmus")
    environment = {"LD_PRELOAD": str(python_library())}
    mistakes = 0
    for check in (check_theirs, check_ours):
        problems = check(program, fmus, folder, environment)
        name = check.__name__.removeprefix("check_")
        print(f"{name}: {'good' if not problems else 'FAILED'}", *problems, sep="\n  ")
        mistakes += bool(problems)
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
