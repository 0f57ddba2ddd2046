#!/usr/bin/env bash
# Formats all C and C++ sources with clang-format 14; with --check it only lists what is not formatted.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=(-i)
[ "${1:-}" = --check ] && mode=(--dry-run --Werror)
git ls-files --cached --others --exclude-standard '*.c' '*.h' '*.cpp' | xargs clang-format-14 "${mode[@]}"
