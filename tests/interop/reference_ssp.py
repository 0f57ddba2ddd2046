"""A reader of SSP system files that shares no line with stride: what reference_master.py needs of a system, nested or not,
with parameter sets and mappings in other files and with linear transformations. It leaves out what has no numbers in it."""

import dataclasses
from xml.etree import ElementTree

from stride_run import System

SSD = "{http://ssp-standard.org/SSP1/SystemStructureDescription}"
SSC = "{http://ssp-standard.org/SSP1/SystemStructureCommon}"
SSV = "{http://ssp-standard.org/SSP1/SystemStructureParameterValues}"
SSM = "{http://ssp-standard.org/SSP1/SystemStructureParameterMapping}"
KNOWN = {"ssd": SSD, "ssc": SSC, "ssv": SSV, "ssm": SSM}


class NothingToCompare(Exception):
    """Why a unit or a system is left out."""


@dataclasses.dataclass(frozen=True)
class Linear:
    """value -> factor * value + offset"""
    factor: float = 1.0
    offset: float = 0.0

    def of(self, value):
        return self.factor * value + self.offset if self != Linear() else value

    def after(self, first):
        return Linear(self.factor * first.factor, self.factor * first.offset + self.offset)


def parsed(path):
    """The root element. A known prefix may lack its declaration."""
    text = path.read_text(encoding="utf-8-sig")
    for prefix, namespace in KNOWN.items():
        if f"<{prefix}:" in text and f"xmlns:{prefix}=" not in text:
            start = text.index(f"<{prefix}:")
            end = next(i for i in range(start, len(text)) if text[i] in " \t\r\n/>")
            text = f'{text[:end]} xmlns:{prefix}="{namespace[1:-1]}"{text[end:]}'
    return ElementTree.fromstring(text.partition("?>")[2] if text.startswith("<?xml") else text)


def linear_of(element):
    """The transformation in a connection or a mapping entry."""
    for child in element:
        if child.tag != f"{SSC}LinearTransformation":
            if child.tag.endswith("Transformation"):
                raise NothingToCompare("it has a transformation that is not linear")
            continue
        return Linear(float(child.get("factor", "1")), float(child.get("offset", "0")))
    return Linear()


def value_of(parameter):
    kind = parameter[0].tag.removeprefix(SSV)
    text = parameter[0].get("value")
    return {"Real": float, "Integer": int, "Boolean": lambda word: word in ("true", "1")}.get(kind, str)(text)


