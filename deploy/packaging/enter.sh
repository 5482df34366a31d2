# For sourcing: commands in a system that is a folder, with processes of their own.
# inside ROOT COMMAND...: with this machine's network. alone ROOT COMMAND...: with no network but a loopback of its own.
# shellcheck shell=bash disable=SC2016  # $0 and $@ are those of the inner shell
readonly enter='mount -t proc proc "$0/proc" && exec chroot "$0" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root \
  LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"'
inside() { unshare --pid --mount --fork --kill-child sh -c "$enter" "$@"; }
alone() { unshare --net --pid --mount --fork --kill-child sh -c "ip link set lo up && $enter" "$@"; }

# unpack TAR ROOT: a system in which packages start no services and find the network.
unpack() {
  mkdir -p "$2"
  tar -xpf "$1" -C "$2"
  printf '#!/bin/sh\nexit 101\n' >"$2/usr/sbin/policy-rc.d"
  chmod 755 "$2/usr/sbin/policy-rc.d"
  cp -L /etc/resolv.conf "$2/etc/resolv.conf" 2>/dev/null || true
}
