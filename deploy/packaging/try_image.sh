#!/usr/bin/env bash
# deploy/packaging/try_image.sh ROOT ARCHIVE HEALTHCHECK: does the image of deploy/image.sh, set up as docs/operate.md
# says, with keys and TLS, start, call itself well, answer, and write nowhere but into its volume?
set -euo pipefail
root=$1 archive=$2 healthcheck=$3 user=65532
work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT
fail() { printf 'image: %s\n' "$*" >&2; tail -n 20 "$work/log" >&2; exit 1; }
as_user() { chroot --userspec=$user:$user "$root" "$@"; }

mkdir "$work/volume" "$work/etc"
openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -noenc -days 2 -subj /CN=maps \
  -addext subjectAltName=DNS:localhost -keyout "$work/etc/server.key" -out "$work/etc/server.crt" 2>/dev/null
new_key() { "$root/usr/bin/dhpmap" keys create "$@" --keys "$work/volume/maps.db.keys" 2>"$work/log"; }
new_key health --role viewer >"$work/etc/health.key"
new_key anna --role admin >"$work/etc/anna.key"
cat >"$work/etc/dhpmap.yaml" <<'END'
db: /var/lib/dhpmap/maps.db
grpc: {address: "0.0.0.0:50051"}
http: {address: "0.0.0.0:8080"}
tls: {cert: /etc/dhpmap/server.crt, key: /etc/dhpmap/server.key}
END
chmod 600 "$work/etc"/*.key
chown -R $user:$user "$work/volume" "$work/etc"
call="/usr/bin/dhpmap --server localhost:50051 --ca /etc/dhpmap/server.crt --token-file /etc/dhpmap/anna.key"

by_podman() {
  podman load -q -i "$archive" && podman run -d --name dhpmap-try --read-only --network none \
    -v "$work/volume:/var/lib/dhpmap" -v "$work/etc:/etc/dhpmap:ro" dhpmap-server
}
in_chroot() {
  ip link set lo up
  mount --bind "$root" "$root"
  mount -o remount,bind,ro "$root"
  mount --bind "$work/volume" "$root/var/lib/dhpmap"
  mount --bind "$work/etc" "$root/etc/dhpmap"
  mount -t proc proc "$root/proc"
  setpriv --no-new-privs chroot --userspec=$user:$user "$root" /usr/bin/dhpmap-server --config /etc/dhpmap/dhpmap.yaml \
    >"$work/log" 2>&1 &
  server=$!
  for _ in $(seq 300); do ! grep -q 'REST on' "$work/log" || break; sleep 0.1; done
  as_user $healthcheck
  as_user $call maps create room
  ! as_user $call completion bash 2>/dev/null >"$root/etc/written" || return 1
  kill $server
  wait $server
}

export STORAGE_DRIVER=vfs
if command -v podman >/dev/null && by_podman >/dev/null 2>"$work/log"; then
  trap 'podman rm -f dhpmap-try >/dev/null 2>&1; podman rmi -f dhpmap-server >/dev/null 2>&1; rm -rf --one-file-system "$work"' EXIT
  for _ in $(seq 300); do ! podman logs dhpmap-try 2>&1 | grep -q 'REST on' || break; sleep 0.1; done
  podman healthcheck run dhpmap-try || fail "it is not well"
  podman exec dhpmap-try $call maps create room || fail "it does not answer"
  podman stop dhpmap-try >/dev/null
  how=podman
else
  echo "image: podman cannot run here: $(tail -n 1 "$work/log" | cut -c 1-200)"
  podman rm -f dhpmap-try >/dev/null 2>&1 || true
  podman rmi -f dhpmap-server >/dev/null 2>&1 || true
  export -f in_chroot as_user
  export root work user healthcheck call
  unshare --net --pid --mount --fork --kill-child bash -euo pipefail -c in_chroot || fail "it does not start or answer"
  how="a chroot with user $user and a read-only root"
fi
[ "$(stat -c '%u %a' "$work/volume/maps.db")" = "$user 600" ] ||
  fail "the maps are not in the volume, or others can read them"
echo "image: started by $how, with keys and TLS; was well, made a map in its volume, stopped"
