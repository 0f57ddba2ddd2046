#!/bin/sh
# Fetches MuJoCo 3, headers and library, into a folder: the Python package `mujoco` from PyPI, unpacked, not installed.
#   scripts/fetch_mujoco3.sh build/mujoco3 && cmake --preset debug -DMuJoCo_ROOT=$PWD/build/mujoco3/mujoco
set -eu

version=3.17.0

if [ $# -ne 1 ]; then
  echo "usage: $0 FOLDER" >&2
  exit 2
fi
if [ -e "$1/mujoco/libmujoco.so.$version" ]; then
  exit 0
fi

download=$(mktemp -d)
trap 'rm -rf "$download"' EXIT
# one wheel is as good as the other: the C library in it does not depend on Python
python3 -m pip download --quiet --no-deps --only-binary=:all: \
  --python-version 3.11 --implementation cp --abi cp311 --dest "$download" "mujoco==$version"
mkdir -p "$1"
python3 -m zipfile -e "$download"/mujoco-*.whl "$1"
