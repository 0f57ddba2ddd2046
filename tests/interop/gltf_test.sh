#!/usr/bin/env bash
# gltf_test.sh STRIDE FOLDER WORLD SCENARIO...: Khronos' validator of glTF looks at the scenes of the worlds of these
# scenarios, and of the MJCF in the folder WORLD.
set -euo pipefail
stride=$(realpath "$1")
folder=$2
world=$(realpath "$3")
shift 3
here=$(cd "$(dirname "$0")/gltf" && pwd)

skip() {
  echo "SKIPPED: $1"
  [ "${CI:-}" = true ] && exit 1
  exit 77
}

mkdir -p "$folder"
if ! cmp -s "$here/package-lock.json" "$folder/installed"; then
  command -v npm >/dev/null || skip "there is no npm"
  cp "$here/package.json" "$here/package-lock.json" "$folder"
  (cd "$folder" && npm ci --ignore-scripts --no-audit --no-fund --no-update-notifier --loglevel=error) ||
    skip "the package gltf-validator cannot be installed (needs npm's registry)"
  cp "$here/package-lock.json" "$folder/installed"
fi

"$stride" pack mujoco_world.fmu --resources "$world" --output "$folder/every_geom.fmu"
cat > "$folder/every_geom.ssd" << 'END'
<ssd:SystemStructureDescription version="2.0" name="every_geom"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription">
  <ssd:System name="every_geom">
    <ssd:Elements><ssd:Component name="world" source="every_geom.fmu"/></ssd:Elements>
  </ssd:System>
  <ssd:DefaultExperiment startTime="0" stopTime="1"/>
</ssd:SystemStructureDescription>
END
files=()
for scenario in "$folder/every_geom.ssd" "$@"; do
  out=$folder/$(basename "$scenario" .ssd)
  "$stride" run "$scenario" --scene --no-checks --quiet --out "$out" || [ $? -eq 1 ]
  files+=("$out"/units/*/world.glb)
done
node "$here/validate.mjs" "$folder" "${files[@]}"
