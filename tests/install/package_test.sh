#!/usr/bin/env bash
# Makes the packages, and runs a scenario with what is in them.
#   package_test.sh CPACK BUILD-FOLDER
set -euo pipefail

cpack=$1
build=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset STRIDE_UNITS LD_LIBRARY_PATH

fail() { echo "package_test: $*" >&2; exit 1; }
step() { echo "== $*"; }

command -v dpkg-shlibdeps > /dev/null || { echo "SKIPPED: there is no dpkg-shlibdeps"; [ -z "${CI:-}" ] && exit 77 || exit 1; }

step "Make"
(cd "$build" && "$cpack" -B "$work/packages") > "$work/log" 2>&1 || { cat "$work/log"; fail "cpack has failed"; }

step "The .deb depends on what the program and the units in it need"
deb=$(echo "$work"/packages/stride_*.deb)
dpkg-deb --field "$deb" Depends > "$work/depends"
for package in libarchive13 libsystemc libstdc++6 libfmt9; do
  grep -q "$package" "$work/depends" || { cat "$work/depends"; fail "it does not depend on $package"; }
done
grep -oE '^[^ ,]+|, [^ ,]+' "$work/depends" | sort | uniq -d | grep . && fail "it depends on these twice"

step "What is in it runs a scenario, and so does what is in the .tar.gz"
mkdir "$work/deb" "$work/tar"
dpkg-deb --extract "$deb" "$work/deb"
tar -C "$work/tar" -xzf "$work"/packages/stride-*.tar.gz
for prefix in "$work/deb/usr" "$work"/tar/*; do
  "$prefix/bin/stride" run "$prefix/share/stride/scenarios/nfc_approach/nfc_approach.ssd" --stop 0.5 --no-checks --quiet \
    --out "$work/results" || [ $? -eq 1 ]
  grep -q '"outcome": "completed"' "$work/results/run.json" || fail "$prefix: the scenario was not completed"
  [ -s "$prefix/share/man/man1/stride-new.1" ] || fail "$prefix: there are no man pages"
done
