#!/usr/bin/env bash
# install_packages.sh NPM FOLDER: installs the packages that FOLDER/package-lock.json names, in FOLDER.
set -u
cd "$2" || exit 1
"$1" ci --ignore-scripts --no-audit --no-fund --no-update-notifier --loglevel=error && exit 0
echo "The packages of the report's page cannot be installed; this needs a network once." >&2
echo "-DSTRIDE_REPORT=OFF builds a stride without reports." >&2
exit 1
