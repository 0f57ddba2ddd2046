#!/usr/bin/env bash
# The man pages that the program writes are well-formed, and there is one for each command.
#   man_test.sh STRIDE
set -euo pipefail

stride=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$stride" reference man "$work"

commands=$("$stride" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
[ -n "$commands" ] || { echo "the help has no commands"; exit 1; }
expected=$(printf 'stride-%s.1\n' $commands; echo stride.1)
[ "$(ls "$work" | sort)" = "$(sort <<< "$expected")" ] || { ls "$work"; echo "expected $expected"; exit 1; }

# a date would make each build another one
if mandoc -T lint -W warning "$work"/*.1 | grep -v 'missing date'; then exit 1; fi
text=$(mandoc -T utf8 "$work/stride-run.1" | col -b)
for words in 'stride run [OPTION]... SCENARIO' '--policy fixed|event-driven|error-controlled' '--isolate[=COMPONENT]'; do
  grep -qF -e "$words" <<< "$text" || { echo "$text"; echo "'$words' is missing"; exit 1; }
done
