#!/usr/bin/env bash
# Feeds each parser with damaged inputs, many more than the tests do, under the sanitizers for addresses and undefined
# behaviour: guided by coverage with clang's libFuzzer, or with the tests' own engine where that cannot be installed.
# What ends otherwise than with a value or a clear error is a file in the folder of findings, beside it a .txt with the
# command that repeats it.
#   scripts/fuzz.sh [--inputs N] [--seed N] [--findings FOLDER] [PARSER...]
#     --inputs N          for each parser (100000)
#     --seed N            other inputs (the day)
#     --findings FOLDER   (build/fuzz_findings)
#     PARSER              all of them if there is none
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh

inputs=100000 seed=$(date +%Y%m%d) findings=build/fuzz_findings parsers=()
while [ $# -gt 0 ]; do
  case "$1" in
    --inputs) inputs=$2 && shift 2 ;;
    --seed) seed=$2 && shift 2 ;;
    --findings) findings=$2 && shift 2 ;;
    -*) sed -n '2,/^set/s/^# \?//p' "$0" >&2 && exit 2 ;;
    *) parsers+=("$1") && shift ;;
  esac
done

install_packages "${packages_build[@]}"
preset=asan targets=(fuzz)
if install_packages "${packages_fuzz[@]}"; then
  preset=fuzz targets+=(fuzz_guided)
fi
cmake --preset "$preset" --log-level=WARNING -DSTRIDE_BUILD_TESTS=ON
cmake --build --preset "$preset" --target "${targets[@]}"

folder=build/$preset/tests/fuzz
corpus=build/fuzz_corpus # grows from night to night
mkdir -p "$findings"
findings=$(realpath "$findings")
export ASAN_OPTIONS=intercept_tls_get_addr=0:max_allocation_size_mb=1024:hard_rss_limit_mb=4096
export LSAN_OPTIONS=suppressions=$PWD/tests/lsan.supp:print_suppressions=0
export folder corpus findings inputs seed

# guided PARSER
guided() {
  "$folder/fuzz" seeds "$1" "$corpus/$1"
  if STRIDE_FUZZ_PARSER=$1 "$folder/fuzz_guided" -runs="$inputs" -seed="$seed" -timeout=10 -rss_limit_mb=2048 \
    -malloc_limit_mb=1024 -max_len=20000 -artifact_prefix="$findings/$1-" "$corpus/$1" >"$findings/$1.log" 2>&1; then
    echo "$1: no findings"
    rm "$findings/$1.log"
    return
  fi
  echo "$1: finding, see $findings/$1.log"
  local file
  for file in "$findings/$1"-*; do
    [[ ! -e $file || $file == *.txt ]] || echo "$PWD/$folder/fuzz read $1 $file" | tee "$file.txt"
  done
  return 1
}

# unguided PARSER
unguided() { "$folder/fuzz" run --inputs "$inputs" --seed "$seed" --findings "$findings" "$1"; }

export -f guided unguided
[ "$preset" = fuzz ] && engine=guided || engine=unguided
[ ${#parsers[@]} -gt 0 ] || mapfile -t parsers < <("$folder/fuzz" list)
printf '%s\n' "${parsers[@]}" | xargs -P "$(nproc)" -I{} bash -c "$engine {}"
