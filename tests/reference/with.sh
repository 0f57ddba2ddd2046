#!/usr/bin/env bash
# with.sh PROGRAM COMMAND...: runs the command, or says that the program is missing, which only CI takes for a failure.
set -euo pipefail

if ! command -v "$1" > /dev/null; then
  echo "skipped: there is no $1 here"
  [ "${CI:-}" = true ] && exit 1
  exit 77
fi
shift
exec "$@"
