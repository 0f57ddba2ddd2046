#!/usr/bin/env python3
"""What checkpoints cost and save: the flagship with and without, resumed shortly before its end, and with branches.

    checkpoint_bench.py PROGRAM SCENARIO [--late S] [--early S] [--rounds N] [--branches N]

The runs take turns; what is printed are ratios of medians. The checkpoint is late, the branches begin early.
"""
import argparse
import pathlib
import shutil
import statistics
import subprocess
import tempfile
import time


class Bench:
    def __init__(self, program, scenario, folder):
        self.program, self.scenario, self.folder = program, scenario, folder

    def run(self, *arguments, out="out"):
        command = [self.program, "run", self.scenario, "--quiet", "--no-report", "--out", self.folder / out, *arguments]
        return self.timed(command)

    def resume(self, folder):
        return self.timed([self.program, "resume", self.folder / folder, "--quiet"])

    def timed(self, command):
        begin = time.perf_counter()
        subprocess.run(command, check=True, cwd=self.folder)
        return time.perf_counter() - begin


def medians(rounds, **works):
    times = {name: [] for name in works}
    for _ in range(rounds):
        for name, work in works.items():
            times[name].append(work())
    return {name: statistics.median(values) for name, values in times.items()}


def write_branches(path, count):
    rows = "".join(f'<stride:Branch name="b{i}"/>' for i in range(count))
    path.write_text(f'<stride:Branches xmlns:stride="urn:org.stride:scenario:1">{rows}</stride:Branches>')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("scenario", type=pathlib.Path)
    parser.add_argument("--late", default="29")
    parser.add_argument("--early", default="20")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--branches", type=int, default=100)
    arguments = parser.parse_args()
    late, early, every = arguments.late, arguments.early, str(float(arguments.late) / 29)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        bench = Bench(arguments.program.resolve(), arguments.scenario.resolve(), folder)
        bench.run("--checkpoint", late, out="kept")
        size = next((folder / "kept/checkpoints").iterdir()).stat().st_size
        write_branches(folder / "branches.xml", arguments.branches)
        once = medians(
            arguments.rounds,
            plain=lambda: bench.run(),
            checkpoint=lambda: bench.run("--checkpoint", late, out="one"),
            every_second=lambda: bench.run("--checkpoint-every", every, out="every"),
            resumed=lambda: bench.resume("kept"),
        )
        print(f"a checkpoint at {late} s: {size / 1024:.0f} KiB")
        print(f"a run with it, beside one without: {once['checkpoint'] / once['plain']:.2f}")
        print(f"a run with 29 of them: {once['every_second'] / once['plain']:.2f}")
        print(f"resumed at {late} s, beside the whole run: {once['resumed'] / once['plain']:.2f}")
        branched = bench.run("--branch", f"{early}:branches.xml", out="branched")
        shutil.rmtree(folder / "branched")
        wholes = sum(bench.run() for _ in range(arguments.branches))
        print(f"{arguments.branches} branches at {early} s, beside as many whole runs one after another: "
              f"{branched / wholes:.2f}")


if __name__ == "__main__":
    main()
