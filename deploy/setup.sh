#!/usr/bin/env bash
# Installs what the build needs: Debian 12 packages, and the google/api protos, which Debian ships only inside a
# Go -dev package (unpacked here without its dependencies). Asks nothing, skips what is there, safe to run again.
#   deploy/setup.sh [--quiet] [--checks] [--browser] [--postgres] [--packaging] [--fleet]
# --checks adds what deploy/check.sh and the sanitizers need and a build does not: clang, its formatter, its tidy; systemd.
# --browser adds what tests of the viewer need: Chromium, its driver, and Selenium.
# --postgres adds a PostgreSQL server: tests of the store on it start their own, and skip without.
# --packaging adds what makes and tries Debian packages and images.
# --fleet adds what deploy/fleet runs: PostgreSQL under Patroni, etcd, and a proxy.
set -euo pipefail
cd "$(dirname "$0")/.."

packages=(
  g++ cmake ninja-build ccache pkg-config ca-certificates curl python3
  libgrpc++-dev libprotobuf-dev protobuf-compiler protobuf-compiler-grpc grpc-proto
  libsqlite3-dev libpq-dev libzstd-dev libjemalloc-dev zlib1g-dev libspng-dev libtiff-dev libturbojpeg0-dev
  libeigen3-dev libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libpcl-dev
  libspdlog-dev libssl-dev libyaml-cpp-dev libcli11-dev libboost-dev prometheus-cpp-dev nlohmann-json3-dev libnanoflann-dev
  libgtest-dev liboctomap-dev libompl-dev
  python3-grpcio python3-protobuf python3-numpy
  python3-pytest python3-hatchling python3-pip python3-venv mypy
  python3-seccomp  # for tests under the unit's filter
  python3-lz4 python3-zstandard python3-pil  # for packed recordings (dhpmap.mcap)
)
check_packages=(
  clang-14 clang-format-14 clang-tidy-14 libclang-rt-14-dev lld-14
  systemd  # for its judgement of the unit, and its activation of sockets
)
browser_packages=(chromium chromium-driver python3-selenium)
postgres_packages=(postgresql)
packaging_packages=(
  debhelper dh-python pybuild-plugin-pyproject python3-all help2man po-debconf lintian mmdebstrap iproute2 systemd prometheus
)
fleet_packages=(postgresql patroni etcd-server haproxy)
googleapis_package=golang-github-gogo-googleapis-dev  # the grpc-gateway one is older and has no google.rpc.ErrorInfo
googleapis_dir=build/googleapis

say() { [ "${quiet:-}" ] || printf '%s\n' "$*"; }
for argument in "$@"; do
  case "$argument" in
    --quiet) quiet=1 ;;
    --checks) packages+=("${check_packages[@]}") ;;
    --browser) packages+=("${browser_packages[@]}") ;;
    --postgres) packages+=("${postgres_packages[@]}") ;;
    --packaging) packages+=("${packaging_packages[@]}") ;;
    --fleet) packages+=("${fleet_packages[@]}") ;;
    *)
      echo "usage: deploy/setup.sh [--quiet] [--checks] [--browser] [--postgres] [--packaging] [--fleet]" >&2
      exit 2
      ;;
  esac
done

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo -n "$@"; fi
}
# Another apt may hold the lock, and a server of packages may be busy.
apt() {
  local n
  for n in 1 2 3 4; do
    as_root env DEBIAN_FRONTEND=noninteractive apt-get "$@" && return
    sleep $((15 * n))
  done
  return 1
}
has_googleapis() { grep -qs 'message ErrorInfo' "$googleapis_dir/google/rpc/error_details.proto"; }

mapfile -t missing < <(comm -23 <(printf '%s\n' "${packages[@]}" | sort -u) <(
  dpkg-query -W -f='${db:Status-Status} ${Package}\n' 2>/dev/null | sed -n 's/^installed //p' | sort))
if [ ${#missing[@]} -gt 0 ] || ! has_googleapis; then
  apt update -qq
fi
if [ ${#missing[@]} -gt 0 ]; then
  say "setup: installing ${missing[*]}"
  apt install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi

if ! has_googleapis; then
  say "setup: unpacking the google/api protos from $googleapis_package"
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  (cd "$work" && apt-get download -qq "$googleapis_package" >/dev/null)
  dpkg -x "$work"/*.deb "$work/root"
  protos=$(dirname "$(dirname "$(dirname "$(find "$work/root" -path '*google/api/annotations.proto' | head -n 1)")")")
  mkdir -p "$googleapis_dir"
  for proto in api/annotations api/http rpc/code rpc/error_details rpc/status; do
    install -D -m 644 "$protos/google/$proto.proto" "$googleapis_dir/google/$proto.proto"
  done
fi
say "setup: everything is there"
