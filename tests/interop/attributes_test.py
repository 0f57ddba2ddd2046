"""docs/attributes.md lists each attribute of the schemas of FMI and SSP, and no other."""

import importlib.util
import re
import sys
from pathlib import Path
from xml.etree import ElementTree

XSD = "{http://www.w3.org/2001/XMLSchema}"
FMI1_TYPES = {"Real", "Integer", "Boolean", "String", "Enumeration"}
NUMBERS = {"Float32", "Float64", *(f"{sign}Int{bits}" for sign in ("", "U") for bits in (8, 16, 32, 64))}
FMI3_TYPES = NUMBERS | {"Boolean", "String", "Binary", "Enumeration", "Clock"}

# the heading of a table; the package and folder with the schemas, and their files; what *variable* and *type* stand for
STANDARDS = {
    "FMI 3.0": (
        ("fmpy", "schema/fmi3", "fmi3[!BLT]*.xsd fmi3Type.xsd"),
        {"variable": FMI3_TYPES, "type": {f"{name}Type" for name in FMI3_TYPES}},
    ),
    "FMI 2.0": (("fmpy", "schema/fmi2", "*.xsd"), {"variable": FMI1_TYPES}),
    "FMI 1.0": (
        ("fmpy", "schema/fmi1", "*.xsd"),
        {"variable": FMI1_TYPES, "type": {f"{name}Type" for name in FMI1_TYPES}},
    ),
    "SSP 2.0": (
        ("pyssp_standard", "resources/ssp2", "SystemStructure*.xsd"),
        {"type": FMI3_TYPES - {"Clock"} | {"Real", "Integer"}},
    ),
}


class Schemas:
    """The attributes of each element in some files."""

    def __init__(self, files):
        roots = [ElementTree.parse(file).getroot() for file in files]
        self._named = {(part.tag, part.get("name")): part for root in roots for part in root}
        self.pairs = set()
        for root in roots:
            for element in root.iter(f"{XSD}element"):
                own = element.find(f"{XSD}complexType")
                kind = own if own is not None else self._find("complexType", element.get("type"))
                if element.get("name") and kind is not None:
                    self.pairs |= {(element.get("name"), attribute) for attribute in self._attributes(kind)}

    def _find(self, tag, name):
        return self._named.get((XSD + tag, (name or "").split(":")[-1]))

    def _attributes(self, node):
        for part in node:
            if part.tag == f"{XSD}attribute" and part.get("use") != "prohibited":
                yield part.get("name")
            for tag, reference in (("attributeGroup", part.get("ref")), ("complexType", part.get("base"))):
                found = self._find(tag, reference)
                if found is not None:
                    yield from self._attributes(found)
            if part.tag in {XSD + tag for tag in ("complexContent", "simpleContent", "extension")}:
                yield from self._attributes(part)


def rows(section, groups):
    """Elements and attributes of each row of a table."""
    elements = set()
    for line in section.splitlines():
        cells = line.split("|")
        if len(cells) != 6 or cells[1].strip() in ("in", "---"):
            continue
        named = set(re.findall(r"`([^`]+)`", cells[1])).union(*(groups[name] for name in re.findall(r"\*(\w+)\*", cells[1])))
        elements = named or elements
        yield elements, re.findall(r"`([^`]+)`", cells[2])


def mistakes(section, groups, known):
    listed = set()
    for elements, attributes in rows(section, {**groups, "any": {element for element, _ in known}}):
        for attribute in attributes:
            pairs = {(element, attribute) for element in elements} & known
            if not pairs:
                yield f"no schema has the attribute '{attribute}' of {', '.join(sorted(elements))}"
            listed |= pairs
    for element, attribute in sorted(known - listed):
        yield f"'{attribute}' of <{element}> is not listed"


def schemas_of(package, folder, patterns):
    top = Path(importlib.util.find_spec(package).origin).parent / folder
    files = {file for pattern in patterns.split() for file in top.rglob(pattern)}
    assert files, f"{top} has no {patterns}"
    return Schemas(sorted(files)).pairs


def main(page):
    sections = dict(re.findall(r"^## (.+?)\n(.*?)(?=^## |\Z)", Path(page).read_text(encoding="utf-8"), re.M | re.S))
    found = [
        f"{name}: {mistake}"
        for name, (place, groups) in STANDARDS.items()
        for mistake in mistakes(sections[name], groups, schemas_of(*place))
    ]
    print("\n".join(found) or "each attribute is listed")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
