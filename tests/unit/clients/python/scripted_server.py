# SPDX-License-Identifier: BSD-3-Clause
"""A gRPC server that answers as a script says, and a wire between client and server that can be cut."""
import concurrent.futures
import socket
import threading

import grpc


class ScriptedServer:
    """Answers calls in turn: with bytes, or a (grpc.StatusCode, message) as an error. Keeps what came."""

    def __init__(self, *answers):
        self.answers, self.requests, self.deadlines_s, self.metadata = list(answers), [], [], []
        self.owner = ""  # of all maps, as answers tell
        self._server = grpc.server(concurrent.futures.ThreadPoolExecutor(4))
        self._server.add_generic_rpc_handlers([self])
        self.address = f"127.0.0.1:{self._server.add_insecure_port('127.0.0.1:0')}"
        self._server.start()

    def service(self, call):
        def answer(request, context):
            self.requests.append((call.method, request))
            self.deadlines_s.append(context.time_remaining())
            self.metadata.append(dict(context.invocation_metadata()))
            if self.owner:
                context.send_initial_metadata((("dhpmap-owner", f"{self.owner} 1"),))
            said = self.answers.pop(0)
            if isinstance(said, bytes):
                return said
            context.abort(*said)
        return grpc.unary_unary_rpc_method_handler(answer)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._server.stop(0).wait()


class Wire:
    """Forwards connections to a server; `cut` ends them all, and refuses others until `mend`."""

    def __init__(self, address):
        host, port = address.split(":")
        self._target, self._pairs, self._is_whole = (host, int(port)), [], True
        self._door = socket.create_server(("127.0.0.1", 0))
        self.address = f"127.0.0.1:{self._door.getsockname()[1]}"
        self.num_connections, self.has_refused = 0, threading.Event()
        threading.Thread(target=self._accept, daemon=True).start()

    def _accept(self):
        while True:
            try:
                near, _ = self._door.accept()
            except OSError:
                return
            if not self._is_whole:
                near.close()
                self.has_refused.set()
                continue
            self.num_connections += 1
            far = socket.create_connection(self._target)
            self._pairs.append((near, far))
            for ends in ((near, far), (far, near)):
                threading.Thread(target=self._carry, args=ends, daemon=True).start()

    @staticmethod
    def _carry(source, target):
        try:
            while data := source.recv(65536):
                target.sendall(data)
        except OSError:
            pass
        for end in (source, target):
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass

    def cut(self):
        self._is_whole = False
        for pair in self._pairs:
            for end in pair:
                try:
                    end.shutdown(socket.SHUT_RDWR)
                except OSError:
                    pass

    def mend(self):
        self._is_whole = True

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.cut()
        self._door.close()
