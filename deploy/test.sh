#!/usr/bin/env bash
# Installs what is missing, builds, and runs all tests; the last line reads `N passed, N failed`.
#   deploy/test.sh               the release build and every test
#   deploy/test.sh --asan        unit tests of mapping, storage, server and the clients that talk to one under ASan+UBSan
#   deploy/test.sh --tsan        base, crf, evidence, refinement, pipeline, storage, server and integration tests under TSan
#   deploy/test.sh --sanitizers  both
#   deploy/test.sh --sanitizers-of-tools  those of the evaluator and the simulator under ASan+UBSan
#   deploy/test.sh --fuzz SECONDS  each fuzz target for so long, from its seeds on; what it finds stays in build/fuzz/findings
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-}" in
  --fuzz) deploy/setup.sh --quiet --checks ;;  # libFuzzer is clang's
  *) deploy/setup.sh --quiet ;;
esac

passed=0
failed=0
# build PRESET TARGET
build() {
  local preset=$1 target=$2
  echo "== $preset: configure and build"
  cmake --preset "$preset" -DDHPMAP_BUILD_TESTS=ON >"build/$preset-configure.log" 2>&1 || { cat "build/$preset-configure.log"; exit 1; }
  cmake --build --preset "$preset" --target "$target" >"build/$preset-build.log" 2>&1 || { tail -n 60 "build/$preset-build.log"; exit 1; }
}

# Every case in a process of its own; adds to passed and failed.
test_release() {
  echo "== release: test"
  local log=build/release-test.log
  ctest --preset release -j "$(nproc)" >"$log" 2>&1 || true
  local total bad skipped
  total=$(sed -nE 's/^[0-9]+% tests passed, ([0-9]+) tests failed out of ([0-9]+)$/\2/p' "$log")
  bad=$(sed -nE 's/^[0-9]+% tests passed, ([0-9]+) tests failed out of ([0-9]+)$/\1/p' "$log")
  if [ -z "$total" ]; then
    tail -n 60 "$log"
    echo "0 passed, 1 failed"
    exit 1
  fi
  skipped=$(grep -cE '^ *[0-9]+/[0-9]+ Test +#.*\*\*\*Skipped' "$log") || true
  if [ "$skipped" -gt 0 ]; then
    echo "$skipped skipped:"
    sed -nE 's/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: (.*[^.]) \.+\*\*\*Skipped.*/  \1/p' "$log"
  fi
  if [ "$bad" -gt 0 ]; then grep -vE '^ *[0-9]+/[0-9]+ Test +#|^ +Start ' "$log" | tail -n 200; fi
  sed -nE 's/^Total Test time.*/&/p' "$log"
  passed=$((passed + total - bad - skipped))
  failed=$((failed + bad))
}

# test_binaries PRESET PATTERN: those of matching rooms, each in one process; adds to passed and failed.
test_binaries() {
  local preset=$1 pattern=$2
  echo "== $preset: test"
  local log="build/$preset-test.log" rooms counts
  rm -rf "build/$preset/tests/reports"
  ctest --preset "$preset" -j "$(nproc)" -R "$pattern" >"$log" 2>&1 || true
  rooms=$(ctest --preset "$preset" -N -R "$pattern" | sed -nE 's/^ *Test +#[0-9]+: //p')
  # shellcheck disable=SC2086  # one word a room
  counts=$(deploy/count_cases.sh "build/$preset/tests" "$log" $rooms)
  if ! tail -n 1 <<<"$counts" | grep -q ' 0 failed$'; then
    # What the binaries that failed wrote, but for cases that passed without a word.
    awk '/^\[ RUN      \]/ { run = $0; next }
         /^\[       OK \]/ { if (run != "") { run = ""; next } }
         { if (run != "") print run; run = ""; print }' "$log" | tail -n 400
  fi
  sed -nE 's/^Total Test time.*/&/p' "$log"
  sed '$d' <<<"$counts"
  passed=$((passed + $(tail -n 1 <<<"$counts" | cut -d' ' -f1)))
  failed=$((failed + $(tail -n 1 <<<"$counts" | cut -d' ' -f3)))
}

