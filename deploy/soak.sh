#!/usr/bin/env bash
# What takes too long for every change, by hand before a release: in parts of at most an hour on two quick cores. The last
# line reads `N passed, N failed`, over all parts that this commit has behind it. A part that is done is not done again.
#   deploy/soak.sh [HOURS]       begins parts until HOURS (8) are over; call it again to go on
#   deploy/soak.sh --part PART   this part, anew
#   deploy/soak.sh --list        the parts, and how they ended
set -euo pipefail
cd "$(dirname "$0")/.."

readonly bin=build/release/bin demo=build/soak/apartment
folder=build/soak/$(git rev-parse HEAD)
parts=(asan tsan tools fuzz lint-1 lint-2 lint-3 lint-4 sources properties load hostile maps rigs kills killed power memory)

release() { deploy/setup.sh --quiet && deploy/ci/build.sh release all dhpmap-check-points; }
dataset() {
  release
  [ -d "$demo" ] || { "$bin/dhpmap-simulate" "$demo.new" --frames 120 && mv "$demo.new" "$demo"; }
}
# every COMMAND: one a line of standard input; all run, whatever ends how. Prints what they came to.
every() {
  local passed=0 failed=0 skipped=0 command code
  while read -r command; do
    echo "== $command"
    code=0
    eval "$command" </dev/null || code=$?
    case $code in
      0) passed=$((passed + 1)) ;;
      77) skipped=$((skipped + 1)) ;;  # it has said why it cannot run here
      *) failed=$((failed + 1)) && echo "-- exit $code: $command" ;;
    esac
  done
  [ "$skipped" -eq 0 ] || echo "$skipped skipped"
  echo "$passed passed, $failed failed"
  [ "$failed" -eq 0 ]
}

# Each prints `N passed, N failed` at its end.
part_asan() { deploy/test.sh --asan; }
part_tsan() { deploy/test.sh --tsan; }
part_tools() { deploy/test.sh --sanitizers-of-tools; }
part_fuzz() { deploy/test.sh --fuzz 600; }
part_lint-1() { deploy/check.sh tidy-of 1/4; }
part_lint-2() { deploy/check.sh tidy-of 2/4; }
part_lint-3() { deploy/check.sh tidy-of 3/4; }
part_lint-4() { deploy/check.sh tidy-of 4/4; }
part_sources() { deploy/check.sh sources; }
part_properties() {
  release
  every <<<"DHPMAP_PROPERTY_STEPS=4000 build/release/tests/unit_server_app_test --gtest_filter='*Property*'"
}
part_load() {
  dataset
  every <<<"$bin/dhpmap-rig load $demo --seconds 600
$bin/dhpmap-rig soak $demo --seconds 1800"
}
part_hostile() { dataset; every <<<"$bin/dhpmap-rig hostile $demo"; }
part_maps() { release; every <<<"$bin/dhpmap-rig maps"; }
part_rigs() {
  dataset
  every <<<"$bin/dhpmap-rig apartments $demo
$bin/dhpmap-rig doors $demo
$bin/dhpmap-rig watchers $demo
$bin/dhpmap-rig two-feeders $demo"
}
part_kills() { release; every <<<"$bin/dhpmap-rig-kills --kills 300"; }
part_killed() { release; every <<<"build/release/tests/e2e_test --gtest_filter='*Kill*' --gtest_repeat=20"; }
part_power() { release; every <<<"tests/rig/power_cut.sh"; }
# Bounds that a busy machine would break: they are held here, where nothing else runs.
part_memory() { dataset; every <<<"$bin/dhpmap-bench budget $demo"; }

run() {
  local part=$1 log=$folder/$1.log code=0 start=$SECONDS
  mkdir -p "$folder"
  echo "== soak: $part"
  "part_$part" 2>&1 | tee "$log.new" || code=$?
  grep -qE '^[0-9]+ passed, [0-9]+ failed$' "$log.new" || echo "0 passed, 1 failed" >>"$log.new"
  mv "$log.new" "$log"
  echo "-- soak: $part: exit $code after $((SECONDS - start)) s"
}
counts_of() { grep -E '^[0-9]+ passed, [0-9]+ failed$' "$folder/$1.log" 2>/dev/null | tail -n 1; }
# The sum over the parts that are done; fails if one has failed.
sum() {
  local part passed=0 failed=0 counts
  for part in "${parts[@]}"; do
    counts=$(counts_of "$part") || { echo "not done yet: $part"; continue; }
    echo "$part: $counts"
    passed=$((passed + $(cut -d' ' -f1 <<<"$counts"))) failed=$((failed + $(cut -d' ' -f3 <<<"$counts")))
  done
  echo "$passed passed, $failed failed"
  [ "$failed" -eq 0 ]
}

case "${1:-8}" in
  --list) ;;
  --part)
    [[ " ${parts[*]} " == *" ${2:-} "* ]] || { echo "the parts are: ${parts[*]}" >&2; exit 2; }
    run "$2"
    ;;
  *[!0-9.]*)
    sed -n '4,6p' "$0" >&2
    exit 2
    ;;
  *)
    end_s=$(awk -v hours="${1:-8}" 'BEGIN { printf "%d", hours * 3600 }')
    for part in "${parts[@]}"; do
      if [ "$SECONDS" -lt "$end_s" ] && ! counts_of "$part" >/dev/null; then run "$part"; fi
    done
    ;;
esac
sum
