#!/usr/bin/env bash
# What a real bash offers with the completion that the program writes.
#   bash_test.sh STRIDE SCENARIO-FOLDER
set -euo pipefail

stride=$1
scenarios=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$stride" reference bash > "$work/completion"
bash -n "$work/completion"
# shellcheck source=/dev/null
source "$work/completion"

mkdir -p "$work/here/folder"
cd "$work/here"
cp "$scenarios/nfc_approach/nfc_approach.ssd" scenario.ssd
cp -r "$scenarios/nfc_approach/." .
touch unit.fmu other.fmu notes.txt 'with blank.ssd'
failures=0

# offers 'what stands behind each word that is offered' WORD... : the last word is the one at the cursor, '=' stands alone
offers() {
  local expected=$1
  shift
  COMP_WORDS=("$stride" "$@")
  COMP_CWORD=$#
  COMPREPLY=()
  _stride 2> "$work/errors" || true
  local offered
  offered=$(printf '%s\n' "${COMPREPLY[@]}" | sort | tr '\n' ' ')
  if [ -s "$work/errors" ]; then
    echo "errors of: stride $*"
    cat "$work/errors"
    failures=1
  fi
  [ "${offered% }" = "$expected" ] && return
  echo "stride $* offers '${offered% }', expected '$expected'"
  failures=1
}

commands=$("$stride" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p' | sort | tr '\n' ' ')
[ -n "$commands" ] || { echo "the help has no commands"; exit 1; }
offers "${commands% }" ''
offers "run" ru
offers "--verbose --version" --ver
offers "--policy" run --po
offers "error-controlled event-driven fixed" run --policy ''
offers "error-controlled event-driven" run --policy e
offers "fixed" run --policy = f
offers "folder" run --out fo
offers "folder" run -o fo
offers "" run --stop ''
offers "scenario.ssd" run sce
offers "folder" run fo
offers "with blank.ssd" run wi
offers "nfc_approach nfc_approach.ssd" run nfc_app
offers "nfc_approach.ssd" inspect nfc_app
offers "nfc_far" check nfc_fa
offers "channel= environment= reader= sensor= world=" run nfc_far --swap ''
offers "unit.fmu" run un
offers "" complete un
offers "notes.txt" run --capture sensor = no
offers "compress expand info" trace ''
offers "--min-gap" trace info --m
offers "" trace expand --m
offers "--cut-off" trace expand --c
offers "channel= environment= ground_truth= reader= sensor= world=" run scenario.ssd --swap ''
offers "sensor=" run scenario.ssd --swap s
offers "unit.fmu" run scenario.ssd --swap sensor = u
offers "sensor." run scenario.ssd --set s
offers "sensor" run scenario.ssd --isolate = s
offers "" run --swap s
sed 's/"sensor"/"$(touch hacked)sensor"/g' scenario.ssd > hostile.ssd
offers '$(touch hacked)sensor.' run hostile.ssd --set '$'
[ ! -e hacked ] || { echo "a component's name was run as a command"; failures=1; }
rm hostile.ssd
offers "dependencies description determinism" verify --check de
offers "other.fmu" inspect ot
exit $failures
