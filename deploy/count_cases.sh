#!/usr/bin/env bash
# Counts the test cases of binaries that ctest ran whole, for deploy/test.sh. The last line reads `N passed, N failed`.
#   deploy/count_cases.sh FOLDER LOG ROOM...   binaries in FOLDER, their reports in FOLDER/reports, what ctest said in LOG
# What a binary lists is what counts: a case passes if the report says so, and fails if there is no word of it.
set -euo pipefail
readonly folder=$1 log=$2
shift 2

# of_report REPORT ATTRIBUTE: a number that GoogleTest gives for all cases together; without a report, 0.
of_report() {
  local value
  value=$(sed -nE "s/^<testsuites .*\b$2=\"([0-9]+)\".*/\1/p" "$1" 2>/dev/null) || true
  echo "${value:-0}"
}

passed=0
failed=0
for room in "$@"; do
  binary=$folder/${room//\//_}_test
  report=$folder/reports/${room//\//_}_test.xml
  if [ -x "$binary" ]; then
    listed=$("$binary" --gtest_list_tests 2>/dev/null | grep -c '^  ') || true
    good=$(($(of_report "$report" tests) - $(of_report "$report" failures) - $(of_report "$report" errors) - $(of_report "$report" disabled)))
  else  # no GoogleTest: what ctest says counts
    listed=1 good=1
  fi
  if ! grep -qE "^ *[0-9]+/[0-9]+ Test +#[0-9]+: $room \.+ +Passed " "$log" && [ "$good" -ge "$listed" ]; then
    good=$((listed - 1))  # all cases passed in a binary that failed: by a leak seen at its end, for example
  fi
  if [ "$listed" -lt 1 ] || [ "$good" -gt "$listed" ]; then
    listed=1 good=0  # lists nothing, or less than it ran
  fi
  [ "$good" -eq "$listed" ] || echo "$room: $good of $listed cases passed"
  passed=$((passed + good))
  failed=$((failed + listed - good))
done
if [ $# -eq 0 ]; then
  echo "there is no test binary to count"
  failed=1
fi
echo "$passed passed, $failed failed"
