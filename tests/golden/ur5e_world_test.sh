#!/usr/bin/env bash
# ur5e_world_test.sh SCRIPT BUILD: packs the world of ur5e_approach. Exit code 77 = its arm cannot be fetched here, which
# only CI takes for a failure.
set -u
"$@" && exit 0
status=$?
[ $status -ne 77 ] && exit $status
echo "SKIPPED: the package airo-models cannot be fetched (needs PyPI)"
[ "${CI:-}" = true ] && exit 1
exit 77
