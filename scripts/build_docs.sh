#!/usr/bin/env bash
# build_docs.sh [FOLDER]: the documentation as a site, FOLDER/index.html (build/docs), which needs no network. What makes
# it is fetched once, from PyPI and from npm's registry. Exit code 77 = that cannot be had here, which only CI takes for
# a failure.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
site=$(realpath -m "${1:-$root/build/docs}")
tools=${site}_tools

mermaid=11.17.2
mermaid_sha512=57a2b70bc101744b0f1595d228c25eea9a50384371b87011afd1af1d7e21878ee501b84c443f6a7f8a042bb2e869143150b31af34feab798073bbdda0a578106

"$root/tests/interop/make_venv.sh" "$tools/venv" "$root/docs/site/requirements.txt"

archive=$tools/mermaid-$mermaid.tgz
static=$tools/mermaid-$mermaid
if [ ! -e "$static" ]; then
  if ! npm pack "mermaid@$mermaid" --pack-destination "$tools" --silent >/dev/null; then
    echo "SKIPPED: Mermaid cannot be fetched (needs npm and its registry)"
    [ "${CI:-}" = true ] && exit 1
    exit 77
  fi
  echo "$mermaid_sha512  $archive" | sha512sum --check --quiet
  mkdir -p "$static.part"
  tar -xzf "$archive" -C "$static.part" --strip-components=2 package/dist/mermaid.min.js
  mv "$static.part" "$static"
fi

rm -rf "$site"
cd "$root"
PYTHONDONTWRITEBYTECODE=1 "$tools/venv/bin/sphinx-build" -b html -c docs/site -d "$tools/doctrees" -D html_static_path="static,$static" \
  --fresh-env --jobs auto --fail-on-warning --quiet . "$site"
cp "$site/README.html" "$site/index.html"
echo "$site/index.html"
