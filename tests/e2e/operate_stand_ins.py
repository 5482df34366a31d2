# SPDX-License-Identifier: BSD-3-Clause
"""Programs that stand in for those of a system while docs/operate.md is tried: name -> what /bin/sh does.

systemctl runs $EXEC_START by hand and logs into $JOURNAL.
"""
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]

STAND_INS = {
    "sudo": 'if [ "$1" = -u ]; then shift 2; fi\nexec "$@"\n',
    "chown": "exit 0\n",
    "install": """set -- "$@" --
while [ "$1" != -- ]; do
  case "$1" in -o | -g) shift ;; *) set -- "$@" "$1" ;; esac
  shift
done
shift
exec /usr/bin/install "$@"
""",
    "apt-get": f'for file in "$@"; do\n  case "$file" in ./*)\n    name=${{file#./}}\n'
               f'    grep -qx "Package: ${{name%%_*}}" {ROOT}/deploy/debian/control || exit 100 ;;\n  esac\ndone\n',
    "journalctl": 'cat "$JOURNAL"\n',
    "systemctl": """case "$2" in dhpmap-server) ;; *) exit 5 ;; esac
running() { [ -f "$JOURNAL.pid" ] && kill -0 "$(cat "$JOURNAL.pid")" 2>/dev/null; }
stop() {
  running || return 0
  kill "$(cat "$JOURNAL.pid")"
  while running; do sleep 0.05; done
}
start() {
  running && return 0
  : >"$JOURNAL"
  setsid $EXEC_START >>"$JOURNAL" 2>&1 </dev/null &
  echo $! >"$JOURNAL.pid"
  until grep -q "REST on" "$JOURNAL"; do running || { cat "$JOURNAL" >&2; exit 1; }; sleep 0.05; done
}
case "$1" in
  start) start ;;
  stop) stop ;;
  restart) stop; start ;;
  reload) kill -HUP "$(cat "$JOURNAL.pid")" ;;
  is-active) running && echo active ;;
  *) exit 1 ;;
esac
""",
}
