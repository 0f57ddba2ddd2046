"""containerfile_test.py ROOT: what can be said of the Containerfile without building it: its instructions are known, each
shell step is well-formed for its shell, what it copies is there, and no file of the repository is left out of what it
copies. The steps are not run; see docs/container.md."""

import pathlib
import re
import shutil
import subprocess
import sys

KNOWN = {"FROM", "WORKDIR", "COPY", "RUN", "ENTRYPOINT", "CMD"}


def instructions(text):
    """Name and argument of each instruction, of lines that are joined."""
    joined = re.sub(r"\\\n\s*", "", "\n".join(line for line in text.splitlines() if not line.startswith("#")))
    return [tuple(line.split(maxsplit=1)) for line in joined.splitlines() if line.strip()]


def mistakes_of(root):
    steps = instructions((root / "Containerfile").read_text(encoding="utf-8"))
    stages, runs = [], 0
    for name, argument in steps:
        if name == "SHELL":
            yield "SHELL is not known to images of the OCI's format, which podman and buildah make"
        elif name not in KNOWN:
            yield f"{name} is no instruction that is expected"
        elif name == "FROM":
            words = argument.split()
            stages.append(words[2] if words[1:2] == ["AS"] else "")
        elif name == "COPY":
            for source in argument.split()[:-1]:
                if not (root / source).exists():
                    yield f"COPY {source}: there is no such file"
        elif name == "RUN":
            runs += 1
            for stage in re.findall(r"--mount=\S*from=(\w+)", argument):
                if stage not in stages:
                    yield f"RUN {argument}: there is no stage {stage}"
            command = re.sub(r"^(--\S+ )+", "", argument)
            scripts = [("sh", command), *(("bash", script) for script in re.findall(r"bash -euc '([^']*)'", command))]
            for shell, script in scripts:
                checked = subprocess.run([shutil.which(shell), "-n", "-c", script], capture_output=True, text=True)
                if checked.returncode != 0:
                    yield f"RUN {script}: {checked.stderr.strip()}"
    if len(stages) != 2 or runs != 4:
        yield f"{len(stages)} stages with {runs} shell steps, expected 2 with 4"
    ignored = (root / ".dockerignore").read_text(encoding="utf-8").split()
    kept = subprocess.run(["git", "-C", root, "ls-files"], capture_output=True, text=True).stdout.splitlines()
    for file in kept:
        top = file.split("/")[0]
        if any(pathlib.PurePath(top).match(pattern) for pattern in ignored if "/" not in pattern):
            yield f".dockerignore leaves out {file}"


def main(root):
    mistakes = list(mistakes_of(pathlib.Path(root)))
    print("\n".join(mistakes) if mistakes else "the Containerfile is right, as far as can be seen")
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
