#!/usr/bin/env bash
# Configures and builds, with a line for each percent done; prints the compiler's words only where it fails.
#   deploy/ci/build.sh PRESET [TARGET...]
# What took longest is in the last lines. Logs: build/PRESET-configure.log, build/PRESET-build.log.
set -euo pipefail
cd "$(dirname "$0")/../.."
readonly preset=$1
shift
mkdir -p build
echo "== $preset: configure"
cmake --preset "$preset" -DDHPMAP_BUILD_TESTS=ON >"build/$preset-configure.log" 2>&1 || { cat "build/$preset-configure.log"; exit 1; }
echo "== $preset: build"
log=build/$preset-build.log
ninja_log=build/$preset/.ninja_log
before=$({ wc -l <"$ninja_log"; } 2>/dev/null || echo 0)
NINJA_STATUS='[%p of %t] ' cmake --build --preset "$preset" ${1:+--target "$@"} 2>&1 | tee "$log" |
  awk '/^\[ *[0-9]+% of [0-9]+\] / { percent = $2; sub("%", "", percent); if (percent != last) { print; fflush(); last = percent } }' || {
  tail -n 60 "$log"
  exit 1
}
# Milliseconds of start and end, and what was made: the slowest of this build, one line a command.
tail -n "+$((before + 1))" "$ninja_log" 2>/dev/null | awk -F'\t' 'NF >= 4 { took[$1 " " $2] = $2 - $1; made[$1 " " $2] = $4 }
  END { for (i in took) if (took[i] >= 1000) printf "%6.1f s  %s\n", took[i] / 1000, made[i] }' | sort -rn | sed -n 1,10p |
  { mapfile -t slowest; [ ${#slowest[@]} -eq 0 ] || printf '%s\n' "-- slowest of it:" "${slowest[@]}"; }
