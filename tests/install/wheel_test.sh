#!/usr/bin/env bash
# Installs the wheel that scripts/build_wheel.sh has made in a virtual environment, where none of the libraries are that
# stride was built with, and runs scenarios there.
#   wheel_test.sh BUILD-FOLDER WHEEL-FOLDER CMAKE GENERATOR
set -euo pipefail

build=$1
wheels=$2
cmake=$3
generator=$4
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset STRIDE_UNITS LD_LIBRARY_PATH

fail() { echo "wheel_test: $*" >&2; exit 1; }
step() { echo "== $*"; }
skip() { echo "SKIPPED: $*"; [ -z "${CI:-}" ] && exit 77 || exit 1; }
clean() { "$here/clean_root.sh" "$work" "$@"; }

cp "$wheels"/stride_cosim-*.whl "$work" || skip "there is no wheel"
wheel=$(echo "$work"/*.whl)
[[ ${wheel##*/} =~ ^stride_cosim-[0-9.]+-py3-none-manylinux_2_[0-9]+_x86_64\.whl$ ]] ||
  fail "${wheel##*/}: the name should say which systems it is for"
clean /usr/bin/python3 -c 'import sys; sys.exit(0)' || skip "there can be no clean root file system"
"$wheels/tools/bin/pip" download --quiet --disable-pip-version-check --only-binary :all: --dest "$work" "$wheel[mcap]" fmpy ||
  skip "PyPI cannot be reached"

step "Install"
clean /usr/bin/python3 -m venv "$work/venv"
clean "$work/venv/bin/pip" install --quiet --no-index --find-links "$work" stride-cosim
stride=$work/venv/bin/stride
prefix=$(clean "$work/venv/bin/python" -c 'import stride; print(stride.program().parents[1])')
[ -x "$prefix/bin/stride" ] || fail "there is no program below $prefix"

step "Each program and library finds what it needs, those of a unit in the unit"
cp "$here/linked_libraries.py" "$work"
clean "$work/venv/bin/python" "$work/linked_libraries.py" "$work/venv/lib" "$prefix/lib/stride/units" ||
  fail "libraries are missing"

step "The program by its three names, with its exit codes"
version=$("$build/bin/stride" --version)
for command in "$stride" "$work/venv/bin/python -m stride" "$prefix/bin/stride"; do
  [ "$(clean $command --version)" = "$version" ] || fail "$command --version does not print $version"
done
code=0
clean "$stride" run nfc_aproach 2> "$work/error" || code=$?
[ $code -eq 2 ] || fail "an unknown scenario gives exit code $code"
grep -q "did you mean 'nfc_approach'?" "$work/error" || { cat "$work/error"; fail "another hint"; }
clean "$work/venv/bin/stride-robot" --help > /dev/null

step "In the process of Python, and beside it"
clean "$work/venv/bin/python" - << 'END' || fail "the package does not work"
import stride

run = stride.run("nfc_approach", stop=0.5, no_checks=True)
with stride.Simulation("nfc_approach", stop=0.5) as simulation:
    simulation.run()
    assert simulation["channel.distance"] == run.signals["channel.distance"][-1], run.signals["channel.distance"]
END
"$work/venv/bin/python" - "$build/units/sensor.fmu" << 'END' || fail "a unit with another copy of SystemC does not work"
import sys, stride

def ends(**settings):
    with stride.Simulation("nfc_approach", stop=0.5, **settings) as simulation:
        simulation.run()
        return [simulation["sensor." + name] for name in ("capacitor.charge", "supply.voltage", "energy.load")]

own = ends()
other = ends(swap={"sensor": sys.argv[1]})
assert other == own, (other, own)
assert ends() == own
END
clean "$work/venv/bin/python" -c 'import stride.__main__, sys; sys.exit("numpy" in sys.modules)' ||
  fail "the command waits for numpy"

step "Where nobody reads what it prints it ends as it does without Python before it"
closed='import os, subprocess, sys
read, write = os.pipe()
os.close(read)
print(subprocess.run(sys.argv[1:], stdout=write).returncode)'
for command in "$build/bin/stride" "$stride"; do
  /usr/bin/python3 -c "$closed" "$command" --version
done > "$work/codes"
[ "$(sort -u "$work/codes" | wc -l)" -eq 1 ] || { cat "$work/codes"; fail "it ends in another way"; }

