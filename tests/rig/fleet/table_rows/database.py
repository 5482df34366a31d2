# SPDX-License-Identifier: BSD-3-Clause
"""A PostgreSQL of our own with fsync, on Unix sockets: alone, or with standbys of which one must have each commit."""
import os
import pathlib
import pwd
import shutil
import signal
import subprocess
import time

SETTINGS = """
listen_addresses = ''
shared_buffers = 256MB
max_wal_size = 4GB
max_connections = 200
shared_preload_libraries = 'pg_stat_statements'
lc_messages = C
"""
START_S, STOP_S = 60, 20


def programs():
    """The folder of initdb and postgres; the newest of several."""
    found = sorted(pathlib.Path("/usr/lib/postgresql").glob("*/bin/initdb"), key=lambda its: float(its.parts[-3]))
    if not found:
        raise SystemExit("there is no PostgreSQL server to start: deploy/setup.sh --postgres installs one")
    return found[-1].parent


class Database:
    """Use it as a context: its servers end with it, and with this process."""

    def __init__(self, folder, standbys=0):
        self._folder, self._bin = pathlib.Path(folder), programs()
        self._folder.mkdir()
        self._as = ["setpriv", "--pdeathsig", "QUIT"]
        if os.geteuid() == 0:
            user = pwd.getpwnam("postgres")
            os.chown(self._folder, user.pw_uid, user.pw_gid)
            self._as += [f"--reuid={user.pw_uid}", f"--regid={user.pw_gid}", "--clear-groups"]
        self._num_standbys = standbys
        self._servers = []

    def __enter__(self):
        try:
            self._run("initdb", "-D", self._data("primary"), "-U", "postgres", "-A", "trust", "-E", "UTF8",
                      "--locale=C.UTF-8", "--no-sync")
            with open(self._data("primary") / "postgresql.conf", "a", encoding="utf-8") as conf:
                conf.write(SETTINGS + f"unix_socket_directories = '{self._folder}'\n")
            self._start("primary", 5432)
            self.sql("CREATE EXTENSION pg_stat_statements")
            self._add_standbys([f"standby{n}" for n in range(1, self._num_standbys + 1)])
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for server in reversed(self._servers):
            server.send_signal(signal.SIGQUIT)
        for server in self._servers:
            server.wait(STOP_S)
        shutil.rmtree(self._folder, ignore_errors=True)

    @property
    def pid(self):
        """Of the primary's first process."""
        return self._servers[0].pid

    def url(self, name="postgres"):
        return f"postgresql://postgres@/{name}?host={self._folder}&port=5432"

    def create(self, name):
        self.sql(f"CREATE DATABASE {name}")
        return self.url(name)

    def drop(self, name):
        self.sql(f"DROP DATABASE {name} WITH (FORCE)")

    def sql(self, text):
        done = subprocess.run([self._bin / "psql", "-h", self._folder, "-p", "5432", "-U", "postgres", "-XAtc", text],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=60, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{text}: {done.stderr}")
        return done.stdout.strip()

    def _data(self, node):
        return self._folder / node

    def _run(self, program, *arguments):
        done = subprocess.run([*self._as, self._bin / program, *arguments], cwd=self._folder, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{program}: {done.stdout}")

    def _start(self, node, port):
        log = open(self._folder / f"{node}.log", "w", encoding="utf-8")
        self._servers.append(subprocess.Popen(
            [*self._as, self._bin / "postgres", "-D", self._data(node), "-p", str(port)], cwd=self._folder,
            stdin=subprocess.DEVNULL, stdout=log, stderr=log))
        log.close()
        end = time.monotonic() + START_S
        while subprocess.run([self._bin / "pg_isready", "-q", "-h", self._folder, "-p", str(port)],
                             check=False).returncode != 0:
            if self._servers[-1].poll() is not None or time.monotonic() > end:
                raise RuntimeError(f"{node} does not start: " + (self._folder / f"{node}.log").read_text())
            time.sleep(0.1)

    def _add_standbys(self, names):
        for n, name in enumerate(names, 1):
            self._run("pg_basebackup", "-h", self._folder, "-p", "5432", "-U", "postgres", "-D", self._data(name), "-R",
                      "-c", "fast")
            with open(self._data(name) / "postgresql.auto.conf", "a", encoding="utf-8") as conf:
                conf.write(f"primary_conninfo = 'host={self._folder} port=5432 user=postgres "
                           f"application_name={name}'\n")
            self._start(name, 5432 + n)
        if not names:
            return
        self.sql(f"ALTER SYSTEM SET synchronous_standby_names = 'ANY 1 ({', '.join(names)})'")
        self.sql("SELECT pg_reload_conf()")
        end = time.monotonic() + START_S
        while self.sql("SELECT count(*) FROM pg_stat_replication WHERE sync_state = 'quorum'") != str(len(names)):
            if time.monotonic() > end:
                raise RuntimeError("the standbys do not follow")
            time.sleep(0.1)
