#!/usr/bin/env bash
# Builds stride and runs its tests.
#   scripts/test.sh           the release build and its tests: the whole product, once
#   scripts/test.sh --all     also what installs, packs or builds anew (installed tree, package, wheel, tutorials), the
#                             sanitizers, the fuzzing and MuJoCo 3; this is what CI runs
#   scripts/test.sh --quick   the master and the kit only: no units of units/, no scenarios, no other tools
# scripts/nightly.sh runs what takes longer still.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh

extent=release
case "$*" in
  "") ;;
  --all | --quick) extent=${1#--} ;;
  *) sed -n '2,/^set/s/^# \?//p' "$0" | sed '$d' >&2 && exit 2 ;;
esac

# some tests wait for a network or for a time
parallel=$(($(nproc) + 2))
times=() stage="" began=0

clock_text() { printf '%d min %02d s' $(($1 / 60)) $(($1 % 60)); }

# stage NAME: ends the stage before it
stage() {
  [ -z "$stage" ] || times+=("$stage: $(clock_text $((SECONDS - began)))")
  stage=$1 began=$SECONDS
  printf '\n== %s (after %s)\n' "$stage" "$(clock_text "$SECONDS")"
}
trap 'status=$?; stage "$([ $status -eq 0 ] && echo "All tests passed" || echo "FAILED in: $stage")"; printf "%s\n" "${times[@]}"' EXIT

# build PRESET [TARGET]...
build() {
  cmake --preset "$1" --log-level=WARNING -DSTRIDE_WARNINGS_AS_ERRORS=ON -DSTRIDE_BUILD_TESTS=ON
  cmake --build --preset "$1" ${2:+--target "${@:2}"}
}

# run_tests PRESET [OPTION of ctest]...: those labelled `machine` watch processes and limits of time on a machine that
# may be busy, so they and no others have a second chance
run_tests() {
  ctest --preset "$1" --parallel "$parallel" --label-exclude 'machine|thorough' "${@:2}"
  ctest --preset "$1" --parallel "$parallel" --label-regex machine --repeat until-pass:2
}

stage "Packages"
install_packages "${packages_build[@]}" "${packages_test[@]}"

stage "Format"
scripts/format.sh --check

preset=release
[ $extent = quick ] && preset=quick
stage "Build ($preset)"
build $preset
stage "Tests ($preset)"
run_tests $preset --exclude-regex '^fuzz_' # fuzzing finds more under the sanitizers

[ $extent = all ] || exit 0

stage "Installed tree, package, wheel, tutorials"
ctest --preset release --parallel "$parallel" --label-regex thorough --no-tests=error

stage "Address and undefined-behavior sanitizers"
build asan
run_tests asan

stage "Thread sanitizer: the tests with several threads"
build tsan parallel_tests
ctest --preset tsan --label-regex parallel --no-tests=error

stage "MuJoCo 3"
scripts/fetch_mujoco3.sh build/mujoco3
cmake --preset release -B build/release-mujoco3 --log-level=WARNING -DSTRIDE_WARNINGS_AS_ERRORS=ON \
  -DMuJoCo_ROOT="$PWD/build/mujoco3/mujoco"
cmake --build build/release-mujoco3 --target mujoco_tests
ctest --test-dir build/release-mujoco3 --output-on-failure --label-regex mujoco --no-tests=error --parallel "$parallel"
