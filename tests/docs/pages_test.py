"""pages_test.py STRIDE ROOT: links between the pages lead somewhere, lines in docs/ other than a table's and what a
program prints are no longer than 120 characters, what is said not to exist does not exist, decisions are numbered
without a gap, and the command line reference in docs/traces.md has exactly the options of the program."""

import pathlib
import re
import subprocess
import sys

LINK = re.compile(r"\]\(([^)\s#]+)(#[^)\s]*)?\)")
OPTION = re.compile(r"--[a-z][a-z-]*")


def broken_links(page):
    for link, _ in LINK.findall(page.read_text(encoding="utf-8")):
        if not re.match(r"[a-z]+:", link) and not (page.parent / link).exists():
            yield f"{page}: the link to {link} leads nowhere"


MISSING = re.compile(r"[Tt]here (?:is|are) (?:still )?no `([^`]+)`"
                     r"|`([^`]+)` (?:is|are) not (?:yet |there|implemented|supported|done|known)")


def untrue_gaps(page, known):
    """Options, commands, elements and files that the page says are missing."""
    text = page.read_text(encoding="utf-8")
    for names in MISSING.findall(text):
        name = "".join(names)
        if name in known or (page.parent / name).exists():
            yield f"{page}: it says that `{name}` is missing, which exists"


def help_of(program, *command):
    return subprocess.run([program, *command, "--help"], check=True, capture_output=True, text=True).stdout


def known_names(program, root):
    """Commands, options, and elements of the scenario annotation, as pages write them."""
    commands = re.findall(r"^  (\w+)\s", help_of(program).split("Subcommands:")[1], flags=re.MULTILINE)
    annotation = (root / "master/system/declaration/annotation.cpp").read_text(encoding="utf-8")
    elements = re.findall(r'^ +\{"(\w+)", ', annotation, flags=re.MULTILINE)
    names = {f"stride {command}" for command in commands}
    for command in commands:
        names.update(OPTION.findall(help_of(program, command)))
    return names | {f"<stride:{element}>" for element in elements} | {f"<stride:{element}/>" for element in elements}


def gaps_between_decisions(root):
    numbers = sorted(int(path.name[:4]) for path in (root / "docs/decisions").glob("[0-9]*.md"))
    for number in sorted(set(range(1, numbers[-1] + 1)) - set(numbers)):
        yield f"docs/decisions: {number:04} is missing"


def long_lines(page):
    is_console = False
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        if line.startswith("```"):
            is_console = line == "```console"
        is_printed = is_console and not line.startswith("$ ")
        if len(line) > 120 and not line.startswith("|") and not is_printed:
            yield f"{page}:{number}: {len(line)} characters, expected 120 at most"


def wrong_options(program, page, *group):
    """The section "### stride [GROUP] COMMAND" names each option of that command, and no other."""
    prefix = " ".join(["stride", *group])
    sections = dict(re.findall(rf"^### `{prefix} (\w+)[^\n]*\n(.*?)(?=^##|\Z)", page.read_text(encoding="utf-8"),
                               flags=re.MULTILINE | re.DOTALL))
    commands = re.findall(r"^  (\w+)\s", help_of(program, *group).split("Subcommands:")[1], flags=re.MULTILINE)
    if not commands or set(commands) != set(sections):
        yield f"{page}: the commands of {prefix} are {sorted(commands)}, the page has {sorted(sections)}"
        return
    for command in commands:
        text = help_of(program, *group, command).split("Options:")[1].split("Subcommands:")[0].split("Exit codes")[0]
        options = set(OPTION.findall(text)) - {"--help"}
        named = set(re.findall(r"^\| `(?:-\w, )?(--[a-z-]+)", sections[command], flags=re.MULTILINE))
        for option in sorted(options ^ named):
            yield f"{page}: {prefix} {command} {option} is {'not described' if option in options else 'no option'}"


def main(program, root):
    root = pathlib.Path(root)
    docs = sorted((root / "docs").rglob("*.md"))
    pages = sorted(root.glob("*.md")) + docs
    pages += sorted((root / "units").rglob("*.md")) + sorted((root / "scenarios").rglob("*.md"))
    mistakes = list(wrong_options(program, root / "docs" / "traces.md", "trace"))
    mistakes += gaps_between_decisions(root)
    known = known_names(program, root)
    for page in pages:
        mistakes += broken_links(page)
        mistakes += untrue_gaps(page, known)
    for page in docs:
        mistakes += long_lines(page)
    print("\n".join(mistakes) if mistakes else f"{len(pages)} pages are right")
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
