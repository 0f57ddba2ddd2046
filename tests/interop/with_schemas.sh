#!/usr/bin/env bash
# with_schemas.sh VENV PACKAGE FOLDER SCRIPT ARGUMENT...: runs a script with xmllint; its first argument is the folder of
# XML schemas that the Python package PACKAGE of the virtual environment has.
set -u
venv=$1
package=$2
folder=$3
script=$4
shift 4
skip() {
  echo "SKIPPED: $1"
  [ "${CI:-}" = true ] && exit 1
  exit 77
}
command -v xmllint >/dev/null || skip "xmllint is not installed (libxml2-utils)"
[ -x "$venv/bin/python" ] || skip "there is no virtual environment with the Python packages of tests"
schemas=$(echo "$venv"/lib/python3*/site-packages/"$package/$folder")
[ -d "$schemas" ] || { echo "FAILED: $package has no schemas in $folder"; exit 1; }
exec "$script" "$schemas" "$@"
