#!/usr/bin/env bash
# gymnasium_worlds_test.sh PROGRAMS FOLDER: each MJCF of the Python package gymnasium (MIT licence) becomes a world,
# whatever its joints and drives are, and stride-robot converts it to one with the same variables. One is verified.
set -euo pipefail
stride=$1/stride
robot=$1/stride-robot
folder=$2
version=1.4.0

mkdir -p "$folder"
cd "$folder"
if [ ! -d "gymnasium-$version" ]; then
  rm -rf download && mkdir download
  python3 -m pip download --quiet --disable-pip-version-check --no-deps --only-binary=:all: --dest download \
    "gymnasium==$version" || {
    echo "SKIPPED: the package gymnasium cannot be fetched (needs PyPI)"
    [ "${CI:-}" = true ] && exit 1
    exit 77
  }
  python3 -m zipfile -e download/*.whl unpacked
  mv unpacked "gymnasium-$version"
fi

# pack MODEL NAME: as the world NAME.fmu, with its variables in NAME.txt
pack() {
  rm -rf "$2" && mkdir "$2"
  cp "$1" "$2/scene.xml"
  "$stride" pack mujoco_world.fmu --resources "$2" --output "$2.fmu"
  "$stride" inspect "$2.fmu" | awk '$2 == "input" || $2 == "output" { print $1, $2, $3, $4 }' > "$2.txt"
}

count=0
for model in "gymnasium-$version"/gymnasium/envs/mujoco/assets/*.xml; do
  name=$(basename "$model" .xml)
  pack "$model" "$name"
  [ -s "$name.txt" ] || { echo "$name has no variables"; exit 1; }
  "$robot" convert "$model" --output "converted/$name.xml" > /dev/null
  pack "converted/$name.xml" "${name}_converted"
  diff "$name.txt" "${name}_converted.txt" || { echo "$name has other variables when it is converted"; exit 1; }
  count=$((count + 1))
done
[ $count -ge 10 ] || { echo "only $count models were found"; exit 1; }

"$stride" verify swimmer.fmu --instances 40 > verify.txt || { cat verify.txt; exit 1; }
echo "$count worlds"
