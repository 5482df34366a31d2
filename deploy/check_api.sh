#!/usr/bin/env bash
# Checks with programs of others what a server of the release build serves: the OpenAPI document by two validators, the
# gRPC services by `buf curl`, which knows of them by reflection only, a mapped room as GLB by Khronos' validator. The
# last line reads `N passed, N failed`.
# Node fetches these programs, into build/api: without it, or without a registry to fetch them from, nothing is checked.
set -euo pipefail
cd "$(dirname "$0")/.."

readonly packages=(@seriousme/openapi-schema-validator@2.11.0 @apidevtools/swagger-parser@12.1.0 @bufbuild/buf@1.75.0
  gltf-validator@2.0.0-dev.3.10)
readonly tools=$PWD/build/api/tools work=$PWD/build/api/run
readonly bin=$tools/node_modules/.bin
export BUF_CACHE_DIR=$PWD/build/api/cache NO_COLOR=1

skip() {
  echo "SKIPPED: $*: neither the OpenAPI document nor reflection was checked"
  echo "0 passed, 0 failed"
  exit 0
}

# A package that cannot be installed although the registry answers is a failure.
fetch_tools() {
  [ "$(cat "$tools/installed" 2>/dev/null)" != "${packages[*]}" ] || return 0
  command -v npm >/dev/null || skip "there is no npm"
  mkdir -p "$tools"
  npm ping --fetch-timeout=10000 --fetch-retries=1 >"$tools/npm.log" 2>&1 || skip "the package registry does not answer"
  npm install --fetch-retries=5 --ignore-scripts --no-audit --no-fund --prefix "$tools" "${packages[@]}" >>"$tools/npm.log" 2>&1 || {
    cat "$tools/npm.log"
    return 1
  }
  cat >"$tools/resolve.mjs" <<'CODE'
import parser from '@apidevtools/swagger-parser';
await parser.validate(process.argv[2]);
CODE
  cat >"$tools/glb.mjs" <<'CODE'
import fs from 'node:fs';
import { createRequire } from 'node:module';
const bytes = new Uint8Array(fs.readFileSync(process.argv[2]));
const { issues } = await createRequire(import.meta.url)('gltf-validator').validateBytes(bytes, { maxIssues: 20 });
const end = 20 + new DataView(bytes.buffer).getUint32(12, true);
const json = JSON.parse(Buffer.from(bytes.subarray(20, end)).toString());
const nodes = json.scenes[0].nodes.map((number) => json.nodes[number]);
const isShare = (share) => share > 0 && share <= 1;
const known = nodes.filter(({ extras }) => extras.class_name && isShare(extras.class_confidence));
console.log(`${nodes.length} objects, ${known.length} of a class`);
console.log(`${issues.numErrors} errors, ${issues.numWarnings} warnings`);
for (const its of issues.messages) if (its.severity < 2) console.log(its.code, its.message, its.pointer);
process.exit(issues.numErrors + issues.numWarnings > 0 || nodes.length < 3 || known.length < 3 ? 1 : 0);
CODE
  echo "${packages[*]}" >"$tools/installed"
}

start_server() {
  rm -rf "$work"
  mkdir -p "$work"
  build/release/bin/dhpmap-server --db "$work/maps.db" --grpc 127.0.0.1:0 --http 127.0.0.1:0 >"$work/server.log" 2>&1 &
  server=$!
  trap 'kill -TERM "$server" 2>/dev/null; wait "$server" 2>/dev/null || true' EXIT
  for _ in $(seq 100); do
    if grep -q 'REST on' "$work/server.log"; then
      grpc=http://$(sed -nE 's/.*gRPC on ([^ ,]+), REST on .*/\1/p' "$work/server.log" | head -n 1)
      rest=$(sed -nE 's/.*REST on ([^ ]+).*/\1/p' "$work/server.log" | head -n 1)
      return
    fi
    kill -0 "$server" 2>/dev/null || break
    sleep 0.1
  done
  cat "$work/server.log"
  return 1
}

