"""The directive ``c-header``: what a header of C declares, with the comment above each declaration.

Sections are the comments ``/* ---- Title ---- */``. In a comment, what is indented is a literal block, a paragraph that
begins with a word, a full stop and two spaces has a title, and names of the header are links.
"""

import re
import textwrap
from pathlib import Path

from clang import cindex
from docutils import nodes
from docutils.statemachine import StringList
from sphinx.util.docutils import SphinxDirective
from sphinx.util.nodes import nested_parse_with_titles

# instead of the headers of a compiler, which need not be there
SYSTEM_HEADERS = {
    "stddef.h": "typedef unsigned long size_t;\n#define NULL ((void*)0)\n",
    "stdint.h": "typedef signed char int8_t; typedef unsigned char uint8_t; typedef int int32_t;"
    " typedef unsigned int uint32_t; typedef long int64_t;\n#define INT64_C(c) c##L\n",
}
SECTION = re.compile(r"^/\* ---- (.+) ---- \*/$")
KIND = cindex.CursorKind


class Header:
    """A header, parsed. Raises ValueError if it is not C."""

    def __init__(self, path: Path) -> None:
        stubs = [(f"/stubs/{name}", text) for name, text in SYSTEM_HEADERS.items()]
        unit = cindex.Index.create().parse(
            str(path),
            args=["-xc", "-std=c11", "-fparse-all-comments", "-nostdinc", "-isystem/stubs"],
            unsaved_files=stubs,
            options=cindex.TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD,
        )
        mistakes = [str(each) for each in unit.diagnostics if each.severity >= cindex.Diagnostic.Error]
        if mistakes:
            raise ValueError("\n".join(mistakes))
        self.lines = path.read_text(encoding="utf-8").splitlines()
        self.cursors = [each for each in _declarations(unit.cursor) if str(each.location.file) == str(path)]
        self.cursors.sort(key=lambda each: each.location.offset)
        self.roles = dict(role for each in self.cursors for role in _roles(each))

    def rst(self) -> list[str]:
        sections = [(number, match[1]) for number, line in enumerate(self.lines, 1) if (match := SECTION.match(line))]
        out = self._prose(_opening_comment(self.lines))
        for cursor in self.cursors:
            while sections and sections[0][0] < cursor.location.line:
                title = sections.pop(0)[1]
                out += ["", title, "-" * len(title), ""]
            out += self._declaration(cursor)
        return out

    def _declaration(self, cursor: cindex.Cursor) -> list[str]:
        prose = self._prose(_text(cursor.raw_comment))
        if cursor.kind == KIND.ENUM_DECL:
            return self._block(f"c:enum:: {cursor.spelling}", prose, [
                (f"c:enumerator:: {each.spelling} = {each.enum_value}", each) for each in cursor.get_children()
            ])
        if cursor.kind == KIND.STRUCT_DECL:
            return self._block(f"c:struct:: {cursor.spelling}", prose, [
                (f"c:member:: {_declare(each.type, each.spelling)}", each) for each in cursor.get_children()
            ])
        if cursor.kind == KIND.TYPEDEF_DECL:
            function = cursor.underlying_typedef_type.get_pointee()
            parameters = ", ".join(
                _declare(each.type, each.spelling) for each in cursor.get_children() if each.kind == KIND.PARM_DECL
            )
            result = function.get_result().spelling
            return self._block(f"c:type:: {result} (*{cursor.spelling})({parameters})", prose)
        if cursor.kind == KIND.FUNCTION_DECL:
            parameters = ", ".join(_declare(each.type, each.spelling) for each in cursor.get_arguments()) or "void"
            return self._block(f"c:function:: {_declare(cursor.result_type, cursor.spelling)}({parameters})", prose)
        value = " ".join(each.spelling for each in list(cursor.get_tokens())[1:])
        return self._block(f"c:macro:: {cursor.spelling}", [f"``{value}``", ""])

    def _block(self, directive: str, prose: list[str], members=(), is_member=False) -> list[str]:
        lines = prose + [
            line
            for declaration, each in members
            for line in self._block(declaration, self._prose(_text(each.raw_comment)), is_member=True)
        ]
        options = ["   :no-contents-entry:"] if is_member else []
        return [f".. {directive}", *options, "", *(f"   {line}" if line else "" for line in lines)]

    def _prose(self, comment: str) -> list[str]:
        out: list[str] = []
        for paragraph in filter(None, re.split(r"\n{2,}", comment)):
            if paragraph.startswith("  "):
                out += ["::", "", *textwrap.indent(textwrap.dedent(paragraph), "   ").splitlines(), ""]
                continue
            escaped = re.sub(r"([*\\|]|(?<=\w):(?=\w))", r"\\\1", paragraph)
            escaped = re.sub(r"`([^`]*)`", lambda code: "``" + code[1].replace("\\", "") + "``", escaped)
            linked = re.sub(r"(?<![`\w])(\w+)\b(\(\))?(?!`)", self._link, escaped)
            out += [*re.sub(r"^(\w+\.)  ", r"**\1** ", linked).splitlines(), ""]
        return out

    def _link(self, match: re.Match) -> str:
        role = self.roles.get(match[1])
        return f":c:{role}:`{match[1]}`" if role else match[0]


