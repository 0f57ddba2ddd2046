#!/usr/bin/env python3
"""Writes a source in C that defines every symbol of some programs and libraries, and of those that they need.

    generate.py OUTPUT FILE...

Left out are the symbols of the C and C++ libraries and of the compiler's own. Each function returns a number of its
own, and is called by its name.
"""

import re
import subprocess
import sys
from pathlib import Path

SYSTEM = re.compile(r"(ld-linux.*|lib(c|m|stdc\+\+|gcc_s|asan|tsan|ubsan|lsan))\.so(\.\d+)*")
LINKER = {"_init", "_fini", "__bss_start", "_edata", "_end", "edata", "end", "etext", "_etext", "main"}


def run(*command: object) -> str:
    return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, text=True, check=True).stdout


def symbols_of(file: Path) -> set[str]:
    """Without those of a version (type A), and their versions."""
    rows = [row.split() for row in run("nm", "-D", "--defined-only", file).splitlines()]
    return {row[-1].partition("@")[0] for row in rows if row[-2] != "A"} - LINKER


def with_needed(files: list[Path]) -> set[Path]:
    needed = {Path(path) for file in files for path in re.findall(r"(/\S+) \(0x", run("ldd", file))}
    return needed | set(files)


def source_of(symbols: list[str]) -> str:
    lines = ['#include "tests/test_units/own_symbols/own_symbols.h"']
    for number, symbol in enumerate(symbols, 1):
        lines += [
            f'int f{number}(void) __asm__("{symbol}");',
            f"int f{number}(void) {{ return {number}; }}",
        ]
    lines += ["OwnSymbols call_own_symbols(void) {", f"  OwnSymbols found = {{{len(symbols)}, 0, f1()}};"]
    lines += [f"  found.own += f{number}() == {number};" for number in range(1, len(symbols) + 1)]
    return "\n".join([*lines, "  return found;", "}", ""])


def main(output: Path, files: list[Path]) -> None:
    objects = with_needed(files)
    system = {file for file in objects if SYSTEM.fullmatch(file.name)}
    symbols = set().union(*map(symbols_of, objects - system)) - set().union(*map(symbols_of, system))
    output.write_text(source_of(sorted(symbols)))


if __name__ == "__main__":
    main(Path(sys.argv[1]), [Path(file) for file in sys.argv[2:]])
