#!/usr/bin/env bash
# Counts the test cases of binaries that ctest ran whole, for deploy/test.sh. The last line reads `N passed, N failed`.
#   deploy/count_cases.sh FOLDER LOG ROOM...   binaries in FOLDER, their reports in FOLDER/reports, what ctest said in LOG
# What a binary lists is what counts: a case passes if the report says so, and fails if there is no word of it.
# One that skips itself is neither: it is told in a line of its own.
# ROOM.1of2 and ROOM.2of2 are shards of one binary, each with a report of its own.
set -euo pipefail
readonly folder=$1 log=$2
shift 2

# of_reports ROOM ATTRIBUTE: a number that GoogleTest gives for all cases together, of all shards; without a report, 0.
of_reports() {
  local stem=$folder/reports/${1//\//_}_test sum=0 report value
  for report in "$stem".xml "$stem".*of*.xml; do
    value=$(sed -nE "s/^<testsuites .*\b$2=\"([0-9]+)\".*/\1/p" "$report" 2>/dev/null) || true
    sum=$((sum + ${value:-0}))
  done
  echo "$sum"
}

# skipped_in ROOM: how many cases skipped themselves, in all shards.
skipped_in() {
  local stem=$folder/reports/${1//\//_}_test
  cat "$stem".xml "$stem".*of*.xml 2>/dev/null | grep -c ' result="skipped"' || true
}

# has_passed NAME: whether ctest says so.
has_passed() { grep -qE "^ *[0-9]+/[0-9]+ Test +#[0-9]+: $1 \.+ +Passed " "$log"; }

passed=0
failed=0
for room in $(printf '%s\n' "$@" | sed -E 's/\.[0-9]+of[0-9]+$//' | awk '!seen[$0]++'); do
  binary=$folder/${room//\//_}_test
  if [ -x "$binary" ]; then
    listed=$("$binary" --gtest_list_tests 2>/dev/null | grep -c '^  ') || true
    good=$(($(of_reports "$room" tests) - $(of_reports "$room" failures) - $(of_reports "$room" errors) - $(of_reports "$room" disabled)))
  else  # no GoogleTest: what ctest says counts
    listed=1 good=1
  fi
  ended=passed
  for name in "$@"; do
    if [[ $name == "$room" || $name == "$room".*of* ]]; then has_passed "$name" || ended=failed; fi
  done
  if [ "$ended" = failed ] && [ "$good" -ge "$listed" ]; then
    good=$((listed - 1))  # all cases passed in a binary that failed: by a leak seen at its end, for example
  fi
  if [ "$listed" -lt 1 ] || [ "$good" -gt "$listed" ]; then
    listed=1 good=0  # lists nothing, or less than it ran
  fi
  [ "$good" -eq "$listed" ] || echo "$room: $good of $listed cases passed"
  skipped=0
  [ ! -x "$binary" ] || skipped=$(skipped_in "$room")
  [ "$skipped" -le "$good" ] || skipped=$good
  [ "$skipped" -eq 0 ] || echo "$room: $skipped skipped"
  passed=$((passed + good - skipped))
  failed=$((failed + listed - good))
done
if [ $# -eq 0 ]; then
  echo "there is no test binary to count"
  failed=1
fi
echo "$passed passed, $failed failed"
