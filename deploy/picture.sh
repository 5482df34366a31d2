#!/usr/bin/env bash
# Makes README's picture anew: the sample apartment from above with the robot's walk, and beside it the map that the
# server makes of this walk, each object in a colour of its own, seen by the same camera.
#   deploy/picture.sh [FILE]    PNG or JPEG; default: deploy/apartment.jpg
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-deploy/apartment.jpg}
fail() { printf 'picture.sh: %s\n' "$*" >&2; exit 1; }

deploy/setup.sh --quiet
mkdir -p build
{ cmake --preset release -DDHPMAP_BUILD_TESTS=ON &&
  cmake --build --preset release --target dhpmap-server dhpmap dhpmap-simulate dhpmap-render-ply; } \
  >build/picture-build.log 2>&1 || { tail -n 60 build/picture-build.log; exit 1; }
bin=build/release/bin
work=build/picture
rm -rf "$work"
mkdir -p "$work"
"$bin/dhpmap-simulate" "$work/apartment" --frames 120 --plan "$work/plan.png"

"$bin/dhpmap-server" --db "$work/maps.db" --grpc 127.0.0.1:0 --http 127.0.0.1:0 >"$work/server.log" 2>&1 &
server=$!
trap 'kill -TERM "$server" 2>/dev/null; wait "$server" 2>/dev/null || true' EXIT
for _ in $(seq 100); do
  grep -q 'gRPC on' "$work/server.log" && break
  kill -0 "$server" 2>/dev/null || { cat "$work/server.log"; fail "the server did not start"; }
  sleep 0.1
done
DHPMAP_SERVER=$(sed -nE 's/.*gRPC on ([^ ,]+),.*/\1/p' "$work/server.log" | head -n 1)
export DHPMAP_SERVER
"$bin/dhpmap" map "$work/apartment" --map apartment
"$bin/dhpmap" export ply apartment --color instance --output "$work/apartment.ply"

# The camera of clients/simulator/plan_view.cc: 13.4 m of the floor fill the width of the picture.
"$bin/dhpmap-render-ply" "$work/apartment.ply" "$out" --beside "$work/plan.png" \
  --eye 5.5 0.6 26 --target 5.5 4.2 0 --width 800 --height 600 --focal 1567.05
echo "picture.sh: wrote $out"
