#!/usr/bin/env bash
# deploy/packaging/clean_debian.sh FILE: a clean Debian 12 as a tar, from where this machine has its packages; one that
# is there is kept.
set -euo pipefail
[ ! -f "$1" ] || exit 0
sources=$(mktemp --suffix=.sources)
trap 'rm -f "$sources"' EXIT
cat /etc/apt/sources.list.d/*.sources 2>/dev/null |
  awk 'BEGIN { RS = ""; ORS = "\n\n" } /debian-archive-keyring/' >"$sources"
if [ ! -s "$sources" ]; then
  grep -hE '^deb .*bookworm' /etc/apt/sources.list /etc/apt/sources.list.d/*.list >"$sources" 2>/dev/null ||
    { echo "clean_debian.sh: this machine's apt names no source of Debian 12" >&2; exit 1; }
fi
mmdebstrap --quiet --variant=apt --include=systemd bookworm "$1.part" "$sources" --format=tar
mv "$1.part" "$1"
