"""The blocks of code in Markdown pages that are tests. A comment in the line above a fence marks them:

    <!-- test: unit NAME -->              C++, a unit for stride_add_unit(NAME …)
    <!-- test: resource UNIT FILE -->     a file in the resources folder of that unit
    <!-- test: scenario NAME -->          XML, a scenario NAME.ssd to be run
    <!-- test: file FILE -->              a file beside the scenarios, such as a parameter set
    <!-- test: result SCENARIO FILE -->   how that file in the results folder of the scenario begins
    <!-- test: session NAME -->           console, commands behind "$ " and what they print, beside the files; blocks of
                                          one name are one session
    <!-- test: part PATH -->              lines of that file of the repository, indented in any way

blocks.py extract FOLDER PAGE...   writes them into the folder and prints "unit NAME", "scenario NAME" and
                                   "session NAME", one a line
blocks.py check PAGE...            fails for a page without a marked block, for a result without its scenario, and for a
                                   part that is not part of its file
"""

import pathlib
import re
import sys

MARKER = re.compile(r"<!--\s*test:\s*(.*?)\s*-->")
FENCE = re.compile(r"```(\w*)")
NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]*")
PATH = re.compile(rf"{NAME.pattern}(/{NAME.pattern})*")
WORDS = {"unit": 1, "resource": 2, "scenario": 1, "file": 1, "result": 2, "session": 1, "part": 1}
ROOT = pathlib.Path(__file__).parents[2]
TESTS = ("unit", "scenario", "session")
LANGUAGES = {"unit": "cpp", "scenario": "xml", "session": "console"}


class Mistake(Exception):
    """What is wrong with a page, with its file and line."""


def target(kind, words):
    """Where a block is written, below the folder."""
    return {
        "unit": "{0}/unit.cpp",
        "resource": "{0}/resources/{1}",
        "scenario": "{0}.ssd",
        "file": "{0}",
        "result": "{0}.expected/{1}",
        "session": "{0}.session",
    }[kind].format(*words)


def blocks_of(page):
    """Yields (kind, words, text) of each marked block of a page."""
    lines = page.read_text(encoding="utf-8").splitlines()
    number = 0
    fence = None  # of an unmarked block: markers in it are part of an example
    while number < len(lines):
        line = lines[number]
        number += 1
        if line.startswith("```"):
            fence = None if fence else line
            continue
        marker = MARKER.fullmatch(line.strip())
        if fence or not marker:
            continue
        place = f"{page}:{number}"
        kind, *words = marker.group(1).split() or [""]
        pattern = PATH if kind == "part" else NAME
        if kind not in WORDS or len(words) != WORDS[kind] or not all(map(pattern.fullmatch, words)):
            raise Mistake(f"{place}: '{marker.group(1)}' is not a test; see tests/docs/blocks.py for those there are")
        opening = FENCE.fullmatch(lines[number]) if number < len(lines) else None
        if not opening:
            raise Mistake(f"{place}: expected a fenced block in the next line")
        if opening.group(1) != LANGUAGES.get(kind, opening.group(1)):
            raise Mistake(f"{place}: expected ```{LANGUAGES[kind]}, the page has ```{opening.group(1)}")
        first = number + 1
        try:
            number = lines.index("```", first) + 1
        except ValueError:
            raise Mistake(f"{place}: the fenced block has no end") from None
        yield kind, words, "\n".join(lines[first:number - 1]) + "\n"


def write(path, text):
    """Leaves a file alone that is right already, so that nothing is built again."""
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def extract(folder, pages):
    written = {}
    found = []
    for page in filter(pathlib.Path.exists, pages):
        for kind, words, text in blocks_of(page):
            if kind == "part":
                continue
            path = target(kind, words)
            if kind == "session":
                written[path] = written.get(path, "") + text
            elif written.setdefault(path, text) != text:
                raise Mistake(f"{page}: '{kind} {' '.join(words)}' differs from the block of that name before it")
            entry = f"{kind} {words[0]}"
            if kind in TESTS and entry not in found:
                found.append(entry)
    for path, text in written.items():
        write(folder / path, text)
    for old in sorted(folder.rglob("*")):
        if old.is_file() and str(old.relative_to(folder)) not in written:
            old.unlink()
    print("\n".join(found))


def without_indentation(text):
    return "\n" + "".join(f"{line.strip()}\n" for line in text.splitlines())


def check_part(page, path, text):
    file = ROOT / path
    if not file.is_file():
        raise Mistake(f"{page}: there is no file {path}")
    if without_indentation(text) not in without_indentation(file.read_text(encoding="utf-8")):
        raise Mistake(f"{page}: what it shows of {path} is not in that file:\n{text}")


def check(pages):
    scenarios, results = set(), []
    for page in pages:
        blocks = list(blocks_of(page)) if page.exists() else []
        if not any(kind in TESTS for kind, _, _ in blocks):
            raise Mistake(f"{page}: no block in it is marked as a test")
        print(f"{page}: {len(blocks)} blocks")
        scenarios |= {words[0] for kind, words, _ in blocks if kind == "scenario"}
        results += [(page, words) for kind, words, _ in blocks if kind == "result"]
        for kind, words, text in blocks:
            if kind == "part":
                check_part(page, words[0], text)
    for page, (scenario, file) in results:
        if scenario not in scenarios:
            raise Mistake(f"{page}: the result {file} is of '{scenario}', which is not a scenario")


def main(arguments):
    try:
        command, *rest = arguments
        if command == "extract":
            extract(pathlib.Path(rest[0]), list(map(pathlib.Path, rest[1:])))
        else:
            check(list(map(pathlib.Path, rest)))
    except Mistake as mistake:
        print(mistake, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
