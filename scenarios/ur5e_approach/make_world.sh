#!/usr/bin/env bash
# Packs ur5e_world.fmu: the arm of the Python package airo-models (a UR5e as URDF, MIT licence) with the scene beside this
# script. Nothing of the package is part of stride.
#   scenarios/ur5e_approach/make_world.sh build/release
# It goes to the units of that build or installation. Exit code 77 = the package cannot be fetched from PyPI.
set -euo pipefail

version=0.0.12

if [ $# -ne 1 ] || [ ! -x "$1/bin/stride-robot" ]; then
  echo "usage: $0 FOLDER, that of a build of stride, such as build/release, or of an installation" >&2
  exit 2
fi
here=$(cd "$(dirname "$0")" && pwd)
build=$(cd "$1" && pwd)
units=$build/units
[ -d "$units" ] || units=$build/lib/stride/units
package=$build/robots/airo_models-$version

if [ ! -d "$package" ]; then
  mkdir -p "$build/robots"
  download=$(mktemp -d "$build/robots/download-XXXXXX")
  trap 'rm -rf "$download"' EXIT
  python3 -m pip download --quiet --disable-pip-version-check --no-deps --only-binary=:all: \
    --dest "$download" "airo-models==$version" || exit 77
  python3 -m zipfile -e "$download"/airo_models-*.whl "$download/package"
  mv "$download/package" "$package"
fi

world=$build/robots/ur5e_world
rm -rf "$world"
cp -r "$here/world" "$world"
"$build/bin/stride-robot" convert "$package/airo_models/arms/ur5e/ur5e.urdf" --mount "tool0=$here/antenna.xml" \
  --output "$world/ur5e.xml"
"$build/bin/stride" pack mujoco_world.fmu --resources "$world" --output "$units/ur5e_world.fmu"
