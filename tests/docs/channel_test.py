#!/usr/bin/env python3
"""The table in a channel's README is what the unit gives: channel_test.py PROGRAM SOURCE_DIR SCRIPT UNIT"""

import subprocess
import sys
from pathlib import Path


def main(program, root, script, unit):
    script = Path(root) / "docs" / script
    table = subprocess.run([sys.executable, script, "--program", program, "--table"],
                           check=True, capture_output=True, text=True).stdout
    page = Path(root) / "units" / unit / "README.md"
    if table not in page.read_text(encoding="utf-8"):
        sys.exit(f"{page} does not have the table that {script} makes:\n\n{table}")


if __name__ == "__main__":
    main(*sys.argv[1:])
