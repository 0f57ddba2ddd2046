#!/usr/bin/env bash
# xmllint_test.sh SCHEMA FILE...: xmllint accepts the files against the schema. An .fmu stands for the model description in it.
set -u
schema=$1
shift
skip() {
  echo "SKIPPED: $1"
  [ "${CI:-}" = true ] && exit 1
  exit 77
}
command -v xmllint >/dev/null || skip "xmllint is not installed (libxml2-utils)"
[ -e "$schema" ] || skip "there is no schema $schema (set STRIDE_SCHEMA_DIR)"
status=0
for file in "$@"; do
  case $file in
    *.fmu) unzip -p "$file" modelDescription.xml | xmllint --nonet --noout --schema "$schema" - || status=1 ;;
    *) xmllint --nonet --noout --schema "$schema" "$file" || status=1 ;;
  esac
  echo "checked $file"
done
exit $status
