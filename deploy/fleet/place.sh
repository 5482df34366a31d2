# For sourcing by the scripts of this folder: where a fleet is, its ports and user, and its processes by their parts.
# A part's processes are those that work in its folders, run/PART and data/PART: nothing else is ever ended.
# shellcheck shell=bash
readonly fleet_user=dhpmap-fleet
fleet=/var/tmp/dhpmap-fleet
port=5700 servers="" bin=""
fail() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; exit 1; }
usage() { grep '^#   deploy/fleet' "$0" >&2; exit 2; }

# The settings that up.sh was given, for the other scripts.
read_place() {
  [ -f "$fleet/settings/place" ] || fail "there is no fleet in $fleet: deploy/fleet/up.sh makes one"
  # shellcheck disable=SC1091
  source "$fleet/settings/place"
}
keep_place() { printf 'port=%q servers=%q bin=%q\n' "$port" "$servers" "$bin" >"$fleet/settings/place"; }

# Ports, from the first one of fifty-two.
etcd_port() { echo "$port"; }
etcd_peer_port() { echo $((port + 1)); }
pg_port() { echo $((port + 10 + $1)); }
patroni_port() { echo $((port + 20 + $1)); }
grpc_port() { echo $((port + 30 + $1)); }
http_port() { echo $((port + 40 + $1)); }
proxy_grpc_port() { echo $((port + 50)); }
proxy_http_port() { echo $((port + 51)); }
all_ports() {
  etcd_port && etcd_peer_port && proxy_grpc_port && proxy_http_port
  for n in 1 2 3; do pg_port $n && patroni_port $n; done
  for n in $(seq "$servers"); do grpc_port "$n" && http_port "$n"; done
}
is_primary() { curl -sf -m 2 -o /dev/null "http://127.0.0.1:$(patroni_port "$1")/primary"; }
is_open() { (: </dev/tcp/127.0.0.1/"$1") 2>/dev/null; }

parts() {
  printf 'etcd\npg1\npg2\npg3\n'
  for n in $(seq "$servers"); do echo "server$n"; done
  echo proxy
}
# The newest PostgreSQL's programs, which Debian leaves out of PATH.
pg_bin() { find /usr/lib/postgresql/*/bin -maxdepth 0 2>/dev/null | sort -V | tail -n 1; }
# As root: as a user of the fleet's own.
as_user() {
  if [ "$(id -u)" = 0 ]; then setpriv --reuid $fleet_user --regid $fleet_user --init-groups "$@"; else "$@"; fi
}
# pids FOLDER...: of the fleet's programs that work in these folders of it. A shell that is there is nobody's business.
pids() {
  local folder pid
  for folder in "$@"; do
    find /proc -maxdepth 2 -path '/proc/[0-9]*/cwd' -lname "$fleet/$folder" -printf '%h\n' 2>/dev/null || true
  done | while read -r pid; do
    case "$(readlink "$pid/exe" 2>/dev/null)" in
      */etcd | */python3* | */postgres | */haproxy | */dhpmap-server | */sleep) echo "${pid#/proc/}" ;;
    esac
  done
}
# sql TARGET SQL: as the database's superuser.
sql() {
  as_user env -i HOME="$fleet" PGPASSFILE="$fleet/settings/pgpass" PATH="$PATH" \
    psql -qXAt -v ON_ERROR_STOP=1 "user=postgres dbname=postgres connect_timeout=2 $1" -c "$2"
}
primary_sql() {  # on whichever node is the primary
  sql "host=127.0.0.1,127.0.0.1,127.0.0.1 port=$(pg_port 1),$(pg_port 2),$(pg_port 3)
       target_session_attrs=read-write" "$1"
}
node_sql() { sql "host=127.0.0.1 port=$(pg_port "$1")" "$2"; }  # N SQL
