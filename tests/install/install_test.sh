#!/usr/bin/env bash
# Installs a built tree, moves it, builds a unit against it, and runs scenarios with it.
#   install_test.sh CMAKE BUILD-FOLDER GENERATOR
set -euo pipefail

cmake=$1
build=$2
generator=$3
project=$(cd "$(dirname "$0")" && pwd)/project
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset STRIDE_UNITS LD_LIBRARY_PATH

fail() { echo "install_test: $*" >&2; exit 1; }
step() { echo "== $*"; }

step "Install, and move to another place"
"$cmake" --install "$build" --prefix "$work/first" > /dev/null
mv "$work/first" "$work/stride"
stride=$work/stride/bin/stride
if grep -rlF -e "$build" -e "$work/first" "$work/stride/lib" --include='*.cmake'; then
  fail "these files name a folder of the machine that built them"
fi

step "Man pages and completions"
for file in man/man1/stride.1 man/man1/stride-run.1 bash-completion/completions/stride \
  zsh/site-functions/_stride fish/vendor_completions.d/stride.fish; do
  [ -s "$work/stride/share/$file" ] || fail "there is no share/$file"
done
bash -c 'source "$1" && complete -p stride' - "$work/stride/share/bash-completion/completions/stride" > /dev/null ||
  fail "bash does not know how to complete stride"

step "Libraries in the units look for others beside themselves only"
for unit in "$work"/stride/lib/stride/units/*.fmu; do
  mkdir -p "$work/unpacked" && (cd "$work/unpacked" && "$cmake" -E tar xf "$unit")
  for library in "$work"/unpacked/binaries/*/*.so*; do
    readelf -d "$library" | grep -E '\((RUNPATH|RPATH)\)' | grep -vF '[$ORIGIN]' && fail "$unit: ${library##*/}"
  done
  rm -r "$work/unpacked"
done

step "A table is packed with the libraries that its unit needs"
(cd "$work" && printf 'time,u\n0,0\n1,1\n' > cycle.csv && "$stride" pack cycle.csv -o cycle.fmu)
mkdir "$work/unpacked" && (cd "$work/unpacked" && "$cmake" -E tar xf ../cycle.fmu)
for library in "$work"/unpacked/binaries/*/*.so*; do
  for name in $(readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p'); do
    case $name in
      libc.so.* | libm.so.* | libstdc++.so.* | libgcc_s.so.* | ld-linux-*) ;;
      *) [ -e "${library%/*}/$name" ] || fail "the FMU of a table has no $name, which ${library##*/} needs" ;;
    esac
  done
done
rm -r "$work/unpacked" "$work/cycle.fmu" "$work/cycle.csv"

step "A unit outside of the repository, and each header by itself"
cp -r "$project" "$work/project"
"$cmake" -G "$generator" -S "$work/project" -B "$work/project/build" -DCMAKE_PREFIX_PATH="$work/stride" > "$work/log" ||
  { cat "$work/log"; fail "the project does not configure"; }
"$cmake" --build "$work/project/build" --parallel 2 > "$work/log" ||
  { cat "$work/log"; fail "the project does not build"; }
oscillator=$work/project/build/units/oscillator.fmu
[ -f "$oscillator" ] || fail "there is no $oscillator"

step "What stride new writes is built, tested, and run, as it says"
for kind in unit systemc; do
  (cd "$work" && "$stride" new "my_$kind" "--$kind" > "$work/table" &&
    sed -n 's/^  \(cmake\|ctest\|cd\|stride\)/\1/p' "$work/table" > "$work/commands" &&
    PATH="$work/stride/bin:$PATH" CMAKE_GENERATOR="$generator" bash -e "$work/commands" > "$work/log" 2>&1) ||
    { cat "$work/table" "$work/log"; fail "the new $kind does not do what it should"; }
  [ "$(grep -c '' "$work/commands")" -eq 5 ] || { cat "$work/table"; fail "other commands"; }
  grep -q '100% tests passed, 0 tests failed out of 2' "$work/log" || { cat "$work/log"; fail "not both tests passed"; }
done

step "stride inspect"
"$stride" inspect "$oscillator" > "$work/table"
grep -Eq '^  frequency +parameter +Float64 +Hz +0.5 ' "$work/table" || { cat "$work/table"; fail "no frequency"; }
grep -Eq '^  position +output +Float64 +m ' "$work/table" || { cat "$work/table"; fail "no position"; }

step "A program is packed with the installed unit process, and is a good unit"
"$stride" verify "$work/project/build/units/pump.fmu" --instances 40 --check splitting > "$work/table" ||
  { cat "$work/table"; fail "the pump is no good"; }

step "A class of Python is packed with the installed package, and runs where nothing of it is"
"$stride" run "$work/project/build/units/valve.fmu" --set valve.pressure=4 --stop 0.1 --out "$work/out" --quiet
grep -q '^0.1,0.002$' "$work/out/signals.csv" || { cat "$work/out/signals.csv"; fail "another flow"; }

# position = cos(pi t); behind the low-pass of 1 s, held over 1 ms, (cos(pi t) + pi sin(pi t) - exp(-t)) / (1 + pi^2)
step "stride run: half a period leads to the other side, and the installed filter follows"
"$stride" run "$work/project/oscillator.ssd" --out "$work/out" --quiet
[ "$(head -n 1 "$work/out/signals.csv")" = "time,oscillator.position [m],filter.y" ] || fail "other columns"
awk -F, '
  $1 == "0.5" { half_way = $2 * $2 < 1e-18 }
  $1 == "1" { there = ($2 + 1) ^ 2 < 1e-18; follows = ($3 + 0.1258) ^ 2 < 1e-5 }
  END { exit !(half_way && there && follows) }' "$work/out/signals.csv" || fail "other numbers in signals.csv"

step "A scenario by its name"
(cd "$work" && "$stride" run nfc_far --stop 0.5 --no-checks --quiet) || [ $? -eq 1 ]
grep -q '"outcome": "completed"' "$work/results/nfc_far/run.json" || fail "nfc_far was not completed"

step "The installed scenarios run with the installed units"
for scenario in "$work"/stride/share/stride/scenarios/*/*.ssd; do
  [ -e "${scenario%/*}/make_world.sh" ] && continue  # its world has to be fetched first
  # too short for what its judge wants to see, maybe
  "$stride" run "$scenario" --out "$work/out" --stop 0.5 --quiet || [ $? -eq 1 ]
  grep -q '"outcome": "completed"' "$work/out/run.json" || fail "$scenario was not completed"
done

step "A search finds the installed optimisers, and the scenario itself passes"
"$stride" campaign search "$work/stride/share/stride/scenarios/nfc_approach/nfc_approach.xosc" --runs 1 --quiet \
  --out "$work/search" || fail "the search has failed"

step "The installed units can be read"
for unit in "$work"/stride/lib/stride/units/*.fmu; do
  "$stride" inspect "$unit" > /dev/null
done