def _declarations(cursor: cindex.Cursor):
    for each in cursor.get_children():
        is_function_type = (
            each.kind == KIND.TYPEDEF_DECL and each.underlying_typedef_type.kind == cindex.TypeKind.POINTER
        )
        is_constant = each.kind == KIND.MACRO_DEFINITION and len(list(each.get_tokens())) > 1
        if is_function_type or is_constant or each.kind in (KIND.ENUM_DECL, KIND.STRUCT_DECL, KIND.FUNCTION_DECL):
            yield each
        elif each.kind == KIND.LINKAGE_SPEC:
            yield from _declarations(each)


def _roles(cursor: cindex.Cursor):
    """The role of Sphinx's domain of C for a name, and those of its enumerators."""
    kinds = {KIND.ENUM_DECL: "enum", KIND.STRUCT_DECL: "struct", KIND.TYPEDEF_DECL: "type", KIND.FUNCTION_DECL: "func"}
    yield cursor.spelling, kinds.get(cursor.kind, "macro")
    if cursor.kind == KIND.ENUM_DECL:
        for each in cursor.get_children():
            yield each.spelling, "enumerator"


def _declare(type_: cindex.Type, name: str) -> str:
    spelling = type_.spelling
    return f"{spelling}{name}" if spelling.endswith("*") else f"{spelling} {name}"


def _opening_comment(lines: list[str]) -> str:
    text = "\n".join(lines)
    return _text(text[: text.index("*/") + 2]) if text.startswith("/*") else ""


def _text(comment: str | None) -> str:
    """Without its delimiters and stars; empty for the title of a section."""
    if comment and SECTION.match(comment):
        return ""
    body = (comment or "").removeprefix("/*").removesuffix("*/")
    first, *rest = body.splitlines() or [""]
    starred = all(line.lstrip().startswith("*") or not line.strip() for line in rest)
    rest = [re.sub(r"^\s*\* ?", "", line) if starred else line.strip() for line in rest]
    return "\n".join([first.strip(), *(line.rstrip() for line in rest)]).strip("\n")


class CHeader(SphinxDirective):
    required_arguments = 1

    def run(self):
        relative, path = self.env.relfn2path(self.arguments[0])
        self.env.note_dependency(relative)
        self.env.note_dependency(__file__)
        try:
            lines = Header(Path(path)).rst()
        except (OSError, ValueError) as error:
            raise self.error(f"{path}: {error}") from error
        container = nodes.section()
        container.document = self.state.document
        nested_parse_with_titles(self.state, StringList(lines, source=path), container)
        return container.children


def setup(app):
    app.add_directive("c-header", CHeader)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
