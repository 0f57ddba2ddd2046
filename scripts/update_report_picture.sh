#!/usr/bin/env bash
# Makes the picture of the report in docs/images anew, of a run of the flagship scenario. Needs the release build, Chromium,
# and the virtual environment that the test venv_setup makes.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
build=$root/build/release
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# the picture shows the command, so that has no path of this machine
ln -s "$root/scenarios" "$folder/scenarios"
(cd "$folder" && "$build/bin/stride" run scenarios/nfc_approach/nfc_approach.ssd --film >/dev/null)
"$build/venv/bin/python" tests/master/report/page/browser/picture.py "$folder/results/nfc_approach/report.html" \
  docs/images/report.png 14.2005
ls -l docs/images/report.png
