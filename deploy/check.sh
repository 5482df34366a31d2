#!/usr/bin/env bash
# Checks the sources by reading them, without building: in minutes. The last line reads `N passed, N failed`.
#   deploy/check.sh                  all of these, in this order
#   deploy/check.sh format           every source is laid out as .clang-format says
#   deploy/check.sh thread-safety    clang's analysis of what mapping/base/mutex.h guards, where it is used
#   deploy/check.sh sources          the same of every source, each by itself, without the precompiled headers of a build: so it
#                                    includes what it uses; takes some 10 minutes and is not part of the others
#   deploy/check.sh tidy [REVISION]  clang-tidy on the sources changed since REVISION and not committed yet; without it
#                                    on those that the newest commits touched, as many as two minutes allow
#   deploy/check.sh tidy-of K/N      clang-tidy on every Nth source, beginning with the Kth: an hour with N = 4
# What clang-tidy finds of style and speed is printed; what it finds of safety fails.
set -euo pipefail
cd "$(dirname "$0")/.."
deploy/setup.sh --quiet --checks

readonly rooms=(mapping storage proto/types server clients tests)
readonly max_tidy_files=8  # some 20 s of CPU time each
jobs=$(nproc)

# The compilation database, each source for itself, and the headers that the sources include but a build generates.
prepare() {
  mkdir -p build
  { cmake --preset release -B build/check -DDHPMAP_BUILD_TESTS=ON -DDHPMAP_PRECOMPILE=OFF &&
    cmake --build build/check --target dhpmap_generated; } >build/check-prepare.log 2>&1 || { cat build/check-prepare.log; return 1; }
}

check_format() {
  find "${rooms[@]}" \( -name '*.cc' -o -name '*.h' \) -print0 |
    xargs -0 -P "$jobs" -n 64 clang-format-14 --dry-run --Werror
}

# analyse FILE: as its compile command has it, but with clang and for warnings only.
analyse() {
  local command
  command=$(sed -nE "s|^ *\"command\": \"(.* -c [^ ]*/$1)\",?$|\\1|p" build/check/compile_commands.json | head -n 1)
  if [ -z "$command" ]; then
    echo "$1: no target compiles it"
    return 1
  fi
  command=${command//\\\"/\"} command=${command//\\\\/\\}  # as JSON has them
  (cd build/check && eval "clang++-14 -fsyntax-only -Wno-unknown-warning-option -Werror=thread-safety ${command#*++ } -Wno-conversion")
}
export -f analyse

# Fails unless the analysis sees what it is there for.
check_analysis_itself() {
  local seen
  seen=$(clang++-14 -std=c++20 -I. -fsyntax-only -Wthread-safety -x c++ - 2>&1 <<'CODE' || true
#include "mapping/base/mutex.h"
struct Counter {
  void Add() { ++count; }
  dhpmap::Mutex mutex;
  int count DHPMAP_GUARDED_BY(mutex) = 0;
};
CODE
  )
  grep -q "requires holding mutex 'mutex'" <<<"$seen" || { echo "an unguarded access goes unseen: $seen"; return 1; }
}

check_thread_safety() {
  prepare && check_analysis_itself || return 1
  local header='"mapping/base/mutex\.h"' holders
  holders=$(grep -rlE --include='*.h' "^#include $header" "${rooms[@]}" | sed 's|.*|"&"|' | paste -sd '|')
  grep -rlE --include='*.cc' "^#include ($header|${holders//./\\.})" "${rooms[@]}" | sort |
    xargs -r -P "$jobs" -I{} bash -c 'analyse {}'
}

compiled_sources() {
  sed -nE "s|^ *\"file\": \"$PWD/([^\"]*)\",?$|\\1|p" build/check/compile_commands.json | grep -v '^build/' | sort -u
}

check_sources() {
  prepare && check_analysis_itself || return 1
  compiled_sources | xargs -r -P "$jobs" -I{} bash -c 'analyse {}'
}

# The sources that changed: since a revision, or in the newest commits, newest first. A header stands for its source.
changed_sources() {
  if [ -n "${1:-}" ]; then
    git diff --name-only --diff-filter=d "$1" -- '*.cc' '*.h'
  else
    git diff --name-only --diff-filter=d HEAD -- '*.cc' '*.h'
    git log --first-parent -n 40 --format= --name-only --diff-filter=d -- '*.cc' '*.h'
  fi | sed 's|\.h$|.cc|' | awk '!seen[$0]++' | while read -r file; do
    if [ -f "$file" ] && grep -q "/$file\"" build/check/compile_commands.json; then echo "$file"; fi
  done
}

check_tidy() {
  prepare || return 1
  local files
  files=$(changed_sources "${1:-}")
  [ -n "${1:-}" ] || files=$(head -n "$max_tidy_files" <<<"$files")
  [ -z "$files" ] || tidy <<<"$files"
}

check_tidy_of() {
  prepare || return 1
  compiled_sources | awk -v k="${1%/*}" -v n="${1#*/}" 'NR % n == k % n' | tidy
}

# tidy: the sources that standard input names.
tidy() {
  xargs -P "$jobs" -n 1 clang-tidy-14 -p build/check --quiet --warnings-as-errors='bugprone-*,clang-analyzer-*,concurrency-*' \
    --extra-arg=-Wno-conversion 2>/dev/null
}

passed=0
failed=0
run() {
  echo "== check: $1"
  local start=$SECONDS
  if "check_${1//-/_}" "${@:2}"; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    echo "-- $1 failed"
  fi
  echo "-- $1: $((SECONDS - start)) s"
}

case "${1:-}" in
  "") for name in format thread-safety tidy; do run "$name"; done ;;
  format | thread-safety | sources) run "$1" ;;
  tidy | tidy-of) run "$@" ;;
  *)
    echo "usage: deploy/check.sh [format | thread-safety | sources | tidy [REVISION] | tidy-of K/N]" >&2
    exit 2
    ;;
esac
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
