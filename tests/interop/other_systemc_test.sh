#!/usr/bin/env bash
# other_systemc_test.sh CMAKE SOURCES FOLDER: the SystemC kit, its tests and the designs of SystemC's own distribution,
# built with the SystemC whose prefix is in STRIDE_OTHER_SYSTEMC, such as a 3.0. The folder keeps the build.
set -euo pipefail
cmake=$1
sources=$2
folder=$3

prefix=${STRIDE_OTHER_SYSTEMC:-}
if [ -z "$prefix" ]; then
  echo "SKIPPED: STRIDE_OTHER_SYSTEMC names no prefix of another SystemC, such as 3.0"
  exit 77
fi
[ -e "$prefix/include/systemc" ] || { echo "FAILED: there is no include/systemc in $prefix"; exit 1; }

"$cmake" -S "$sources" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_UNITY_BUILD=ON \
  -DCMAKE_UNITY_BUILD_BATCH_SIZE=40 -DCMAKE_PREFIX_PATH="$prefix" --log-level=WARNING
designs=$(ninja -C "$folder" -t targets all | sed -n 's/^\(interop_systemc_[a-z0-9_]*\): phony$/\1/p')
ninja -C "$folder" systemc_tests sensor_tests $designs

program=$folder/tests/units/systemc/systemc_tests
ldd "$program" | grep "libsystemc.*$(realpath "$prefix")" || { echo "FAILED: built with another SystemC"; exit 1; }
"$program"
"$folder/tests/units/sensor/sensor_tests"
for design in $designs; do
  "$folder/tests/interop/$design"
done
[ -n "$designs" ] || echo "without the designs of SystemC's distribution, which STRIDE_SYSTEMC_EXAMPLES names"
