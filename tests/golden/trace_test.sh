#!/usr/bin/env bash
# GTKWave's converter reads the VCD of the flagship run and finds the same hierarchy and the same instants in it.
#   trace_test.sh PROGRAM SCENARIO
set -euo pipefail

for tool in vcd2fst fst2vcd; do
  command -v "$tool" > /dev/null && continue
  echo "SKIPPED: $tool is not installed (package gtkwave), so nobody else has read the trace"
  [ "${CI:-}" = true ] && exit 1
  exit 77
done

results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT
"$1" run "$2" --out "$results" --quiet

# the converter chooses identifiers and the sizes of texts itself
hierarchy() { awk '/^\$(scope|upscope)/ { print $1, $3 } /^\$var/ { print $2, $5 }' "$1"; }
instants() { grep '^#' "$1"; }

trace=$results/signals.vcd
vcd2fst "$trace" "$results/signals.fst"
fst2vcd "$results/signals.fst" > "$results/read.vcd"
for what in hierarchy instants; do
  "$what" "$trace" > "$results/written.txt"
  "$what" "$results/read.vcd" > "$results/read.txt"
  [ -s "$results/written.txt" ] || { echo "the trace has no $what" >&2; exit 1; }
  diff "$results/written.txt" "$results/read.txt" || { echo "GTKWave reads another $what" >&2; exit 1; }
done
