#!/usr/bin/env bash
# Starts and ends one part of the fleet that up.sh has made: etcd, pg1, pg2, pg3 (Patroni with its PostgreSQL), server1,
# ..., proxy.
#   deploy/fleet/part.sh [--dir DIR] list|primary
#   deploy/fleet/part.sh [--dir DIR] start|stop|kill PART
#   deploy/fleet/part.sh [--dir DIR] kill-postgres pgN
# stop asks, and waits half a minute; kill is kill -9, of Patroni with PostgreSQL, or of PostgreSQL alone. A part that
# runs is not started again. primary: which of pg1 to pg3 that is.
set -euo pipefail
# shellcheck source=deploy/fleet/place.sh
source "$(dirname "$0")/place.sh"
if [ "${1:-}" = --dir ]; then fleet=$(realpath -m "${2:?a folder}") && shift 2; fi
[ $# -ge 1 ] || usage
what=$1 part=${2:-}
read_place

command_of() {
  case "$1" in
    etcd)
      local client peer
      client="http://127.0.0.1:$(etcd_port)" peer="http://127.0.0.1:$(etcd_peer_port)"
      echo "/usr/bin/etcd --name etcd --data-dir $fleet/data/etcd --logger zap --log-level warn
        --listen-client-urls $client --advertise-client-urls $client --listen-peer-urls $peer
        --initial-advertise-peer-urls $peer --initial-cluster etcd=$peer"
      ;;
    pg?) echo "/usr/bin/patroni $fleet/settings/$1.yml" ;;
    server?) echo "$bin/dhpmap-server --config $fleet/settings/$1.yaml" ;;
    proxy) echo "/usr/sbin/haproxy -db -f $fleet/settings/haproxy.cfg" ;;
  esac
}
start() {
  [ -z "$(pids "run/$1" "data/$1")" ] || fail "$1 runs already"
  rm -f "$fleet/data/$1/postmaster.pid"  # of one that was killed: pg_rewind stops at it
  cd "$fleet/run/$1"
  # shellcheck disable=SC2046  # words of a command
  as_user setsid env -i PATH="$(pg_bin):/usr/sbin:/usr/bin:/sbin:/bin" HOME="$fleet" LC_ALL=C.UTF-8 \
    PGPASSFILE="$fleet/settings/pgpass" $(command_of "$1") >>"$fleet/log/$1.log" 2>&1 </dev/null &
  disown
}
end_with() {  # SIGNAL FOLDER...
  local signal=$1 its
  shift
  its=$(pids "$@")
  # shellcheck disable=SC2086  # numbers
  [ -z "$its" ] || kill -s "$signal" $its 2>/dev/null || true
}
# Whether one of these processes is still there. A dead one whose threads go on ending still holds its ports.
are_there() {
  local pid
  for pid in "$@"; do
    ! grep -qs '^State:[[:space:]]*[^ZX]' "/proc/$pid"/task/*/status || return 0
  done
  return 1
}
# A process that is being killed may have begun another.
kill_all() {
  local all="" its
  for _ in $(seq 200); do
    its=$(pids "$@")
    all+=" $its"
    # shellcheck disable=SC2086  # numbers
    if [ -z "$its" ] && ! are_there $all; then return; fi
    end_with KILL "$@"
    sleep 0.05
  done
  fail "$* cannot be killed"
}
stop() {
  end_with TERM "run/$1"
  for _ in $(seq 300); do
    [ -n "$(pids "run/$1" "data/$1")" ] || return 0
    sleep 0.1
  done
  echo "part.sh: $1 does not end by itself: killed" >&2
  kill_all "run/$1" "data/$1"
}

if [ "$what" = list ]; then
  for part in $(parts); do
    its=$(pids "run/$part" "data/$part" | sort -n | head -n 1)
    printf '%-8s %s\n' "$part" "${its:+runs, process $its}"
  done
  exit
fi
if [ "$what" = primary ]; then
  for n in 1 2 3; do if is_primary $n; then echo pg$n && exit; fi; done
  fail "there is no primary"
fi
parts | grep -x "$part" >/dev/null || [ "$what $part" = "stop timer" ] || usage
case "$what" in
  start) start "$part" ;;
  stop) stop "$part" ;;
  kill) kill_all "run/$part" "data/$part" ;;
  kill-postgres) kill_all "data/$part" ;;
  *) usage ;;
esac
