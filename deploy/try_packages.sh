#!/usr/bin/env bash
# Tries the Debian packages where nothing else is: in clean Debian 12 systems (mmdebstrap) it installs them, starts the
# server as its user with the unit's command, feeds it and asks, upgrades from older packages, removes and purges, and
# says what it saw. Five minutes.
#   deploy/try_packages.sh [--new DIR] [--old DIR]
# DIR holds packages of deploy/package.sh; --new is build/package. Without --old the new programs are packed once more
# under version 0.0.1; a database of the first release is upgraded in any case. Needs root, and takes Debian's packages
# from where this machine has them.
set -euo pipefail
cd "$(dirname "$0")/.."
new=build/package old=""
while [ $# -gt 0 ]; do
  case "$1" in
    --new) new=${2:?a folder}; shift ;;
    --old) old=${2:?a folder}; shift ;;
    *) grep '^#   deploy/' "$0" >&2; exit 2 ;;
  esac
  shift
done
fail() { printf 'try_packages.sh: %s\n' "$*" >&2; exit 1; }
say() { printf '%4d s  %s\n' "$SECONDS" "$*"; }
[ "$(id -u)" = 0 ] || fail "needs root"
deploy/setup.sh --quiet --packaging
# shellcheck source=deploy/packaging/enter.sh
source deploy/packaging/enter.sh
ls "$new"/dhpmap-server_*.deb >/dev/null 2>&1 || fail "no packages in $new: make them with deploy/package.sh"

work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT
# A small recording, and older packages where none are named.
deploy/ci/build.sh release dhpmap-simulate >"$work/log" 2>&1 || { tail "$work/log" >&2; fail "no recording"; }
build/release/bin/dhpmap-simulate "$work/apartment" --frames 8 --width 160 --height 120 --quiet
if [ -z "$old" ]; then
  old=$work/old
  deploy/packaging/again.sh "$new" 0.0.1 "$old"
fi

base=build/package/debian.tar  # kept for the next time
deploy/packaging/clean_debian.sh "$base"
say "there is a clean Debian 12"

# system NAME: a clean system with the recording and both versions of the packages in /try.
system() {
  root=$work/$1
  unpack "$base" "$root"
  mkdir -p "$root"/try/{old,new}
  cp -r "$work/apartment" deploy/packaging/inside.sh "$root/try"
  cp "$old"/*.deb "$root/try/old"
  cp "$new"/*.deb "$root/try/new"
}
serve() { alone "$root" /try/inside.sh "$@"; }
apt_install() {
  inside "$root" apt-get update -qq >"$work/apt" 2>&1 || { cat "$work/apt" >&2; fail "no packages from Debian"; }
  inside "$root" sh -c "apt-get install -y -qq --no-install-recommends $*" >"$work/apt" 2>&1 ||
    { cat "$work/apt" >&2; fail "apt: $*"; }
}
version() { inside "$root" dpkg-query -W -f '${Version}' dhpmap-server; }
has_maps() { [ -s "$root/var/lib/dhpmap/maps.db" ]; }

say "== install"
system fresh
apt_install "/try/new/*.deb"
say "installed $(version): $(cd "$new" && echo *.deb | sed 's/_[^ ]*//g')"
serve feed_and_ask
say "== remove, install again, purge"
inside "$root" apt-get remove -y -qq dhpmap-server >"$work/apt" 2>&1 || { cat "$work/apt"; fail "remove"; }
has_maps || fail "removing has deleted the maps"
[ -f "$root/etc/dhpmap/dhpmap.yaml" ] || fail "removing has deleted the settings"
say "removed: maps and settings are there"
apt_install "/try/new/dhpmap-server_*.deb"
serve ask
inside "$root" apt-get purge -y -qq dhpmap-server >"$work/apt" 2>&1 || { cat "$work/apt"; fail "purge"; }
has_maps || fail "an unasked purge has deleted the maps"
[ ! -e "$root/etc/dhpmap/dhpmap.yaml" ] || fail "purging has left the settings"
say "purged unasked: the maps are there, the settings are gone"
apt_install "/try/new/dhpmap-server_*.deb"
serve ask
echo 'dhpmap-server dhpmap-server/purge_data boolean true' | inside "$root" debconf-set-selections
inside "$root" apt-get purge -y -qq dhpmap-server >"$work/apt" 2>&1 || { cat "$work/apt"; fail "purge"; }
[ ! -e "$root/var/lib/dhpmap" ] || fail "a purge that was told to delete the maps has left them"
say "purged with the answer yes: the maps are gone"
rm -rf --one-file-system "$root"

say "== upgrade"
system upgrade
apt_install "/try/old/dhpmap-server_*.deb /try/old/dhpmap_*.deb"
say "installed $(version)"
serve feed_and_ask
echo 'shutdown_grace_s: 3' >>"$root/etc/dhpmap/dhpmap.yaml"
apt_install -o Dpkg::Options::=--force-confold "/try/new/dhpmap-server_*.deb /try/new/dhpmap_*.deb"
grep -q '^shutdown_grace_s: 3' "$root/etc/dhpmap/dhpmap.yaml" || fail "the upgrade has changed the settings"
say "upgraded to $(version): the settings are as they were"
serve ask
cp tests/unit/storage/released/schema-1.sqlite "$root/var/lib/dhpmap/maps.db"
rm -f "$root"/var/lib/dhpmap/maps.db-*
inside "$root" chown dhpmap:dhpmap /var/lib/dhpmap/maps.db
serve serve_old_schema
say "try_packages.sh: everything works"
