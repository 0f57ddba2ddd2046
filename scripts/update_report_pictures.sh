#!/usr/bin/env bash
# Makes the pictures of the report and of a comparison in docs/images anew, of runs of the flagship scenario. Needs the
# release build, Chromium, and the virtual environment that the test venv_setup makes.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
build=$root/build/release
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# the pictures show commands and folders, so these have no path of this machine
ln -s "$root/scenarios" "$folder/scenarios"
picture() {
  "$build/venv/bin/python" tests/master/report/page/browser/picture.py "$folder/$1" "docs/images/$2" "$3"
}
(
  cd "$folder"
  "$build/bin/stride" run scenarios/nfc_approach/nfc_approach.ssd --film
  "$build/bin/stride" run scenarios/nfc_approach/nfc_approach.ssd --out before
  "$build/bin/stride" run scenarios/nfc_approach/nfc_approach.ssd --set sensor.power.capacitance=165e-6 --out after
  "$build/bin/stride" compare before after --html compare.html || true # they differ
) >/dev/null 2>&1
picture results/nfc_approach/report.html report.png 14.2005
picture compare.html compare.png 14.7
ls -l docs/images/report.png docs/images/compare.png
