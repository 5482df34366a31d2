#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do dashboard and alert rules of deploy/monitoring ask for metrics that a server serves, with labels that it has?

    tests/e2e/monitoring_test.py BIN_DIR

A server maps, is asked, and has a connection refused; then each name{label} of each expression must be in its /metrics.
promtool, where it is installed, checks the rules.
"""
import contextlib
import json
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parents[2]
MONITORING = ROOT / "deploy/monitoring"
OF_PROMETHEUS = {"job", "instance"}  # labels that scraping adds
SUFFIX = re.compile(r"_(bucket|sum|count)$")


def expressions():
    dashboard = json.loads((MONITORING / "dashboard.json").read_text())
    found = [target["expr"] for panel in dashboard["panels"] for target in panel["targets"]]
    found += [variable["query"] for variable in dashboard["templating"]["list"] if variable["type"] == "query"]
    rules = (MONITORING / "alerts.yaml").read_text()
    for expression in re.findall(r"^ +expr: (.*(?:\n {10,}.*)*)", rules, re.M):
        found.append(expression)
    return found


def asked(expression):
    """(metric, its labels) of an expression, those of matchers and of `by`."""
    text = re.sub(r'"[^"]*"', '""', expression)
    metrics = re.findall(r"\b((?:dhpmap|process)_\w+)(?:\{([^}]*)\})?", text)
    by = {label.strip() for names in re.findall(r"\bby \(([^)]*)\)", text) for label in names.split(",")}
    return [(name, set(re.findall(r"(\w+) *[=!]", matchers)) | by) for name, matchers in metrics]


def served(text):
    """Metric -> all labels seen with it."""
    labels = {}
    for name, matchers in re.findall(r"^([a-z_]+)(?:\{([^}]*)\})? ", text, re.M):
        for each in {name, SUFFIX.sub("", name)}:
            labels.setdefault(each, set()).update(re.findall(r'(\w+)="', matchers))
    return labels


def metrics_of_a_busy_server(bin_dir, work):
    server = subprocess.Popen([bin_dir / "dhpmap-server", "--db", work / "maps.db", "--grpc", "127.0.0.1:0", "--http",
                               "127.0.0.1:0"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        ready = next(found for line in server.stdout if (found := re.search(r"gRPC on ([^ ,]+), REST on (\S+)", line)))
        grpc, rest = ready.groups()
        subprocess.run([bin_dir / "dhpmap-simulate", work / "room", "--frames", "4", "--width", "80", "--height", "60",
                        "--quiet"], check=True, stdout=subprocess.DEVNULL)
        for command in (["map", work / "room", "--map", "room"], ["query", "distances", "room", "1", "1", "1"]):
            subprocess.run([bin_dir / "dhpmap", "--server", grpc, *command], check=True, capture_output=True)
        host, port = grpc.rsplit(":", 1)
        with socket.create_connection((host, int(port))) as stranger:
            stranger.sendall(b"these are no first words of HTTP/2\r\n\r\n")
            with contextlib.suppress(ConnectionResetError):
                while stranger.recv(1024):  # until the guard has ended it
                    pass
        for _ in range(1000):  # it counts beside
            with urllib.request.urlopen(f"{rest}/metrics") as answer:
                text = answer.read().decode()
            if "dhpmap_guard_refused_total{" in text:
                break
        return text
    finally:
        server.kill()
        server.wait()


def main(bin_dir):
    work = pathlib.Path(tempfile.mkdtemp(prefix="monitoring."))
    try:
        has = served(metrics_of_a_busy_server(bin_dir, work))
    finally:
        shutil.rmtree(work)
    missing = []
    questions = [question for expression in expressions() for question in asked(expression)]
    assert len(questions) >= 30, questions
    for name, labels in questions:
        if name not in has:
            missing.append(f"{name} is not served")
            continue
        allowed = has[name] | OF_PROMETHEUS | ({"le"} if name.endswith("_bucket") else set())
        missing += [f"{name} has no label {label}" for label in sorted(labels - allowed)]
    if missing:
        sys.exit("\n".join(sorted(set(missing))))
    if promtool := shutil.which("promtool"):
        subprocess.run([promtool, "check", "rules", MONITORING / "alerts.yaml"], check=True, stdout=subprocess.DEVNULL)
    else:
        print("alerts.yaml is not checked by promtool: install prometheus")
    print(f"monitoring: {len(questions)} metrics of {len(set(name for name, _ in questions))} names, all served")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]).resolve())
