#!/usr/bin/env bash
# Builds stride and runs all tests, then the same under the address and undefined-behaviour sanitizers, and those with
# several threads under the thread sanitizer.
#   --quick   the master and the kit only: no units of units/, no scenarios, no other tools, no sanitizers, no MuJoCo 3
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh

quick=no
[ "${1:-}" = --quick ] && quick=yes
install_packages "${packages_build[@]}" "${packages_test[@]}"

# some tests wait for a network or for a time
parallel=$(($(nproc) + 2))

section() { printf '\n== %s (after %d min %02d s)\n' "$*" $((SECONDS / 60)) $((SECONDS % 60)); }

# build_and_test PRESET [OPTION of ctest]...
build_and_test() {
  cmake --preset "$1" --log-level=WARNING -DSTRIDE_WARNINGS_AS_ERRORS=ON -DSTRIDE_BUILD_TESTS=ON
  cmake --build --preset "$1"
  ctest --preset "$1" --parallel "$parallel" --label-exclude machine "${@:2}"
  # they watch processes and limits of time, on a machine that may have other work: the second chance is theirs alone
  ctest --preset "$1" --parallel "$parallel" --label-regex machine --repeat until-pass:2
}

section "Format"
scripts/format.sh --check

if [ "$quick" = yes ]; then
  section "Release build of the master and the kit, their tests"
  build_and_test quick
  section "Not tested by --quick: units/, scenarios/, documentation, installation, other tools, sanitizers, MuJoCo 3"
  exit
fi

section "Release build, all tests but the fuzzing, which is more worth with the sanitizers below"
build_and_test release --exclude-regex '^fuzz_'

section "Address and undefined-behaviour sanitizers"
build_and_test asan

section "Thread sanitizer, the tests with several threads"
cmake --preset tsan --log-level=WARNING -DSTRIDE_WARNINGS_AS_ERRORS=ON -DSTRIDE_BUILD_TESTS=ON
cmake --build --preset tsan --target parallel_tests
ctest --preset tsan --label-regex parallel --no-tests=error

section "MuJoCo 3"
scripts/fetch_mujoco3.sh build/mujoco3
cmake --preset release -B build/release-mujoco3 --log-level=WARNING -DSTRIDE_WARNINGS_AS_ERRORS=ON \
  -DMuJoCo_ROOT="$PWD/build/mujoco3/mujoco"
cmake --build build/release-mujoco3 --target mujoco_tests
ctest --test-dir build/release-mujoco3 --output-on-failure --label-regex mujoco --no-tests=error --parallel "$parallel"

section "All tests have passed"
