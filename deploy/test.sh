#!/usr/bin/env bash
# Installs what is missing, builds, and runs all tests; the last line reads `N passed, N failed`.
#   deploy/test.sh                       every test of the release build; rigs and benchmarks are not built
#   deploy/test.sh --sanitizers [S]      under ASan+UBSan and TSan, what the last day's commits touched first; for S seconds at most
#   deploy/test.sh --asan | --tsan       one of them
#   deploy/test.sh --sanitizers-of-tools those of the evaluator and the simulator under ASan+UBSan
#   deploy/test.sh --fuzz S              each fuzz target for S seconds, from its seeds on; what it finds stays in build/fuzz/findings
set -euo pipefail
cd "$(dirname "$0")/.."
sanitizers() {
  deploy/setup.sh --quiet --checks
  exec deploy/ci/sanitizers.py "$@"
}
case "${1:-}" in
  "") ;;
  --sanitizers) sanitizers ${2:+--for "$2" --fuzz 20} ;;
  --asan | --tsan) sanitizers --presets "${1#--}" ;;
  --sanitizers-of-tools) sanitizers --presets asan --kinds tool ;;
  --fuzz) sanitizers --presets asan --kinds none --fuzz "${2:?seconds a target}" ;;
  *)
    sed -n '3,7p' "$0" >&2
    exit 2
    ;;
esac
deploy/setup.sh --quiet --browser
deploy/ci/build.sh release tests || { echo "0 passed, 1 failed"; exit 1; }
echo "== release: test"
exec deploy/ci/run_rooms.py build/release/tests/rooms.json
