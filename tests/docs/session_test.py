"""session_test.py STRIDE SESSION FOLDER: each command of the session, behind "$ ", prints what the session shows below
it. They run one after another in the folder, in which are the files that lie beside the session; $STRIDE is the
repository. Where pip fails, PyPI cannot be reached, a film needs OpenGL, and GNU parallel may not be installed: the exit
code is 77 then, but 1 in CI."""

import os
import pathlib
import shutil
import subprocess
import sys


def commands_of(session):
    """Yields each command with what it should print."""
    for piece in ("\n" + session).split("\n$ ")[1:]:
        command, _, output = piece.partition("\n")
        yield command, output if output.endswith("\n") or not output else output + "\n"


def main(program, session, folder):
    session, folder = pathlib.Path(session), pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for file in session.parent.iterdir():
        if file.is_file() and file.suffix != ".session":
            shutil.copy(file, folder)
    path = f"{pathlib.Path(program).parent}{os.pathsep}{os.environ['PATH']}"
    environment = {**os.environ, "PATH": path, "STRIDE": str(pathlib.Path(__file__).parents[2]),
                   "PKG_CONFIG_PATH": str(pathlib.Path(program).parents[1] / "pkgconfig"),
                   "PYTHONPATH": str(pathlib.Path(__file__).parents[2] / "python"), "PYTHONDONTWRITEBYTECODE": "1",
                   "STRIDE_PREFIX": str(pathlib.Path(program).parents[1])}
    commands = list(commands_of(session.read_text(encoding="utf-8")))
    mistakes = 0 if commands else 1
    for command, expected in commands:
        done = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        printed = done.stdout
        is_missing = "there is no OpenGL" in printed or "parallel: command not found" in printed
        is_out_of_reach = "-m pip " in command or is_missing
        if is_out_of_reach and done.returncode != 0:
            print(f"SKIPPED: $ {command}\n{printed}")
            return 1 if os.environ.get("CI") == "true" else 77
        if printed != expected:
            print(f"$ {command}\n{printed}--- the page says\n{expected}")
            mistakes += 1
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
