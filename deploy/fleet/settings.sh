# For sourcing by up.sh: writes the settings of every part. docs/fleet.md says why those of Patroni are as they are.
# shellcheck shell=bash disable=SC2154  # place.sh sets what is used here
new_secret() { od -An -N24 -tx1 /dev/urandom | tr -d ' \n'; }

write_secrets() {
  [ ! -f "$fleet/settings/pgpass" ] || return 0  # the database knows the old ones
  local user
  for user in postgres replicator rewinder dhpmap; do echo "*:*:*:$user:$(new_secret)"; done >"$fleet/settings/pgpass"
  new_secret >"$fleet/settings/fleet.key"
}
secret_of() { sed -n "s/^\*:\*:\*:$1://p" "$fleet/settings/pgpass"; }

write_patroni() {  # N
  cat >"$fleet/settings/pg$1.yml" <<END
scope: dhpmap
name: pg$1
restapi:
  listen: 127.0.0.1:$(patroni_port "$1")
  connect_address: 127.0.0.1:$(patroni_port "$1")
  authentication: {username: patroni, password: $(secret_of rewinder)}
etcd3: {hosts: "127.0.0.1:$(etcd_port)"}
bootstrap:
  dcs:
    ttl: 20
    loop_wait: 1
    retry_timeout: 3
    primary_start_timeout: 0
    synchronous_mode: true
    synchronous_mode_strict: true
    maximum_lag_on_failover: 1048576
    postgresql:
      use_pg_rewind: true
      use_slots: true
      parameters:
        wal_log_hints: "on"
        max_connections: 100
        wal_keep_size: 256MB
        max_wal_size: 1GB
        shared_buffers: 128MB
        wal_retrieve_retry_interval: 100ms
        tcp_keepalives_idle: 2
        tcp_keepalives_interval: 1
        tcp_keepalives_count: 3
        tcp_user_timeout: 5000
  initdb: [{encoding: UTF8}, {locale: C}, data-checksums]
postgresql:
  listen: 127.0.0.1:$(pg_port "$1")
  connect_address: 127.0.0.1:$(pg_port "$1")
  data_dir: $fleet/data/pg$1
  bin_dir: $(pg_bin)
  pgpass: $fleet/run/pg$1/pgpass
  pg_hba:
    - local all all scram-sha-256
    - host all all 127.0.0.1/32 scram-sha-256
    - host replication replicator 127.0.0.1/32 scram-sha-256
  authentication:
    superuser: {username: postgres, password: $(secret_of postgres)}
    replication: {username: replicator, password: $(secret_of replicator)}
    rewind: {username: rewinder, password: $(secret_of rewinder)}
  parameters: {unix_socket_directories: $fleet/run/pg$1}
END
}

database_url() {
  local hosts
  hosts="127.0.0.1:$(pg_port 1),127.0.0.1:$(pg_port 2),127.0.0.1:$(pg_port 3)"
  echo "postgresql://dhpmap@$hosts/maps?target_session_attrs=read-write"  # the password is in pgpass
}
# Frames wait for a new primary as long as store.max_behind_s: longer than it takes to find that a host is gone.
write_server() {  # N
  cat >"$fleet/settings/server$1.yaml" <<END
db: "$(database_url)"
grpc: {address: "127.0.0.1:$(grpc_port "$1")"}
http: {address: "127.0.0.1:$(http_port "$1")"}
store: {max_behind_s: 60}
END
  if knows_fleets; then
    echo "fleet:"
    echo "  address: \"127.0.0.1:$(grpc_port "$1")\""
    if fleet_keys | grep -x key_file >/dev/null; then echo "  key_file: $fleet/settings/fleet.key"; fi
  fi >>"$fleet/settings/server$1.yaml"
}
# What this server can be told of a fleet; nothing: it shares its database with no other.
fleet_keys() {
  "$bin/dhpmap-server" --print-config 2>/dev/null | sed -n '/^fleet:/,/^[^ ]/s/^  \([a-z_]*\):.*/\1/p'
}
knows_fleets() { fleet_keys | grep -x address >/dev/null; }

write_doors() {  # FIRST-PORT-FUNCTION
  for n in $(seq "$servers"); do echo "  server server$n 127.0.0.1:$("$1" "$n") check port $(http_port "$n")"; done
}
# gRPC goes through as bytes, a connection to one server: TLS, streams and their flow control stay the servers'.
write_proxy() {
  cat >"$fleet/settings/haproxy.cfg" <<END
global
  maxconn 2000
defaults
  timeout connect 1s
  timeout client 1h
  timeout server 1h
  balance leastconn
  option redispatch
  option httpchk GET /readyz
  default-server inter 500ms fall 2 rise 1 on-marked-down shutdown-sessions
listen grpc
  mode tcp
  bind 127.0.0.1:$(proxy_grpc_port)
$(write_doors grpc_port)
listen rest
  mode http
  bind 127.0.0.1:$(proxy_http_port)
$(write_doors http_port)
END
}
