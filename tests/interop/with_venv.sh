#!/usr/bin/env bash
# with_venv.sh VENV SCRIPT ARGUMENT...: runs a Python script in the virtual environment, else says that it is skipped.
set -u
venv=$1
shift
if [ ! -x "$venv/bin/python" ]; then
  echo "SKIPPED: there is no virtual environment with the Python packages of tests"
  [ "${CI:-}" = true ] && exit 1
  exit 77
fi
exec "$venv/bin/python" "$@"
