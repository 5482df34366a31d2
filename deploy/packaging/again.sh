#!/usr/bin/env bash
# deploy/packaging/again.sh FROM VERSION TO: the packages of a folder once more, under another version.
set -euo pipefail
from=$1 version=$2 to=$3
mkdir -p "$to"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for package in "$from"/*.deb; do
  dpkg-deb -R "$package" "$work/package"
  sed -i "s/^Version: .*/Version: $version/" "$work/package/DEBIAN/control"
  dpkg-deb -Zgzip -z1 --root-owner-group -b "$work/package" "$to" >/dev/null
  rm -r "$work/package"
done
