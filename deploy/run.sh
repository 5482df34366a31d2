#!/usr/bin/env bash
# The main job: renders a sample apartment, maps it, serves the map and prints queries to try. Ctrl-C ends it.
#   deploy/run.sh            serves on 127.0.0.1:50051 (gRPC) and 127.0.0.1:8080 (REST) until it is stopped
#   deploy/run.sh --check    the same on free ports; runs the queries, verifies the answers, stops, exits 0
set -euo pipefail
cd "$(dirname "$0")/.."

check=
grpc=127.0.0.1:50051
http=127.0.0.1:8080
case "${1:-}" in
  "") ;;
  --check) check=1 grpc=127.0.0.1:0 http=127.0.0.1:0 ;;
  *) sed -n '2,4p' "$0" >&2; exit 2 ;;
esac
say() { printf '\n\033[1m%s\033[0m\n' "$*"; }
fail() { printf 'run.sh: %s\n' "$*" >&2; exit 1; }

say "1/4 Installing and building"
deploy/setup.sh
deploy/ci/build.sh release dhpmap-server dhpmap dhpmap-simulate python_client
bin=build/release/bin

demo=build/demo
say "2/4 Rendering a furnished apartment into $demo/apartment"
frames=120
rm -rf "$demo"
mkdir -p "$demo"
"$bin/dhpmap-simulate" "$demo/apartment" --frames "$frames"

say "3/4 Starting the server and mapping $frames frames, with predicted labels"
"$bin/dhpmap-server" --db "$demo/maps.db" --grpc "$grpc" --http "$http" >"$demo/server.log" 2>&1 &
server=$!
trap 'kill -TERM "$server" 2>/dev/null; wait "$server" 2>/dev/null || true' EXIT
for _ in $(seq 100); do
  grep -q 'REST on' "$demo/server.log" && break
  kill -0 "$server" 2>/dev/null || { cat "$demo/server.log"; fail "the server did not start"; }
  sleep 0.1
done
grpc=$(sed -nE 's/.*gRPC on ([^ ,]+), REST on .*/\1/p' "$demo/server.log" | head -n 1)
url=$(sed -nE 's/.*REST on ([^ ]+).*/\1/p' "$demo/server.log" | head -n 1)
export DHPMAP_SERVER=$grpc
"$bin/dhpmap" map "$demo/apartment" --map apartment

say "4/4 The map is served: gRPC on $grpc, REST on $url. Try:"
# The queries of README.md, at this server's address.
mapfile -t queries < <(sed -nE "s#^\\\$ (curl .*)#\1#p" README.md | sed "s|127.0.0.1:8080|${url#http://}|")
printf '  %s\n' "${queries[@]}" "$bin/dhpmap submaps apartment"

if [ -z "$check" ]; then
  echo
  echo "See it, and touch it, in a browser: $url/ui/"
  echo "Ctrl-C stops the server; the map stays in $demo/maps.db"
  trap 'kill -TERM "$server" 2>/dev/null; wait "$server" 2>/dev/null || true; exit 0' INT TERM
  wait "$server"
  exit
fi

say "Checking"
# What README.md shows of each answer, up to its dots; an empty line where it shows none.
mapfile -t shown < <(awk '/^[$] curl /{ if (n++) print answer; answer = ""; after = 1; next }
                          { if (after && /^{/) answer = $0; after = 0 } END { print answer }' README.md)
but_for_numbers() { sed -E 's/-?[0-9]+(\.[0-9]+)?([eE][-+]?[0-9]+)?/#/g' <<<"$1"; }
for i in "${!queries[@]}"; do
  # 28: its --max-time is over, as that of a stream that goes on.
  answer=$(cd "$demo" && eval "${queries[i]/curl /curl --fail-with-body }") || [ $? = 28 ] || fail "'${queries[i]}' failed: $answer"
  [[ $(but_for_numbers "$answer") == "$(but_for_numbers "${shown[i]%...}")"* ]] ||
    fail "'${queries[i]}' is not answered as README.md shows, but with: $answer"
  echo "ok: ${queries[i]}"
done
grep -q '^end_header' -a "$demo/sofa.ply" || fail "the mesh is not a PLY file"

# Points that the renderer says lie well inside what the robot saw of each object: does the map name their class?
sed -nE 's/.*"point_m":\[([^]]*)\].*/\1/p' "$demo/apartment/truth.json" | tr ',' ' ' >"$demo/points.txt"
sed -nE 's/.*"class":"([^"]*)".*"point_m".*/\1/p' "$demo/apartment/truth.json" >"$demo/expected.txt"
"$bin/dhpmap" query point apartment --file "$demo/points.txt" --json >"$demo/answers.json"
sed -nE 's/.*"class_name": "([^"]*)".*/\1/p' "$demo/answers.json" >"$demo/answered.txt"
total=$(wc -l <"$demo/expected.txt")
[ "$total" -ge 25 ] && [ "$total" -eq "$(wc -l <"$demo/answered.txt")" ] || fail "asked for $total points, got other answers"
right=$(paste "$demo/expected.txt" "$demo/answered.txt" | awk -F'\t' '$1 == $2' | wc -l)
echo "the class at $right of $total objects' points is right, with noisy predictions as input"
[ $((100 * right)) -ge $((85 * total)) ] || fail "less than 85 % of the objects are named right"

kill -TERM "$server"
wait "$server" || fail "the server did not stop cleanly"
trap - EXIT
echo "run.sh --check: everything works"
