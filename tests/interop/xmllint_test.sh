#!/usr/bin/env bash
# xmllint_test.sh SCHEMAS SCHEMA FILE...: xmllint accepts the files against a schema in the folder SCHEMAS. An .fmu stands for the
# model description in it.
set -u
schema=$1/$2
shift 2
status=0
for file in "$@"; do
  case $file in
    *.fmu) unzip -p "$file" modelDescription.xml | xmllint --nonet --noout --schema "$schema" - || status=1 ;;
    *) xmllint --nonet --noout --schema "$schema" "$file" || status=1 ;;
  esac
  echo "checked $file"
done
exit $status
