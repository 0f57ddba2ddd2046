#!/usr/bin/env bash
# with_venv.sh VENV SCRIPT ARGUMENT...: runs a Python script where FMPy could be installed, else says that it is skipped.
set -u
venv=$1
shift
if [ ! -x "$venv/bin/python" ]; then
  echo "SKIPPED: FMPy is not there"
  [ "${CI:-}" = true ] && exit 1
  exit 77
fi
exec "$venv/bin/python" "$@"
