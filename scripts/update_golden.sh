#!/usr/bin/env bash
# Writes the golden results of the scenarios anew, which tests/golden compares each run with, the stimuli of
# replay_sensor, and what the documentation shows of nfc_approach: its picture and its messages. Then it names the
# sentences in the documentation whose numbers are others now.
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

"$program" run scenarios/nfc_approach/nfc_approach.ssd --step 0.02 --no-idle-skip --no-trace --quiet \
  --capture sensor=scenarios/replay_sensor/player/stimuli.csv --out "$results"
cmake --build "${program%/bin/*}" --target replay_sensor_player_fmu >/dev/null
for golden in scenarios/*/golden; do
  scenario=$(dirname "$golden")
  env -u STRIDE_UNITS "$program" run "$scenario/$(basename "$scenario").ssd" --no-idle-skip \
    --out "$results" --no-trace --quiet
  cp "$results/events.csv" "$golden/events.csv"
  # every 100 ms is enough to see each curve
  awk -F, 'NR == 1 || $1 ~ /^[0-9]+([.][0-9])?$/' "$results/signals.csv" > "$golden/signals.csv"
  if [ "$scenario" = scenarios/nfc_approach ]; then docs/plot_run.py "$results" > docs/images/nfc_approach.svg; fi
done
git --no-pager diff --stat -- scenarios
python3 tests/docs/figures_test.py "$program" . --update || true
