#!/usr/bin/env bash
# Builds stride and runs the flagship scenario. Further arguments go to `stride run`; the results lie in results/.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh

install_packages "${packages_build[@]}"
cmake --preset release -DSTRIDE_BUILD_TESTS=OFF --log-level=WARNING
cmake --build --preset release
exec build/release/bin/stride run scenarios/nfc_approach/nfc_approach.ssd --out results/nfc_approach --film=0.2 --scene "$@"