# call SERVICE/METHOD [JSON]: the answer, or the error as buf prints it.
call() { "$bin/buf" curl --http2-prior-knowledge --protocol grpc --data "${2:-{\}}" "$grpc/$1" 2>&1; }
list() { "$bin/buf" curl --http2-prior-knowledge --protocol grpc "--list-$1" "$grpc"; }

is_schema_valid() { "$bin/validate-api" "$1" >"$work/validator.log" 2>&1; }
is_resolvable() { node "$tools/resolve.mjs" "$1" >"$work/validator.log" 2>&1; }

check_openapi() {
  curl -sS --fail "$rest/openapi.json" -o "$work/openapi.json" || return 1
  local validator
  for validator in is_schema_valid is_resolvable; do
    "$validator" "$work/openapi.json" || { cat "$work/validator.log"; return 1; }
    sed 's/"responses":/"answers":/' "$work/openapi.json" >"$work/broken.json"
    if "$validator" "$work/broken.json"; then
      echo "$validator finds nothing wrong with a document without responses"
      return 1
    fi
  done
}

# What is listed is what the .proto files say, and nothing is listed that they do not.
check_reflection() {
  local expected listed
  expected=$(awk '$1 == "service" { service = $2 }
    $1 == "rpc" { sub(/\(.*/, "", $2); print "dhpmap.v1." service "/" $2 }' proto/dhpmap/v1/*.proto | sort)
  listed=$(list methods | grep '^dhpmap' | sort) || return 1
  diff <(echo "$expected") <(echo "$listed") || return 1
  # Not piped into `grep -q`, which stops reading at its first match: buf may then die of it.
  listed=$(list services) || return 1
  grep -qx grpc.health.v1.Health <<<"$listed" || { echo "$listed"; return 1; }
}

check_calls() {
  local answer
  answer=$(call grpc.health.v1.Health/Check)
  grep -q '"status": "SERVING"' <<<"$answer" || { echo "$answer"; return 1; }
  answer=$(call dhpmap.v1.MapService/CreateMap '{"map_id": "flat", "display_name": "My flat"}')
  grep -q '"displayName": "My flat"' <<<"$answer" || { echo "$answer"; return 1; }
  answer=$(call dhpmap.v1.MapService/GetMap '{"name": "maps/flat"}')
  grep -q '"displayName": "My flat"' <<<"$answer" || { echo "$answer"; return 1; }
  answer=$(call dhpmap.v1.MapService/GetMap '{"name": "maps/nowhere"}') && return 1
  grep -q '"code": "not_found"' <<<"$answer" || { echo "$answer"; return 1; }
}

is_glb_valid() { node "$tools/glb.mjs" "$1"; }

check_glb() {
  local dhpmap=(build/release/bin/dhpmap --server "${grpc#http://}")
  build/release/bin/dhpmap-simulate "$work/room" --frames 20 --width 160 --height 120 --quiet || return 1
  "${dhpmap[@]}" map "$work/room" --map room >"$work/map.log" 2>&1 || { cat "$work/map.log"; return 1; }
  "${dhpmap[@]}" export glb room -o "$work/room.glb" || return 1
  is_glb_valid "$work/room.glb" || return 1
  sed 's/"componentType":5123/"componentType":5124/' "$work/room.glb" >"$work/broken.glb"
  if is_glb_valid "$work/broken.glb" >/dev/null; then
    echo "the validator finds nothing wrong with indices of no type"
    return 1
  fi
}

passed=0
failed=0
check() {
  echo "== api: $1"
  if "check_$1"; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "-- $1 failed"; fi
}

mkdir -p build
if [ ! -x build/release/bin/dhpmap-server ]; then
  echo "there is no release build: run deploy/test.sh first" >&2
  exit 1
fi
if fetch_tools && start_server; then
  check openapi
  check reflection
  check calls
  check glb
else
  failed=1
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
