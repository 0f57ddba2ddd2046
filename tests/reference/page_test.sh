#!/usr/bin/env bash
# docs/cli.md is what the program says now.
#   page_test.sh STRIDE REPOSITORY
set -euo pipefail

diff -u "$2/docs/cli.md" <("$1" reference markdown) && exit 0
echo "docs/cli.md is out of date: run scripts/update_reference.sh"
exit 1
