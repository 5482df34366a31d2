#!/usr/bin/env bash
# Makes a container image of the server and its client from Debian packages alone: the two programs, whole packages of
# what they link, no shell, no package manager; user 65532, one volume, a read-only root file system.
#   deploy/image.sh [--packages DIR] [--out FILE] [--try]
# --packages: those of deploy/package.sh (build/package), of this machine's architecture. --out: an archive for podman
# load or docker load (build/package/dhpmap-image.tar). --try starts it and asks: by podman, or where that cannot run,
# in a chroot with the same user and read-only root; it says which. Needs root, and buildah for more than a root file
# system.
set -euo pipefail
cd "$(dirname "$0")/.."
packages=build/package out=build/package/dhpmap-image.tar try=""
while [ $# -gt 0 ]; do
  case "$1" in
    --packages) packages=${2:?a folder}; shift ;;
    --out) out=${2:?a file}; shift ;;
    --try) try=1 ;;
    *) grep '^#   deploy/' "$0" >&2; exit 2 ;;
  esac
  shift
done
fail() { printf 'image.sh: %s\n' "$*" >&2; exit 1; }
[ "$(id -u)" = 0 ] || fail "needs root"
deploy/setup.sh --quiet --packaging
# shellcheck source=deploy/packaging/enter.sh
source deploy/packaging/enter.sh
readonly user=65532
# Who is well shows the certificate server.crt and takes health.key, a viewer's, both in /etc/dhpmap: docs/operate.md.
readonly health="/usr/bin/dhpmap --server localhost:50051 --ca /etc/dhpmap/server.crt \
  --token-file /etc/dhpmap/health.key whoami"
work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT
system=$work/system root=$work/root

# A whole system with the packages, to see what they need.
deploy/packaging/clean_debian.sh build/package/debian.tar
unpack build/package/debian.tar "$system"
mkdir "$system/try"
cp "$packages"/dhpmap-server_*.deb "$packages"/dhpmap_*.deb "$system/try" || fail "no packages in $packages"
inside "$system" sh -c 'apt-get update -qq && apt-get install -y -qq --no-install-recommends /try/*.deb' \
  >"$work/log" 2>&1 ||
  { tail -n 20 "$work/log" >&2; fail "the packages cannot be installed"; }

# owners: the packages whose libraries the programs load. Files of a package: without what nobody reads there.
owners() {
  # shellcheck disable=SC2016
  inside "$system" sh -c 'ldd /usr/bin/dhpmap-server /usr/bin/dhpmap | grep -oE "/[^ ]+" | sort -u |
    while read -r file; do dpkg -S "$file" 2>/dev/null || dpkg -S "/usr$file" 2>/dev/null || true; done' |
    sed -E 's/:.*//' | sort -u
}
files_of() {
  inside "$system" dpkg -L "$1" |
    grep -vE '^/usr/share/(man|locale|lintian|bug|bash-completion)|^/(etc/logrotate.d|lib/systemd)|/gconv/'
}
mkdir -p "$root"/{etc,proc,dev,tmp,var/lib/dhpmap,var/lib/dpkg/status.d,usr/lib,usr/lib64,usr/bin,usr/sbin}
for folder in lib lib64 bin sbin; do ln -s "usr/$folder" "$root/$folder"; done
for package in $(owners) dhpmap-server dhpmap; do
  files_of "$package" | while read -r file; do
    if [ -f "$system$file" ] || [ -L "$system$file" ]; then [ -d "$system$file" ] || echo "$file"; fi
  done | sed -E 's#^/(lib|lib64|bin|sbin)/#/usr/\1/#; s#^/##' | tar -C "$system" -T - -c | tar -x -C "$root"
  inside "$system" dpkg-query -s "$package" >"$root/var/lib/dpkg/status.d/$package"  # where scanners look for faults
done
printf 'dhpmap:x:%s:%s:DHP Map Server:/var/lib/dhpmap:/usr/sbin/nologin\n' $user $user >"$root/etc/passwd"
printf 'dhpmap:x:%s:\n' $user >"$root/etc/group"
printf '127.0.0.1 localhost\n::1 localhost\n' >"$root/etc/hosts"
printf 'hosts: files dns\n' >"$root/etc/nsswitch.conf"
cp "$system/usr/lib/os-release" "$root/etc/os-release"
ldconfig -r "$root"
chown -R $user:$user "$root/var/lib/dhpmap"
! find "$root/usr/bin/" "$root/usr/sbin/" -mindepth 1 ! -name 'dhpmap*' ! -name ldconfig | grep . ||
  fail "these have no place in it"
chroot "$root" /usr/bin/dhpmap-server --version >/dev/null || fail "it lacks a library"

oci() {
  local container
  container=$(buildah from scratch)
  buildah copy -q "$container" "$root" / >/dev/null
  buildah config --user $user:$user --workingdir /var/lib/dhpmap --volume /var/lib/dhpmap --port 50051 --port 8080 \
    --stop-signal SIGTERM --entrypoint '["/usr/bin/dhpmap-server"]' --cmd '--config /etc/dhpmap/dhpmap.yaml' \
    --healthcheck "CMD $health" \
    --healthcheck-interval 10s --healthcheck-timeout 5s --healthcheck-start-period 60s "$container"
  buildah commit -q --format docker --timestamp "$(git log -1 --format=%ct)" "$container" dhpmap-server >/dev/null
  rm -f "$out"
  buildah push -q dhpmap-server "docker-archive:$out:dhpmap-server:latest"
  buildah rm "$container" >/dev/null
  buildah rmi -f dhpmap-server >/dev/null
}
export STORAGE_DRIVER=vfs BUILDAH_ISOLATION=chroot
if command -v buildah >/dev/null && oci 2>"$work/log"; then
  packages=$(find "$root/var/lib/dpkg/status.d" -type f | wc -l)
  echo "image: $out; the root file system has $(du -sh "$root" | cut -f1), of $packages packages"
else
  tail -n 3 "$work/log" >&2
  out=${out%.tar}-root.tar
  tar --numeric-owner --sort=name -C "$root" -cf "$out" .
  echo "image: no archive, as buildah is not there or cannot run; its root file system is $out"
fi
[ -z "$try" ] || deploy/packaging/try_image.sh "$root" "$out" "$health"
