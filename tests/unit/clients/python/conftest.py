# SPDX-License-Identifier: BSD-3-Clause
"""What tests of the Python client share: one real server a session, which has mapped a small simulated apartment."""
import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[4]
sys.path[:0] = [str(ROOT / "clients/python"), str(pathlib.Path(__file__).parent)]

import dhpmap  # noqa: E402
from mapped_apartment import feed_recording, label_set  # noqa: E402


def pytest_addoption(parser):
    parser.addoption("--bin", type=pathlib.Path, default=ROOT / "build/release/bin", help="folder of dhpmap-server")


class RunningServer:
    """A dhpmap-server on free ports; it may be killed and started again on the same ones."""

    def __init__(self, program, folder, address="127.0.0.1:0"):
        self.program, self.folder = program, folder
        self.start(address)

    def start(self, address):
        self.process = subprocess.Popen(
            [self.program, "--db", self.folder / "maps.db", "--grpc", address, "--http", "127.0.0.1:0",
             "--set", "store.commit_s=0.2"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        for line in self.process.stdout:
            if found := re.search(r"gRPC on ([^ ,]+)", line):
                self.address = found.group(1)
                self.http_address = re.search(r"https?://([^ ]+)", line).group(1).strip()
                return
        raise RuntimeError(f"{self.program} did not start: exit {self.process.wait()}")

    def kill(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()

    def stop(self):
        self.process.terminate()
        assert self.process.wait() == 0
        self.process.stdout.close()

    def start_again(self):
        self.start(self.address)


@pytest.fixture(scope="session")
def programs(request):
    return request.config.getoption("--bin")


@pytest.fixture
def own_server(programs, tmp_path):
    """Of this test alone."""
    server = RunningServer(programs / "dhpmap-server", tmp_path)
    yield server
    server.kill()


@pytest.fixture(scope="session")
def recording(programs, tmp_path_factory):
    """60 frames of 160 x 120 on a walk through the apartment, in the flat layout."""
    folder = tmp_path_factory.mktemp("recording")
    subprocess.run([programs / "dhpmap-simulate", folder, "--frames", "60", "--width", "160", "--height", "120",
                    "--quiet"], check=True, stdout=subprocess.DEVNULL)
    return folder


@pytest.fixture(scope="session")
def server(programs, recording, tmp_path_factory):
    """Has the map "apartment", which the client has fed."""
    running = RunningServer(programs / "dhpmap-server", tmp_path_factory.mktemp("server"))
    with dhpmap.connect(running.address) as connection:
        apartment = connection.create("apartment", label_set(recording))
        feed_recording(apartment, recording)
        apartment.finish_mapping()
    yield running
    running.kill()


@pytest.fixture(scope="session")
def connection(server):
    with dhpmap.connect(server.address) as connected:
        yield connected


@pytest.fixture
def apartment(connection):
    return connection["apartment"]


@pytest.fixture
def sofa(apartment):
    return apartment.find("sofa")[0]
