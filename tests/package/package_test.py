#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Is what `cmake --install` leaves what users need? Builds and runs a project outside of the tree with it.

    tests/package/package_test.py BUILD_DIR

Every public header compiles by itself; docs/cpp.md, a program with messages of its own and the OMPL example build and run
against a real server, by find_package and by pkg-config.
"""
import contextlib
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
COMPILER = "c++"


def run(*command, **options):
    """Its output; ends the test with all that it said if it fails."""
    done = subprocess.run([str(part) for part in command], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: exit {done.returncode}\n{done.stdout}")
    return done.stdout


def install(build, stage):
    """By DESTDIR; where the package is then."""
    prefix = pathlib.Path("/opt/dhpmap")
    run("cmake", "--install", build, "--component", "client", "--prefix", prefix, env={**os.environ, "DESTDIR": stage})
    return stage / prefix.relative_to("/")


def check_headers(prefix):
    """Each by itself, with nothing but the standard library: neither protobuf's nor gRPC's headers, nor OMPL's."""
    headers = sorted((prefix / "include/dhpmap").glob("*.h"))
    assert len(headers) >= 10, headers
    for header in headers:
        for line in header.read_text().splitlines():
            if included := re.match(r"#include [<\"]([^>\"]+)", line):
                name = included.group(1)
                assert name.startswith("dhpmap/") or re.fullmatch("[a-z_]+", name), f"{header.name} includes {name}"
        run(COMPILER, "-std=c++20", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only", f"-I{prefix}/include",
            "-include", header, "-x", "c++", os.devnull)


def check_protos(prefix, work):
    """protoc finds all that they import."""
    protos = prefix / "share/dhpmap/proto"
    names = [str(path.relative_to(protos)) for path in (protos / "dhpmap/v1").glob("*.proto")]
    assert len(names) >= 10, names
    run("protoc", f"-I{protos}", f"--descriptor_set_out={work / 'protos'}", *names)


def page(address):
    """The program that docs/cpp.md is."""
    blocks = re.findall(r"^```cpp\n(.*?)^```$", (ROOT / "docs/cpp.md").read_text(), re.M | re.S)
    assert len(blocks) >= 5, blocks
    lines = [line for block in blocks for line in block.splitlines()]
    assert sum("localhost:50051" in line for line in lines) == 1
    body = [line.replace("localhost:50051", address) for line in lines]
    heads = [line for line in body if line.startswith(("#include", "namespace"))]
    return "\n".join([*heads, "int main() {", *(line for line in body if line not in heads), "}", ""])


@contextlib.contextmanager
def mapped_apartment(programs, work):
    """The address of a server that has mapped the sample apartment."""
    run(programs / "dhpmap-simulate", work / "apartment", "--frames", "60", "--width", "160", "--height", "120", "--quiet")
    server = subprocess.Popen([programs / "dhpmap-server", "--db", work / "maps.db", "--grpc", "127.0.0.1:0", "--http",
                               "127.0.0.1:0"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        address = next(found.group(1) for line in server.stdout if (found := re.search(r"gRPC on ([^ ,]+)", line)))
        run(programs / "dhpmap", "--server", address, "map", work / "apartment", "--map", "apartment")
        yield address
    finally:
        server.kill()
        server.wait()


def main(build):
    work = build / "package_test"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    prefix = install(build, work / "stage")
    check_headers(prefix)
    check_protos(prefix, work)
    version = re.search(r"project\(dhpmap VERSION (\S+) ", (ROOT / "CMakeLists.txt").read_text()).group(1)
    outside = work / "outside"
    outside.mkdir()
    for name in ("CMakeLists.txt", "own_messages.cc"):
        shutil.copy(HERE / name, outside)
    shutil.copy(ROOT / "clients/cpp/examples/plan.cc", outside)
    with mapped_apartment(build / "bin", work) as address:
        (outside / "page.cc").write_text(page(address))
        made = work / "made"
        run("cmake", "-S", outside, "-B", made, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}", f"-DWANTED_VERSION={version}",
            "-DPLAN_SOURCE=plan.cc")
        run("cmake", "--build", made, "-j2")
        told = run(made / "page", cwd=work)  # it writes a file
        for expected in ("INVALID_ARGUMENT", "sofa", "is in the way", "5 frames"):
            assert expected in told, f"docs/cpp.md says not {expected!r}, but:\n{told}"
        assert 'name: "apartment"' in run(made / "own_messages", address)
        if (prefix / "lib/cmake/dhpmap/dhpmap-ompl-targets.cmake").exists():
            assert len(run(made / "plan", address, "apartment", "5.2", "2.6", "8", "6").split()) > 12
        flags = run("pkg-config", "--cflags", "--libs", "dhpmap",
                    env={**os.environ, "PKG_CONFIG_PATH": str(prefix / "lib/pkgconfig")}).split()
        run(COMPILER, "-std=c++20", outside / "page.cc", "-o", work / "page", *flags)
        assert "5 frames" in run(work / "page", cwd=work)
    assert not subprocess.run(["cmake", "-S", outside, "-B", work / "newer", f"-DCMAKE_PREFIX_PATH={prefix}",
                               "-DWANTED_VERSION=99.0"], capture_output=True).returncode == 0, "found as any version"
    print(f"package: {prefix}, all built and run")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]).resolve())
