#!/usr/bin/env bash
# A fleet on this machine, for trying it: PostgreSQL with two standbys under Patroni and etcd, servers on it, and a proxy
# that leads to any of them which lives. It listens on loopback alone; all it keeps is in one folder.
#   deploy/fleet/up.sh [--dir DIR] [--port PORT] [--servers N] [--bin DIR] [--minutes N]
# --dir: /var/tmp/dhpmap-fleet; one that was ended is started again, with its maps. --port: the first of 52 (5700).
# --servers: 2, or 1 where dhpmap-server knows no fleets. --bin: where dhpmap-server is (build/release/bin, else
# /usr/bin). --minutes: it ends by itself; else by deploy/fleet/down.sh. As root it runs as user dhpmap-fleet, who is
# made. Needs what deploy/setup.sh --fleet installs.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=deploy/fleet/place.sh
source "$here/place.sh"
# shellcheck source=deploy/fleet/settings.sh
source "$here/settings.sh"
minutes=""
while [ $# -gt 0 ]; do
  case "$1" in
    --dir) fleet=$(realpath -m "${2:?a folder}") ;;
    --port) port=${2:?a port} ;;
    --servers) servers=${2:?how many} ;;
    --bin) bin=$(realpath "${2:?a folder}") ;;
    --minutes) minutes=${2:?how many} ;;
    *) usage ;;
  esac
  shift 2
done
[ -n "$bin" ] || bin=$here/../../build/release/bin
[ -x "$bin/dhpmap-server" ] || bin=/usr/bin
bin=$(realpath "$bin")
say() { printf '%4d s  %s\n' "$SECONDS" "$*"; }

look() {
  local program
  for program in etcd patroni haproxy setpriv curl psql; do
    command -v $program >/dev/null || fail "there is no $program: deploy/setup.sh --fleet"
  done
  [ -n "$(pg_bin)" ] || fail "there is no PostgreSQL server: deploy/setup.sh --fleet"
  [ -x "$bin/dhpmap-server" ] || fail "there is no dhpmap-server: build it, or say --bin"
  if [ -z "$servers" ]; then if knows_fleets; then servers=2; else servers=1; fi; fi
  [[ $servers =~ ^[1-9]$ ]] || fail "one to nine servers"
  for its in $(all_ports); do ! is_open "$its" || fail "port $its is taken: down.sh, or another --port"; done
}
make_folders() {
  local part
  if [ "$(id -u)" = 0 ] && ! id $fleet_user >/dev/null 2>&1; then
    useradd --system --user-group --no-create-home --home-dir /nonexistent --shell /usr/sbin/nologin $fleet_user
  fi
  [ ! -e "$fleet" ] || [ -d "$fleet/settings" ] || [ -z "$(ls -A "$fleet")" ] || fail "$fleet holds something else"
  umask 077
  mkdir -p "$fleet"/{settings,log,data,run/timer}
  for part in $(parts); do mkdir -p "$fleet/run/$part"; done
  mkdir -p "$fleet/data/etcd"
}
write_settings() {
  write_secrets
  for n in 1 2 3; do write_patroni $n; done
  for n in $(seq "$servers"); do write_server "$n"; done
  write_proxy
  keep_place
  if [ "$(id -u)" = 0 ]; then chown -R $fleet_user:$fleet_user "$fleet"; fi
  as_user test -x "$bin/dhpmap-server" || fail "user $fleet_user cannot reach $bin"
}
part() { "$here/part.sh" --dir "$fleet" "$@"; }
# until_true SECONDS WHAT COMMAND...
until_true() {
  local seconds=$1 what=$2
  shift 2
  for _ in $(seq $((seconds * 5))); do
    if "$@" >/dev/null 2>&1; then return; fi
    sleep 0.2
  done
  fail "no $what after $seconds s: see $fleet/log"
}
# Three nodes, one of them primary, one a synchronous standby: else no commit ends.
database_is_whole() {
  local cluster
  cluster=$(curl -sf -m 2 "http://127.0.0.1:$(patroni_port 1)/cluster") &&
    [ "$(grep -oE '"state": "(running|streaming)"' <<<"$cluster" | wc -l)" = 3 ] && grep -q sync_standby <<<"$cluster"
}
# A standby that lags refuses who looks for the primary with "no such database", and libpq stops there.
node_has_database() { [ "$(node_sql "$1" "SELECT 1 FROM pg_database WHERE datname = 'maps'")" = 1 ]; }
make_database() {
  [ "$(primary_sql "SELECT 1 FROM pg_roles WHERE rolname = 'dhpmap'")" = 1 ] ||
    primary_sql "CREATE ROLE dhpmap LOGIN PASSWORD '$(secret_of dhpmap)'"
  [ "$(primary_sql "SELECT 1 FROM pg_database WHERE datname = 'maps'")" = 1 ] ||
    primary_sql "CREATE DATABASE maps OWNER dhpmap"
  for n in 1 2 3; do until_true 30 "database on pg$n" node_has_database $n; done
}

look
make_folders
write_settings
part start etcd
until_true 30 etcd is_open "$(etcd_port)"
for n in 1 2 3; do part start pg$n; done
until_true 180 "primary with two standbys" database_is_whole
say "PostgreSQL: ports $(pg_port 1) to $(pg_port 3), under Patroni"
make_database
for n in $(seq "$servers"); do
  part start "server$n"
  until_true 60 "server$n" curl -sf -m 2 "http://127.0.0.1:$(http_port "$n")/readyz"
  say "server$n: gRPC $(grpc_port "$n"), REST $(http_port "$n")"
done
part start proxy
until_true 30 proxy curl -sf -m 2 "http://127.0.0.1:$(proxy_http_port)/readyz"
say "proxy: gRPC 127.0.0.1:$(proxy_grpc_port), REST 127.0.0.1:$(proxy_http_port)"
if [ -n "$minutes" ]; then
  cd "$fleet/run/timer"
  setsid sh -c "sleep $((minutes * 60)) && exec '$here/down.sh' --dir '$fleet'" >>"$fleet/log/timer.log" 2>&1 </dev/null &
  disown
  say "it ends by itself in $minutes min"
fi