step "A scenario by its name gives the signals of the build's program, to the byte"
clean "$stride" run nfc_approach --quiet || fail "the run has failed"
"$build/bin/stride" run nfc_approach --quiet --out "$work/results/build"
for file in signals.csv events.csv; do
  cmp "$work/results/build/$file" "$work/results/nfc_approach/$file" || fail "another $file"
done
grep -q '</html>' "$work/results/nfc_approach/report.html" || fail "there is no report"

step "An MCAP file, by the extra with its packages"
if clean "$stride" export results/nfc_approach --mcap run.mcap > "$work/log" 2>&1; then fail "it needs no packages"; fi
grep -qF "pip install 'stride-cosim[mcap]'" "$work/log" || { cat "$work/log"; fail "it does not say which"; }
clean "$work/venv/bin/pip" install --quiet --no-index --find-links "$work" 'stride-cosim[mcap]'
clean "$stride" export results/nfc_approach --mcap run.mcap || fail "there is no file"

step "Units in processes of their own"
clean "$stride" run nfc_approach --isolate --stop 0.5 --no-checks --quiet --out results/hosted || [ $? -eq 1 ]
grep -q '"outcome": "completed"' "$work/results/hosted/run.json" || fail "the run was not completed"

step "All scenarios, and the optimisers of a search"
for scenario in $(clean "$stride" reference scenarios); do
  [ -e "$prefix/share/stride/scenarios/$scenario/make_world.sh" ] && continue  # its world has to be fetched first
  clean "$stride" run "$scenario" --stop 0.5 --quiet || [ $? -eq 1 ]
  grep -q '"outcome": "completed"' "$work/results/$scenario/run.json" || fail "$scenario was not completed"
done
cmp "$work/results/nfc_approach/signals.csv" "$work/results/hosted/signals.csv" || fail "hosts change the signals"
clean "$stride" campaign search "$prefix/share/stride/scenarios/nfc_approach/nfc_approach.xosc" --runs 1 --quiet \
  --out results/search || fail "the search has failed"

step "What is packed by the wheel runs in FMPy, with the wheel gone"
clean /usr/bin/python3 -m venv "$work/fmpy"
clean "$work/fmpy/bin/pip" install --quiet --no-index --find-links "$work" fmpy
printf 'time,u\n0,0\n1,2\n' > "$work/ramp.csv"
cat > "$work/double.py" << 'END'
import stride.unit as su


class Double(su.Unit):
    u = su.Input(float)
    y = su.Output(0.0)

    def step(self, now, end):
        self.y = 2 * self.u
END
clean "$stride" pack ramp.csv -o ramp.fmu
clean "$work/venv/bin/python" -m stride.unit double.py -o double.fmu --python python3
mv "$work/venv" "$work/gone"
clean "$work/fmpy/bin/python" - << 'END' || fail "FMPy does not run what was packed"
from fmpy import simulate_fmu

ramp = simulate_fmu("ramp.fmu", stop_time=1, output_interval=0.5, output=["u"])
assert list(ramp["u"]) == [0, 1, 2], ramp
double = simulate_fmu("double.fmu", stop_time=1, output_interval=0.5, output=["y"], start_values={"u": 3})
assert double["y"][-1] == 6, double
END
mv "$work/gone" "$work/venv"

step "Licences of the libraries, man pages and completions"
for file in lib/python3.*/site-packages/stride_cosim-*.dist-info/licenses/LICENSE \
  lib/python3.*/site-packages/stride_cosim-*.dist-info/licenses/libraries/libsystemc.txt \
  share/man/man1/stride-run.1 share/bash-completion/completions/stride share/zsh/site-functions/_stride \
  share/fish/vendor_completions.d/stride.fish; do
  [ -s "$work/venv"/$file ] || fail "there is no $file"
done

step "A new unit is built with the kit in the wheel, by the commands that stride shows"
cd "$work"
"$stride" new chip --systemc | grep -qF 'FOLDER: where stride is installed, with its component systemc' ||
  fail "it does not say that a unit in SystemC needs another stride"
"$stride" new tank --unit > "$work/table"
sed -n 's/^  \(cmake\|ctest\|cd\|stride\)/\1/p' "$work/table" > "$work/commands"
export CMAKE_GENERATOR=$generator PATH="$work/venv/bin:$(dirname "$cmake"):$PATH"
bash -e "$work/commands" > "$work/log" 2>&1 || { cat "$work/table" "$work/log"; fail "they fail"; }
grep -q '100% tests passed, 0 tests failed out of 2' "$work/log" || { cat "$work/log"; fail "not both tests passed"; }
