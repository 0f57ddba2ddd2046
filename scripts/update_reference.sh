#!/usr/bin/env bash
# Writes docs/cli.md anew, the reference of the command line, from the program's own help.
#
#   scripts/update_reference.sh [PROGRAM]     PROGRAM is build/release/bin/stride unless named
set -euo pipefail
cd "$(dirname "$0")/.."

program=${1:-build/release/bin/stride}
page=$("$program" reference markdown)
printf '%s\n' "$page" > docs/cli.md
git --no-pager diff --stat -- docs/cli.md
