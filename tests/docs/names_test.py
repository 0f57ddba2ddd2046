"""names_test.py ROOT: docs/stepping.md uses the names of the code. Each function of its pseudocode is one of
master/algorithm, a qualified one (Class::function) one of that class, and each name in backticks that is written like
one of the code (step_order, kStepPolicies, stride::Time) is found in master/ or interfaces/."""

import pathlib
import re
import sys

BLOCK = re.compile(r"^```text\n(.*?)^```", flags=re.MULTILINE | re.DOTALL)
CALL = re.compile(r"(?:(\w+)::)?\b([a-z]\w*)\(")
NAME = re.compile(r"`((?:\w+::)*(?:[a-z]+(?:_[a-z]+)+|k[A-Z]\w+)|stride::\w+)(?:\(\))?`")
# g(x) is a function of mathematics; FMI's own names are not those of the code
NOT_OURS = re.compile(r"g$|fmi[23]")


def sources(root, folder):
    return [path.read_text(encoding="utf-8") for path in sorted((root / folder).rglob("*"))
            if path.suffix in (".h", ".cpp")]


def has_word(texts, word):
    return any(re.search(rf"\b{word}\b", text) for text in texts)


def unknown_functions(page, texts):
    for block in BLOCK.findall(page):
        for owner, function in CALL.findall(block):
            if NOT_OURS.match(function):
                continue
            known = [text for text in texts if re.search(rf"\b{function}\(", text)]
            if not known:
                yield f"{function}() is no function of master/algorithm"
            elif owner and not any(re.search(rf"\bclass {owner}\b|\b{owner}::", text) for text in known):
                yield f"{owner} has no function {function}()"


def unknown_names(page, texts):
    for name in NAME.findall(BLOCK.sub("", page)):
        if not has_word(texts, name.split("::")[-1]):
            yield f"{name} is not in the code"


def main(root):
    root = pathlib.Path(root)
    page = (root / "docs" / "stepping.md").read_text(encoding="utf-8")
    algorithm = sources(root, "master/algorithm")
    names = {function for block in BLOCK.findall(page) for _, function in CALL.findall(block)}
    if len(names) < 40:
        print(f"only {len(names)} functions were found in the pseudocode: is it marked as text?")
        return 1
    mistakes = sorted(set(unknown_functions(page, algorithm)) |
                      set(unknown_names(page, sources(root, "master") + sources(root, "interfaces"))))
    for mistake in mistakes:
        print(f"docs/stepping.md: {mistake}")
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
