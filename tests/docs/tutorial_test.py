"""tutorial_test.py CMAKE BUILD PAGE FOLDER: follows a tutorial to the letter. Its marked blocks, which are files and
sessions, are taken one after the other from the top of the page, by somebody who has an empty home folder, and stride
installed from BUILD in ~/stride. A session prints what the page shows, a line of … standing for any number of lines;
numbers may differ by rounding. The commands of all sessions are given to one shell. Parts of the repository's files are
compared by blocks.py."""

import math
import os
import pathlib
import shutil
import subprocess
import sys

import blocks
from session_test import commands_of

END = "== end of command"


class Shell:
    """A shell that stays in its folder, and keeps its variables, from command to command."""

    def __init__(self, home):
        environment = {key: value for key, value in os.environ.items()
                       if key not in ("STRIDE_UNITS", "LD_LIBRARY_PATH", "CMAKE_PREFIX_PATH")}
        self.process = subprocess.Popen(["bash"], cwd=home, env={**environment, "HOME": str(home)}, text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def run(self, command):
        """What the command prints, and its exit code."""
        if command.endswith("\\"):
            raise blocks.Mistake(f"a command has to stand in one line:\n$ {command}")
        self.process.stdin.write(f"{command}\necho '{END}' $?\n")
        self.process.stdin.flush()
        printed = []
        for line in self.process.stdout:
            if line.startswith(END):
                return "".join(printed), int(line[len(END):])
            printed.append(line)
        raise blocks.Mistake(f"the shell has ended:\n$ {command}\n{''.join(printed)}")

    def folder(self):
        return pathlib.Path(self.run("pwd")[0].strip())


def is_same_word(word, expected):
    try:
        return math.isclose(float(word), float(expected), rel_tol=1e-9, abs_tol=1e-12)
    except ValueError:
        return word == expected


def words(line):
    return line.replace(",", " , ").split()


def is_same_line(line, expected):
    found, wanted = words(line), words(expected)
    return len(found) == len(wanted) and all(map(is_same_word, found, wanted))


def is_same(printed, expected):
    if not expected:
        return not printed
    if expected[0].strip() == "…":
        return any(is_same(printed[skipped:], expected[1:]) for skipped in range(len(printed) + 1))
    return bool(printed) and is_same_line(printed[0], expected[0]) and is_same(printed[1:], expected[1:])


def follow(page, shell):
    """Yields what goes otherwise than the page says."""
    for kind, (name, *_), text in blocks.blocks_of(page):
        if kind == "file":
            blocks.write(shell.folder() / name, text)
            continue
        if kind == "part":
            continue
        if kind != "session":
            raise blocks.Mistake(f"{page}: a tutorial has files, sessions and parts only, and no '{kind} {name}'")
        for command, expected in commands_of(text):
            printed, status = shell.run(command)
            if not is_same(printed.splitlines(), expected.splitlines()):
                yield f"$ {command}\n{printed}--- the page says\n{expected}"
            elif status != 0 and not expected:
                yield f"$ {command}\nended with the exit code {status}"


def main(cmake, build, page, folder):
    page, home = pathlib.Path(page), pathlib.Path(folder).resolve()
    shutil.rmtree(home, ignore_errors=True)
    home.mkdir(parents=True)
    subprocess.run([cmake, "--install", build, "--prefix", home / "stride"], check=True, stdout=subprocess.DEVNULL)
    mistakes = list(follow(page, Shell(home)))
    print("\n".join(mistakes) if mistakes else f"{page} is right")
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
