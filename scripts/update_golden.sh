#!/usr/bin/env bash
# Writes the golden results of the scenarios anew, which tests/golden compares each run with.
#
# When to use it: after a change that is meant to alter what a scenario shows (its program, its parameters, a unit's
# model). Look at the difference with `git diff` first and state in the commit message why each number moved. A failing
# test is not a reason by itself: a refactoring must not change these files.
#
#   scripts/update_golden.sh [PROGRAM]     PROGRAM is build/release/bin/stride unless named
set -euo pipefail
cd "$(dirname "$0")/.."

program=${1:-build/release/bin/stride}
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT

for golden in scenarios/*/golden; do
  scenario=$(dirname "$golden")
  env -u STRIDE_UNITS "$program" run "$scenario/$(basename "$scenario").ssd" --no-idle-skip \
    --out "$results" --no-trace --quiet
  cp "$results/events.csv" "$golden/events.csv"
  # every 100 ms is enough to see each curve
  awk -F, 'NR == 1 || $1 ~ /^[0-9]+([.][0-9])?$/' "$results/signals.csv" > "$golden/signals.csv"
done
git --no-pager diff --stat -- scenarios/*/golden
