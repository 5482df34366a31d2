#!/usr/bin/env bash
# Installs what is missing, builds, and runs all tests; the last line reads `N passed, N failed`.
#   deploy/test.sh               the release build and every test
#   deploy/test.sh --sanitizers  all unit tests under ASan+UBSan; refinement, pipeline, storage, server and integration tests under TSan
#                                (but server/rest: one abort inside TSan's allocator there, while gRPC freed a call, is not explained)
set -euo pipefail
cd "$(dirname "$0")/.."
deploy/setup.sh --quiet

passed=0
failed=0
# build_and_test PRESET TARGET [ctest arguments]: adds to passed and failed.
build_and_test() {
  local preset=$1 target=$2
  shift 2
  echo "== $preset: configure and build"
  cmake --preset "$preset" -DDHPMAP_BUILD_TESTS=ON >"build/$preset-configure.log" 2>&1 || { cat "build/$preset-configure.log"; exit 1; }
  cmake --build --preset "$preset" --target "$target" >"build/$preset-build.log" 2>&1 || { tail -n 60 "build/$preset-build.log"; exit 1; }
  echo "== $preset: test"
  local log="build/$preset-test.log"
  ctest --preset "$preset" -j "$(nproc)" "$@" >"$log" 2>&1 || true
  local total bad
  total=$(sed -nE 's/^[0-9]+% tests passed, ([0-9]+) tests failed out of ([0-9]+)$/\2/p' "$log")
  bad=$(sed -nE 's/^[0-9]+% tests passed, ([0-9]+) tests failed out of ([0-9]+)$/\1/p' "$log")
  if [ -z "$total" ]; then
    tail -n 60 "$log"
    echo "0 passed, 1 failed"
    exit 1
  fi
  if [ "$bad" -gt 0 ]; then grep -vE '^ *[0-9]+/[0-9]+ Test +#|^ +Start ' "$log" | tail -n 200; fi
  sed -nE 's/^Total Test time.*/&/p' "$log"
  passed=$((passed + total - bad))
  failed=$((failed + bad))
}

mkdir -p build
case "${1:-}" in
  "") build_and_test release all ;;
  --sanitizers)
    export ASAN_OPTIONS=detect_leaks=1 UBSAN_OPTIONS=print_stacktrace=1 TSAN_OPTIONS="halt_on_error=1:suppressions=$PWD/deploy/tsan.supp"
    build_and_test asan dhpmap_unit_tests -R '^unit/'
    build_and_test tsan dhpmap_threaded_tests -R '^(integration|unit/server/(app|grpc|ingest|config|log|metrics)|unit/storage|unit/mapping/(base|refinement|pipeline))/'
    ;;
  *)
    echo "usage: deploy/test.sh [--sanitizers]" >&2
    exit 2
    ;;
esac
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
