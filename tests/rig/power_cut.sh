#!/usr/bin/env bash
# Rehearses power cuts: a server maps and edits on an ext4 that lies, by direct I/O, in a file on an XFS. A reflink copy
# of that file, taken at any moment, is what a disk without a write cache has when the power goes. Each copy is mounted,
# served and held against what clients were told before it was taken:
#   1. every edit that was answered by then is there, and at most what had been asked for is;
#   2. VerifyMap finds all maps whole.
#   tests/rig/power_cut.sh [--cuts N] [--seed N] [--build DIR] [--directory DIR]
# Needs root, loop devices, xfsprogs and e2fsprogs; where it cannot run it says why and ends with 77.
set -euo pipefail

cuts=20
seed=1
build=$(cd "$(dirname "$0")/../.." && pwd)/build/release
parent=${TMPDIR:-/tmp}
while [ $# -gt 0 ]; do
  case "$1 ${2:+value}" in
    '--cuts value') cuts=$2 ;;
    '--seed value') seed=$2 ;;
    '--build value') build=$2 ;;
    '--directory value') parent=$2 ;;
    *)
      sed -nE '2,/^set /s/^# ?//p' "$0" >&2
      exit 2
      ;;
  esac
  shift 2
done
RANDOM=$seed

skip() {
  echo "SKIPPED: $1"
  exit 77
}

[ "$(id -u)" = 0 ] || skip "only root may mount"
for tool in losetup mkfs.xfs mkfs.ext4 mount umount mountpoint python3; do
  command -v "$tool" >/dev/null || skip "there is no $tool (packages mount, xfsprogs, e2fsprogs, python3)"
done
for program in dhpmap-server dhpmap dhpmap-simulate; do
  [ -x "$build/bin/$program" ] || { echo "no $build/bin/$program: build it first" >&2; exit 1; }
done

work=$(mktemp -d "$parent/power-cut.XXXXXX")
xfs_loop='' disk_loop='' cut_loop=''
pids=()
# let_go PLACE LOOP: unmounts the one and detaches the other, as far as they are there.
let_go() {
  for _ in 1 2 3 4 5 6 7 8 9 10; do
    mountpoint -q "$work/$1" || break
    umount "$work/$1" 2>/dev/null && break
    sleep 0.2  # what lies in it is still being detached
  done
  if [ -n "$2" ]; then losetup -d "$2" 2>/dev/null || true; fi
}
clean_up() {
  local pid
  touch "$work/stop"
  for pid in "${pids[@]}"; do kill -9 "$pid" 2>/dev/null || true; done
  wait 2>/dev/null || true
  let_go cut "$cut_loop"
  let_go disk "$disk_loop"
  let_go xfs "$xfs_loop"
  rm -rf "$work" || true
}
trap clean_up EXIT
mkdir "$work/xfs" "$work/disk" "$work/cut" "$work/data"

truncate -s 4G "$work/xfs.img"
xfs_loop=$(losetup --find --show "$work/xfs.img" 2>/dev/null) || skip "there is no loop device to be had"
mkfs.xfs -q -m reflink=1 "$xfs_loop" >/dev/null 2>&1 || skip "mkfs.xfs makes no file system with reflinks"
mount -t xfs "$xfs_loop" "$work/xfs" 2>/dev/null || skip "the kernel mounts no XFS here"
truncate -s 1G "$work/xfs/disk.img"
cp --reflink=always "$work/xfs/disk.img" "$work/xfs/probe.img" 2>/dev/null || skip "the file system copies no reflinks"
rm "$work/xfs/probe.img"
disk_loop=$(losetup --find --show --direct-io=on "$work/xfs/disk.img" 2>/dev/null) || skip "no loop device does direct I/O"
mkfs.ext4 -q "$disk_loop"
mount -t ext4 "$disk_loop" "$work/disk" 2>/dev/null || skip "the kernel mounts no ext4 here"