# fuzz_target NAME SECONDS: from its seeds and the corpus on. Fails on a finding, which stays in build/fuzz/findings.
fuzz_target() {
  local name=$1 seconds=$2 work=build/fuzz/corpus/$1 log=build/fuzz/$1.log
  mkdir -p "$work" "tests/fuzz/corpus/$name"
  "build/fuzz/tests/${name}_replay" --write-seeds "$work"
  if "build/fuzz/fuzz/${name}_fuzz" -max_total_time="$seconds" -max_len=4096 -timeout=10 -rss_limit_mb=2048 \
    -print_final_stats=1 -artifact_prefix="build/fuzz/findings/$name-" "$work" "tests/fuzz/corpus/$name" >"$log" 2>&1; then
    echo "$name: $(sed -nE 's/^stat::number_of_executed_units: *//p' "$log") inputs, nothing found"
  else
    echo "$name: a finding, see $log"
    grep -E 'ERROR:|SUMMARY:|runtime error|Test unit written' "$log" | head -n 5
  fi
}
export -f fuzz_target

# Each target of tests/fuzz for so many seconds, one on each core; adds to passed and failed.
fuzz() {
  local results
  build fuzz dhpmap_fuzzers
  echo "== fuzz: run"
  mkdir -p build/fuzz/findings
  results=$(find build/fuzz/fuzz -name '*_fuzz' -printf '%f\n' | sed 's/_fuzz$//' | sort |
    xargs -P "$(nproc)" -I{} bash -c "fuzz_target {} $1")
  echo "$results"
  passed=$((passed + $(grep -c 'nothing found$' <<<"$results" || true)))
  failed=$((failed + $(grep -c ': a finding, see' <<<"$results" || true)))
  [ "$passed" -gt 0 ] || failed=$((failed + 1))
}

asan() {
  export ASAN_OPTIONS=detect_leaks=1 UBSAN_OPTIONS=print_stacktrace=1
  build asan dhpmap_unit_tests
  test_binaries asan '^unit/(mapping|storage|server|fuzz|rig|clients/(cli|datasets)$)'
}

tsan() {
  # Without the list of addresses that it has told of or left out: each access to one is looked up in all of it.
  export TSAN_OPTIONS="halt_on_error=1:suppress_equal_addresses=0:suppressions=$PWD/deploy/tsan.supp"
  build tsan dhpmap_threaded_tests
  # Faults at each call of a single thread: nothing to race with, most of storage's time, and AddressSanitizer has run them.
  export GTEST_FILTER='-SqliteStoreTest.KilledAt*:SqliteStoreTest.FlippedBytes*:*BrokenDisk*:BrokenReclaim*'
  test_binaries tsan '^(integration|unit/(server/(app|wire|net|grpc|http|json|gateway|config|log|metrics)|storage|mapping/(base|crf|evidence|refinement|pipeline)))(\.[0-9]+of[0-9]+)?$'
}

mkdir -p build
case "${1:-}" in
  "")
    build release all
    test_release
    ;;
  --sanitizers-of-tools)
    export ASAN_OPTIONS=detect_leaks=1 UBSAN_OPTIONS=print_stacktrace=1
    build asan dhpmap_tool_tests
    test_binaries asan '^unit/clients/(evaluator|simulator)'
    ;;
  --asan) asan ;;
  --tsan) tsan ;;
  --sanitizers)
    asan
    tsan
    ;;
  --fuzz) fuzz "${2:?seconds a target}" ;;
  *)
    echo "usage: deploy/test.sh [--asan | --tsan | --sanitizers | --sanitizers-of-tools | --fuzz SECONDS]" >&2
    exit 2
    ;;
esac
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
