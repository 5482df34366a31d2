#!/usr/bin/env bash
# Makes the Debian packages dhpmap-server, dhpmap, libdhpmap-dev and python3-dhpmap from this tree; needs no network
# but apt's.
#   deploy/package.sh [--build DIR] [--version VERSION] [--out DIR] [--lint]
# --build packs the programs of a build tree as they are (build/release: quick, for trying). Without it they are
# compiled with Debian's flags, into build/package/objects: some 10 minutes on two cores the first time.
# --version: else that of CMakeLists.txt, and, where no tag names it, the time and name of the commit behind a `+`.
# The packages go to build/package, or --out. --lint runs lintian on them; its errors fail.
# DEB_BUILD_OPTIONS counts (parallel=N), and so does SOURCE_DATE_EPOCH: else the time of the commit.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
build="" version="" lint="" out=$root/build/package
while [ $# -gt 0 ]; do
  case "$1" in
    --build) build=$(realpath "${2:?a build tree}"); shift ;;
    --version) version=${2:?a version}; shift ;;
    --out) mkdir -p "${2:?a folder}"; out=$(realpath "$2"); shift ;;
    --lint) lint=1 ;;
    *) grep '^#   deploy/' "$0" >&2; exit 2 ;;
  esac
  shift
done
fail() { printf 'package.sh: %s\n' "$*" >&2; exit 1; }

deploy/setup.sh --quiet --packaging
for program in dhpmap-server dhpmap; do
  [ -z "$build" ] || [ -x "$build/bin/$program" ] || fail "$build/bin/$program is not built"
done
project=$(sed -nE 's/^project\(dhpmap VERSION ([0-9.]+) .*/\1/p' CMakeLists.txt)
commit=$(git log -1 --format=%h) committed=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$committed}
if [ -z "$version" ]; then
  version=$project
  [ "$(git describe --exact-match --tags 2>/dev/null || true)" = "v$project" ] ||
    version+="+$(date -u -d "@$committed" +%Y%m%d%H%M%S).$commit"
fi

# What git knows of, as it is now, with debian/ where dpkg looks for it. Times stay: a second build compiles what
# changed.
tree=$root/build/package/tree
rm -rf "$tree"
mkdir -p "$tree" "$out"
git ls-files -z -- . ':!tests' | tar --null -T - -c | tar -x -C "$tree"
cp -rp deploy/debian "$tree/debian"
maintainer=$(sed -n 's/^Maintainer: //p' deploy/debian/control)
cat >"$tree/debian/changelog" <<CHANGELOG
dhpmap ($version) bookworm; urgency=medium

  * Made from commit $commit; CHANGELOG.md says what is new.

 -- $maintainer  $(date -u -R -d "@$SOURCE_DATE_EPOCH")
CHANGELOG

export PATH=/usr/sbin:/usr/bin:/sbin:/bin  # Debian's Python, not another
export DEB_BUILD_OPTIONS="${DEB_BUILD_OPTIONS:-parallel=$(nproc)} nocheck"
export DHPMAP_BUILD=$build DHPMAP_OBJECTS=$root/build/package/objects GOOGLEAPIS=$root/build/googleapis
[ -n "$build" ] || unset DHPMAP_BUILD
log=$root/build/package/log
rm -f "$root"/build/package/*.{deb,changes,buildinfo}
(cd "$tree" && dpkg-buildpackage -b -us -uc) >"$log" 2>&1 || { tail -n 30 "$log" >&2; fail "not made: $log"; }
if [ -n "$lint" ]; then
  lintian --fail-on error --tag-display-limit 0 "$root"/build/package/*.changes || fail "lintian found errors"
fi
[ "$out" = "$root/build/package" ] || mv "$root"/build/package/*.{deb,changes,buildinfo} "$out"
(cd "$out" && ls -sh1 -- *"_${version}_"*.deb)