class Reader:
    """Elements are known by their paths, tuples of names below the system of the file; an end of a connection is the path of
    a component or a system and the name of one of its connectors."""

    def __init__(self, path):
        self.folder = path.parent
        self.root = parsed(path)
        self.system = self.root.find(f"{SSD}System")
        if self.system is None:
            raise NothingToCompare("it has no system")
        self.files = {}  # of the components
        self.connectors = {}  # of the systems and components: their units of measure by name
        self.kinds = {}  # of the ends that are declared: "input", "output", …
        self.sources = {}  # of an end: the end that feeds it, and how
        self.values = {}  # of the components' variables
        self.read_elements(self.system, ())
        self.read_values(self.system, ())

    def children(self, system):
        elements = system.find(f"{SSD}Elements")
        return [] if elements is None else [child for child in elements if child.tag in (f"{SSD}System", f"{SSD}Component")]

    def read_elements(self, element, path):
        for connector in element.findall(f"{SSD}Connectors/{SSD}Connector"):
            self.kinds[path, connector.get("name")] = connector.get("kind")
        self.connectors[path] = {connector.get("name"): next((kind.get("unit") for kind in connector if kind.get("unit")), None)
                                 for connector in element.findall(f"{SSD}Connectors/{SSD}Connector")}
        if element.tag == f"{SSD}Component":
            self.files[path] = self.folder / element.get("source")
            return
        for child in self.children(element):
            self.read_elements(child, (*path, child.get("name")))
        for wire in element.findall(f"{SSD}Connections/{SSD}Connection"):
            start, end = [((*path, wire.get(f"{word}Element")) if wire.get(f"{word}Element") else path,
                           wire.get(f"{word}Connector")) for word in ("start", "end")]
            if self.is_target(start, path) and not self.is_target(end, path):  # the connectors' kinds are what counts
                start, end = end, start
            units = {self.connectors[place].get(name) for place, name in (start, end)} - {None}
            if len({unit.replace(".", "") for unit in units}) > 1:  # "Nm" is "N.m"
                raise NothingToCompare("it converts units of measure")
            self.sources[end] = (start, linear_of(wire))

    def is_target(self, end, system):
        """Whether the end takes values in a connection of this system."""
        return self.kinds.get(end) == ("output" if end[0] == system else "input")

    def read_values(self, element, path):
        """Those of an inner element first: outer ones prevail."""
        for child in self.children(element):
            self.read_values(child, (*path, child.get("name")))
        for binding in element.findall(f"{SSD}ParameterBindings/{SSD}ParameterBinding"):
            for name, value in self.bound_values(binding):
                self.assign(path, name, value)

    def bound_values(self, binding):
        """By the names that the element knows. With a mapping, what it does not name is not meant."""
        inline = binding.find(f"{SSD}ParameterValues")
        values = parsed(self.folder / binding.get("source")) if binding.get("source") else inline
        given = {binding.get("prefix", "") + parameter.get("name"): value_of(parameter)
                 for parameter in values.iter(f"{SSV}Parameter")}
        mapping = binding.find(f"{SSD}ParameterMapping")
        if mapping is None:
            return list(given.items())
        if mapping.get("source"):
            mapping = parsed(self.folder / mapping.get("source"))
        entries = list(mapping.iter(f"{SSM}MappingEntry"))
        if any(entry.get("source") is None or entry.get("target") is None for entry in entries):
            raise NothingToCompare("it is malformed")
        return [(entry.get("target"), linear_of(entry).of(given[entry.get("source")]))
                for entry in entries if entry.get("source") in given]

    def assign(self, path, name, value):
        """Of a component, to its variable; of a system, to its connector, or to an element in it."""
        if path in self.files:
            self.values[path, name] = value
        elif name in self.connectors[path]:
            for end, (start, linear) in self.sources.items():
                if start == (path, name) and end[0] != path[:-1]:
                    self.assign(*end, linear.of(value))
        for inner in self.connectors:
            if len(inner) == len(path) + 1 and inner[:-1] == path and name.startswith(inner[-1] + "."):
                self.assign(inner, name[len(inner[-1]) + 1:], value)

    def feed(self, end):
        """The output of a component that feeds the end, and how; nothing if there is none."""
        linear = Linear()
        while end in self.sources:
            end, first = self.sources[end]
            linear = linear.after(first)
            if end[0] in self.files:
                return end, linear
        return None


def read_system(path, default_step, stop):
    """The system, whose units have names without dots, and the names that stride gives them. Raises NothingToCompare."""
    reader = Reader(path)
    experiment = reader.root.find(f"{SSD}DefaultExperiment")
    if experiment is not None and float(experiment.get("startTime", "0")) != 0:
        raise NothingToCompare("it does not start at 0 s")
    if not reader.files:
        raise NothingToCompare("it has no components")
    for file in reader.files.values():
        if not file.is_file():
            raise NothingToCompare(f"{file.name} is not there")
    short = {place: f"unit{i}" for i, place in enumerate(reader.files)}
    fed = {end: reader.feed(end) for end in reader.sources if end[0] in reader.files}
    wires = {f"{short[end[0]]}.{end[1]}": (f"{short[source[0][0]]}.{source[0][1]}", source[1])
             for end, source in fed.items() if source}
    steps = [element.get("baseStepSize") or element.get("stepSize") for element in reader.root.iter()
             if element.tag.endswith(("}FixedStepAlgorithm", "}FixedStepMaster"))]
    system = System({short[place]: file for place, file in reader.files.items()},
                    [(source, target) for target, (source, _) in wires.items()],
                    {f"{short[place]}.{name}": value for (place, name), value in reader.values.items()},
                    step=steps[0] if steps else default_step, stop=stop,
                    transformations={target: linear.of for target, (_, linear) in wires.items() if linear != Linear()})
    return system, {name: ".".join(place) for place, name in short.items()}
