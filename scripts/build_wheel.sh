#!/usr/bin/env bash
# Makes the Python wheel: the program, the units and the scenarios, with the libraries that a system may lack.
#   scripts/build_wheel.sh [BUILD-FOLDER]     build/release is built unless a folder is named, of a build that is there
# The wheel is build/wheel/stride_cosim-*.whl, and no other is left there. Exit code 77 = PyPI cannot be reached.
set -euo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)

if [ $# -gt 0 ]; then
  build=$(cd "$1" && pwd)
else
  cd "$here"
  source scripts/packages.sh
  install_packages "${packages_build[@]}" python3 python3-venv
  cmake --preset release -DSTRIDE_BUILD_TESTS=OFF --log-level=WARNING
  cmake --build --preset release
  build=$here/build/release
fi

wheels=$here/build/wheel
rm -f "$wheels"/*.whl
tools=$wheels/tools
"$here/tests/interop/make_venv.sh" "$tools" "$here/scripts/wheel_requirements.txt"
PATH=$tools/bin:$PATH

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python -m pip wheel --quiet --disable-pip-version-check --no-deps --no-build-isolation --wheel-dir "$work" \
  --config-settings=cmake.define.STRIDE_BUILD="$build" "$here/python"
python "$here/scripts/repair_wheel.py" "$work"/*.whl "$wheels"