# serve DATABASE LOG: starts a server; sets server (its process) and DHPMAP_SERVER.
serve() {
  "$build/bin/dhpmap-server" --db "$1" --grpc 127.0.0.1:0 --http 127.0.0.1:0 --set store.commit_s=0.5 >"$2" 2>&1 &
  server=$!
  pids+=("$server")
  for _ in $(seq 300); do
    DHPMAP_SERVER=$(sed -nE 's/.*gRPC on ([0-9.:]+), REST on.*/\1/p' "$2")
    if [ -n "$DHPMAP_SERVER" ]; then
      export DHPMAP_SERVER
      return 0
    fi
    kill -0 "$server" 2>/dev/null || break
    sleep 0.1
  done
  echo "FAILED: the server does not start on $1:" >&2
  cat "$2" >&2
  return 1
}
dhpmap() { "$build/bin/dhpmap" "$@"; }
# The name of the object that is renamed again and again.
name_of_object() {
  dhpmap --json submaps office 1 | python3 -c 'import json, sys
answer = json.load(sys.stdin)
print(answer.get("submap", answer)["display_name"])'
}
# number FILE: what is in it.
number() { cat "$work/$1" 2>/dev/null || echo 0; }
# note FILE NUMBER: at once or not at all.
note() {
  echo "$2" >"$work/$1.new"
  mv "$work/$1.new" "$work/$1"
}

# Renames an object to 1, 2, 3 and so on: what is answered is durable.
edit_on() {
  local n=0
  while [ ! -e "$work/stop" ]; do
    n=$((n + 1))
    note asked "$n"
    dhpmap edit rename office 1 "$n" >/dev/null 2>>"$work/editor.log" || break
    note answered "$n"
  done
  [ -e "$work/stop" ] || touch "$work/failed"
}
# Maps, refines and deletes another map again and again: large commits, and blobs to collect.
map_on() {
  while [ ! -e "$work/stop" ]; do
    dhpmap map "$work/data" --map load --frames 12 >/dev/null 2>>"$work/mapper.log" || break
    dhpmap maps delete load --yes >/dev/null 2>>"$work/mapper.log" || break
  done
  [ -e "$work/stop" ] || touch "$work/failed"
}

# look_into NUMBER ANSWERED ASKED: what a cut holds. Says what is wrong.
look_into() {
  local found map status=0 before=$DHPMAP_SERVER
  cut_loop=$(losetup --find --show "$work/xfs/cut.img")
  mount -t ext4 "$cut_loop" "$work/cut" || { echo "FAILED: cut $1 cannot be mounted"; return 1; }
  if serve "$work/cut/maps.db" "$work/cut.log"; then
    found=$(name_of_object) || found=none
    if ! [[ $found =~ ^[0-9]+$ ]] || [ "$found" -lt "$2" ] || [ "$found" -gt "$3" ]; then
      echo "FAILED: cut $1 has edit $found; $2 was answered before it, $3 asked for"
      status=1
    fi
    for map in $(dhpmap --json maps list | python3 -c 'import json, sys
print(*(m["name"].split("/")[1] for m in json.load(sys.stdin)["maps"]))'); do
      dhpmap verify "$map" >"$work/verify.log" 2>&1 || { echo "FAILED: cut $1, map $map:"; cat "$work/verify.log"; status=1; }
    done
    kill "$server"
    wait "$server" || { echo "FAILED: the server of cut $1 does not end well"; status=1; }
  else
    status=1
  fi
  DHPMAP_SERVER=$before
  let_go cut "$cut_loop"
  cut_loop=''
  rm "$work/xfs/cut.img"
  return "$status"
}

"$build/bin/dhpmap-simulate" "$work/data" --frames 12 --width 160 --height 120 --quiet >/dev/null
serve "$work/disk/maps.db" "$work/server.log"
dhpmap map "$work/data" --map office --frames 6 >/dev/null 2>&1
dhpmap edit rename office 1 0 >/dev/null
edit_on &
pids+=($!)
map_on &
pids+=($!)

lost=0
for cut in $(seq "$cuts"); do
  sleep "$((RANDOM % 2)).$((RANDOM % 10))$((RANDOM % 10))"
  answered=$(number answered)
  cp --reflink=always "$work/xfs/disk.img" "$work/xfs/cut.img"
  asked=$(number asked)
  look_into "$cut" "$answered" "$asked" || lost=$((lost + 1))
  if [ -e "$work/failed" ]; then
    echo "FAILED: a client of the server that goes on was refused:"
    tail -n 5 "$work/editor.log" "$work/mapper.log"
    exit 1
  fi
done
touch "$work/stop"
echo "$cuts cuts, $(number answered) edits answered meanwhile, $lost cuts with a fault"
[ "$lost" = 0 ]
