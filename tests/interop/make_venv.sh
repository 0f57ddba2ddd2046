#!/usr/bin/env bash
# make_venv.sh FOLDER REQUIREMENTS: a virtual environment with the packages that tests use. Exit code 77 = they
# cannot be had here, which only CI takes for a failure.
set -u
folder=$1
requirements=$2
if [ -x "$folder/bin/python" ] && cmp -s "$requirements" "$folder/requirements.txt"; then exit 0; fi
rm -rf "$folder"
if /usr/bin/python3 -m venv "$folder" && "$folder/bin/pip" install --quiet --disable-pip-version-check --no-compile -r "$requirements"; then
  cp "$requirements" "$folder/requirements.txt"
  exit 0
fi
rm -rf "$folder"
echo "SKIPPED: Python packages cannot be installed (needs python3-venv and PyPI)"
[ "${CI:-}" = true ] && exit 1
exit 77
