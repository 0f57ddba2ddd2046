"""The functions that C++ sources declare or define, as far as names_test.py needs them: pairs of a class and a
function, with an empty class for free functions. Calls, comments and strings do not count."""

import re

COMMENT_OR_STRING = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.DOTALL)
DIRECTIVE = re.compile(r"^[ \t]*#(?:\\\n|[^\n])*", re.MULTILINE)
SPACE = re.compile(r"^\s*(?:inline\s+)?(?:namespace\b|extern\s*$)")
CLASS = re.compile(r"\b(?:class|struct|union)\s+(?:alignas\s*\(\w+\)\s*)?(?:\w+::)*(\w+)[^()=]*$")
NOISE = re.compile(r"\b(?:public|protected|private)\s*:|\[\[.*?\]\]|\bnoexcept\b|\bdecltype\s*\([^()]*\)")
TEMPLATE_ARGUMENTS = re.compile(r"<[^<>;{}]*>")
FUNCTION = re.compile(r"^(?P<type>[^()=]*[\w&*>\]])\s*[\s&*](?P<owners>(?:\w+::)*)(?P<name>\w+)\s*\(")
CALL = re.compile(r"\b(\w+)\s*[(<]")
NO_TYPE = re.compile(r"^\s*(?:explicit|return|throw|else|new|delete|using|typedef|friend)?\s*$")


def without_comments(text):
    """Comments are left out, strings are empty."""
    text = COMMENT_OR_STRING.sub(lambda found: " " if found[0].startswith("/") else '""', text)
    return DIRECTIVE.sub("", text)


def function_of(head, owner):
    """(class, function) of what comes before the body or the semicolon of a declaration; None if it is none of one."""
    head = " ".join(NOISE.sub(" ", head).split())
    while TEMPLATE_ARGUMENTS.search(head):
        head = TEMPLATE_ARGUMENTS.sub("", head)
    found = FUNCTION.match(head)
    if not found or NO_TYPE.match(found["type"]):
        return None
    owners = found["owners"].split("::")
    return (owners[-2] if len(owners) > 1 else owner), found["name"]


def matching_brace(text, opening):
    depth = 0
    for place in range(opening, len(text)):
        depth += {"{": 1, "}": -1}.get(text[place], 0)
        if depth == 0:
            return place
    return len(text)


def scan(text, owner=""):
    """Yields ((class, function), body) of the text without comments; a declaration has an empty body."""
    begin = place = 0
    while place < len(text):
        character = text[place]
        if character not in ";{":
            place += 1
            continue
        head, body = text[begin:place], ""
        end = place
        if character == "{":
            end = matching_brace(text, place)
            of_class = CLASS.search(NOISE.sub(" ", head))
            if SPACE.match(head) or of_class:
                yield from scan(text[place + 1:end], of_class[1] if of_class else owner)
                head = ""
            else:
                body = text[place + 1:end]
        declared = function_of(head, owner)
        if declared:
            yield declared, body
        begin = place = end + 1


def declared_functions(texts):
    return {declared for text in texts for declared, _ in scan(without_comments(text))}


def called_functions(texts):
    """(class, function) of each definition, with the names that its body calls."""
    called = {}
    for text in texts:
        for declared, body in scan(without_comments(text)):
            if body:
                called.setdefault(declared, set()).update(CALL.findall(body))
    return called
