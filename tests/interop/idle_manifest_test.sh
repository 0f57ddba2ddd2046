#!/usr/bin/env bash
# idle_manifest_test.sh FMI_SCHEMAS SCHEMA FMU...: the idle manifests in the FMUs are valid, and the schema refuses what
# is none.
set -u
fmi_schemas=$1
schema=$2
shift 2
imported=$fmi_schemas/fmi3LayeredStandardManifest.xsd

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$imported" "$schema" "$work"
is_valid() { xmllint --nonet --noout --schema "$work/${schema##*/}" "$1" 2>"$work/errors"; }

status=0
checked=0
for fmu in "$@"; do
  unzip -p "$fmu" extra/org.stride.idle/fmi-ls-manifest.xml >"$work/manifest.xml" 2>/dev/null || continue
  checked=$((checked + 1))
  is_valid "$work/manifest.xml" || { echo "FAILED: $fmu"; cat "$work/errors"; status=1; }
  cp "$work/manifest.xml" "$work/valid.xml"
done
echo "$checked manifests"
[ "$checked" -ge 3 ] || { echo "FAILED: there should be some"; exit 1; }

# must_refuse SED_COMMAND: what it makes of an idler's manifest is refused
must_refuse() {
  sed "$1" "$work/idler.xml" >"$work/broken.xml"
  cmp -s "$work/idler.xml" "$work/broken.xml" && { echo "FAILED: '$1' changes nothing"; status=1; }
  if is_valid "$work/broken.xml"; then echo "FAILED: accepted after '$1'"; status=1; fi
}
for fmu in "$@"; do
  [ "${fmu##*/}" = idler.fmu ] && unzip -p "$fmu" extra/org.stride.idle/fmi-ls-manifest.xml >"$work/idler.xml"
done
must_refuse 's/<Output /<Local /'
must_refuse 's/tolerance="[^"]*"/tolerance="0"/'
must_refuse 's/deadband="[^"]*"/deadband="-1"/'
must_refuse 's/valueReference="[^"]*"/valueReference="7"/'
must_refuse 's/fmi-ls:fmi-ls-name="[^"]*"//'
must_refuse 's/hasDerivative="true"/hasDerivative="much"/'
exit $status
