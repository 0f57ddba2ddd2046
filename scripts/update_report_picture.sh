#!/usr/bin/env bash
# Makes the picture of the report in docs/images anew, of a run of the flagship scenario. Needs the release build, Chromium,
# and the virtual environment that the test venv_setup makes.
set -euo pipefail
cd "$(dirname "$0")/.."
build=build/release
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT

"$build/bin/stride" run scenarios/nfc_approach/nfc_approach.ssd --film --out "$results" >/dev/null
"$build/venv/bin/python" tests/master/report/page/browser/picture.py "$results/report.html" docs/images/report.png 14.2005
ls -l docs/images/report.png
