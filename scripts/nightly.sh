#!/usr/bin/env bash
# What takes longer than CI has: the fuzzers guided by coverage, and the benchmarks with their real sizes.
#   scripts/nightly.sh [--inputs N]   inputs for each parser (100000)
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/fuzz.sh "$@"

cmake --preset release --log-level=WARNING -DSTRIDE_BUILD_TESTS=ON
cmake --build --preset release
bench=build/release/tests/bench stride=build/release/bin/stride
for program in "$bench"/*_bench; do "$program"; done
python3 tests/bench/run_bench.py $stride $bench/by_hand build/release/tests/units
python3 tests/bench/load_bench.py $stride
python3 tests/bench/idle_bench.py $stride scenarios
