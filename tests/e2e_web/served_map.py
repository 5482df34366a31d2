# SPDX-License-Identifier: BSD-3-Clause
"""A server of its own with a map of the simulated apartment."""
import json
import os
import re
import signal
import subprocess
import threading
import urllib.error
import urllib.request

PATIENCE_S = 150  # on a slow and busy machine


class Server:
    """dhpmap-server on loopback; starts again on the same port, so that pages find it again."""

    def __init__(self, programs, folder, name="maps"):
        self.programs, self.folder, self.name = programs, folder, name
        self.http = self.grpc = "127.0.0.1:0"
        self.start()

    def make_key(self, name, role):
        """Where there is a file of keys beside the database, the server asks for them."""
        file = os.path.join(self.folder, f"{self.name}.db.keys")
        return subprocess.run([os.path.join(self.programs, "dhpmap"), "keys", "create", name, "--role", role, "--keys",
                               file], check=True, capture_output=True, text=True).stdout.strip()

    def start(self):
        self.process = subprocess.Popen(
            [os.path.join(self.programs, "dhpmap-server"), "--db", os.path.join(self.folder, f"{self.name}.db"),
             "--grpc", self.grpc, "--http", self.http], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        said = ""
        for line in self.process.stdout:
            said += line
            if found := re.search(r"gRPC on ([0-9.:]+), REST on http://([0-9.:]+)\n", line):
                self.grpc, self.http = found.groups()
                # What it says later is read, so that the pipe never fills.
                threading.Thread(target=self.process.stdout.read, daemon=True).start()
                return
        raise RuntimeError(f"the server did not start: {said}")

    @property
    def url(self):
        return "http://" + self.http

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()

    def stop(self):
        if self.process.poll() is None:
            self.process.terminate()
        self.process.wait()

    def feed(self, *arguments):
        return subprocess.Popen([os.path.join(self.programs, "dhpmap"), "map", *arguments, "--server", self.grpc],
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)

    def ask(self, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        headers = {"Content-Type": "application/json"}
        request = urllib.request.Request(f"{self.url}/v1/{path}", data=data, headers=headers)
        with urllib.request.urlopen(request, timeout=PATIENCE_S) as answer:
            return json.load(answer)

    def surface(self, map_name, object_id, etag=""):
        """Status and ETag of its GLB."""
        headers = {"Accept-Encoding": "gzip", **({"If-None-Match": etag} if etag else {})}
        request = urllib.request.Request(f"{self.url}/v1/maps/{map_name}/submaps/{object_id}/mesh?format=GLB",
                                         headers=headers)
        try:
            with urllib.request.urlopen(request, timeout=PATIENCE_S) as answer:
                answer.read()
                return answer.status, answer.headers["ETag"]
        except urllib.error.HTTPError as error:
            return error.code, error.headers["ETag"]

    def objects(self, map_name):
        return {each["name"].split("/")[-1]: each for each in self.ask(f"maps/{map_name}/submaps")["submaps"]}

    def translation(self, map_name, object_id):
        return self.ask(f"maps/{map_name}/submaps/{object_id}")["submap"]["map_from_submap"]["translation_m"]


def render(programs, folder):
    data = os.path.join(folder, "apartment")
    subprocess.run([os.path.join(programs, "dhpmap-simulate"), data, "--frames", "60", "--width", "320",
                    "--height", "240", "--no-noise", "--quiet"], check=True, stdout=subprocess.DEVNULL)
    return data
