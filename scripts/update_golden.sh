#!/usr/bin/env bash
# Writes the golden results of the flagship scenario anew, which tests/golden compares each run with.
#
# When to use it: after a change that is meant to alter what the scenario shows (its program, its parameters, a unit's
# model). Look at the difference with `git diff` first and say in the commit message why each number moved. A failing
# test is no reason by itself: a refactoring must not change these files.
#
#   scripts/update_golden.sh [PROGRAM]     PROGRAM is build/release/bin/stride unless named
set -euo pipefail
cd "$(dirname "$0")/.."

program=${1:-build/release/bin/stride}
scenario=scenarios/nfc_approach
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT

env -u STRIDE_UNITS "$program" run "$scenario/nfc_approach.ssd" --out "$results" --no-trace --quiet
cp "$results/events.csv" "$scenario/golden/events.csv"
# every 100 ms is enough to see each curve
awk -F, 'NR == 1 || $1 ~ /^[0-9]+([.][0-9])?$/' "$results/signals.csv" > "$scenario/golden/signals.csv"
git --no-pager diff --stat -- "$scenario/golden"
