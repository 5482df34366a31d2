#!/usr/bin/env bash
# Ends the fleet of up.sh in good order: servers, which store what is fused; the proxy; standbys, primary; etcd. Data
# and settings stay for the next up.sh.
#   deploy/fleet/down.sh [--dir DIR] [--delete]
# --delete: the folder goes, maps and all.
set -euo pipefail
# shellcheck source=deploy/fleet/place.sh
source "$(dirname "$0")/place.sh"
delete=""
while [ $# -gt 0 ]; do
  case "$1" in
    --dir) fleet=$(realpath -m "${2:?a folder}") && shift ;;
    --delete) delete=1 ;;
    *) usage ;;
  esac
  shift
done
read_place
part() { "$(dirname "$0")/part.sh" --dir "$fleet" "$@"; }

part stop timer
stopping=()
for n in $(seq "$servers"); do part stop "server$n" & stopping+=($!); done
for its in "${stopping[@]}"; do wait "$its"; done
part stop proxy
primary=""
for n in 1 2 3; do if is_primary $n; then primary=$n; fi; done
for n in 1 2 3; do [ "$n" = "$primary" ] || part stop pg$n; done
[ -z "$primary" ] || part stop "pg$primary"
part stop etcd
[ -z "$delete" ] || rm -rf --one-file-system "$fleet"
echo "down.sh: the fleet in $fleet has ended${delete:+, and is deleted}"
