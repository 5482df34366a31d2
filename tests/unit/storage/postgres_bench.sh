#!/usr/bin/env bash
# postgres_bench.sh BENCH [ROUNDS [MAPS]]: runs dhpmap_postgres_bench on a PostgreSQL of its own with fsync, first alone, then with
# two standbys of which one has to have each commit. All in a temporary folder beside the working directory, on Unix sockets.
set -euo pipefail
bench=$(realpath "$1") rounds=${2:-60} maps=${3:-0}
bin=$(ls -d /usr/lib/postgresql/*/bin | sort -V | tail -n 1)
place=$(mktemp -d "$PWD/postgres_bench.XXXXXX")
as=()
if [ "$(id -u)" = 0 ]; then
  chown postgres "$place"
  as=(setpriv --reuid=postgres --regid=postgres --clear-groups)
fi
run() { (cd "$place" && "${as[@]}" "$@" </dev/null); }
start() {  # NODE PORT
  run "$bin/pg_ctl" -D "$place/$1" -w -s -l "$place/$1.log" -o "-p $2 -k $place -c listen_addresses=" start
}
stop_all() {
  trap - EXIT INT TERM
  for node in s1 s2 primary; do
    [ ! -f "$place/$node/postmaster.pid" ] || run "$bin/pg_ctl" -D "$place/$node" -s -m immediate stop || true
  done
  rm -rf "$place"
}
trap stop_all EXIT
trap "exit 1" INT TERM

run "$bin/initdb" -D "$place/primary" -U postgres -A trust -E UTF8 --locale=C.UTF-8 >/dev/null
cat >>"$place/primary/postgresql.conf" <<CONF
shared_buffers = 256MB
max_wal_size = 4GB
max_connections = 60
CONF
start primary 5432
url="postgresql://postgres@/postgres?host=$place&port=5432"
files=$(mktemp -d "$PWD/postgres_bench.XXXXXX")
echo "== alone"
"$bench" "$url" "$files" "$rounds" "$maps"
for node in s1 s2; do
  run "$bin/pg_basebackup" -h "$place" -p 5432 -U postgres -D "$place/$node" -R -c fast
  echo "primary_conninfo = 'host=$place port=5432 user=postgres application_name=$node'" >>"$place/$node/postgresql.auto.conf"
done
start s1 5433
start s2 5434
run "$bin/psql" -h "$place" -U postgres -q -c "ALTER SYSTEM SET synchronous_standby_names = 'ANY 1 (s1, s2)'" -c "SELECT pg_reload_conf()" >/dev/null
until [ "$(run "$bin/psql" -h "$place" -U postgres -Atc "SELECT count(*) FROM pg_stat_replication WHERE sync_state = 'quorum'")" = 2 ]; do sleep 0.2; done
echo "== one of two standbys has each commit"
"$bench" "$url" "$files" "$rounds"
rm -rf "$files"
