#!/bin/sh
# What deploy/try_packages.sh does in a system with the packages: the server runs as its user, by the unit's command.
set -eu
fail() { echo "try_packages.sh: $*" >&2; [ ! -f /try/log ] || tail -n 20 /try/log >&2; exit 1; }

start() {
  command=$(sed -n 's/^ExecStart=//p' /lib/systemd/system/dhpmap-server.service)
  : >/try/log  # of an earlier start
  # shellcheck disable=SC2086  # words of a command
  (cd /var/lib/dhpmap && exec setpriv --reuid dhpmap --regid dhpmap --init-groups --no-new-privs $command) \
    >>/try/log 2>&1 &
  server=$!
  n=0
  until grep -q 'REST on' /try/log; do
    kill -0 "$server" 2>/dev/null || fail "the server did not start"
    n=$((n + 1))
    [ "$n" -lt 600 ] || fail "the server is not ready after a minute"
    sleep 0.1
  done
  [ "$(stat -c %U "/proc/$server")" = dhpmap ] || fail "the server does not run as dhpmap"
}
stop() {
  kill -TERM "$server"
  wait "$server" || fail "the server did not stop cleanly"
}
answers() {
  for question in "stats room" "submaps room" "query point room 2 2 0.5"; do
    # shellcheck disable=SC2086  # words of a command
    dhpmap $question >/dev/null || fail "no answer to $question"
  done
  dhpmap verify room >/dev/null || fail "the map is damaged"
  objects=$(dhpmap submaps room --json | grep -c '"name": "maps/room/submaps/')
  echo "        runs as user dhpmap, answers: $objects objects of map room, verified"
}

case "$1" in
  feed_and_ask)
    start
    dhpmap map /try/apartment --map room >/dev/null 2>&1 || fail "cannot feed"
    answers
    if [ -d /usr/lib/python3/dist-packages/dhpmap ]; then
      python3 -c 'import dhpmap
print("        python3-dhpmap", dhpmap.__version__, "sees", len(dhpmap.connect()["room"].objects), "objects")'
    fi
    stop
    [ "$(stat -c '%U %a' /var/lib/dhpmap/maps.db)" = "dhpmap 600" ] || fail "others can read the maps"
    ;;
  ask) start; answers; stop ;;
  serve_old_schema)
    start
    dhpmap maps list || fail "no answer"
    map=$(dhpmap maps list --json | sed -nE 's|.*"name": *"maps/([^"]*)".*|\1|p' | head -n 1)
    dhpmap verify "$map" || fail "damaged by its upgrade"
    stop
    if dhpmap-server --help | grep -q -- --no-backup; then
      ls /var/lib/dhpmap/maps.db.before-v* >/dev/null || fail "no copy of the database was kept"
    fi
    ls -l /var/lib/dhpmap
    ;;
esac
