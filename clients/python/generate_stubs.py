#!/usr/bin/python3 -B
# SPDX-License-Identifier: BSD-3-Clause
"""Makes dhpmap/v1: messages and gRPC stubs of proto/dhpmap/v1 for Python, by Debian's protoc and grpc_python_plugin.

  clients/python/generate_stubs.py [--googleapis DIR] [--out DIR]

The HTTP annotations are left out, and google.rpc.Status is taken in as a message of ours: so the package needs nothing
of google.api or google.rpc, hides no other package that has them, and clashes with none.
"""
import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

from google.protobuf import descriptor_pb2

HERE = pathlib.Path(__file__).resolve().parent
PROTOS = HERE.parent.parent / "proto"
RPC_FILES = {f"google/rpc/{name}.proto": f"dhpmap/v1/rpc_{name}.proto" for name in ("status", "error_details")}
RPC_PACKAGE = "dhpmap.v1.rpc"


def read_descriptors(googleapis: pathlib.Path, work: pathlib.Path) -> descriptor_pb2.FileDescriptorSet:
    """All files of ours, and those of google.* that they need, in the order of their imports."""
    out = work / "read.binpb"
    ours = sorted(str(path.relative_to(PROTOS)) for path in (PROTOS / "dhpmap/v1").glob("*.proto"))
    subprocess.run(["protoc", f"-I{PROTOS}", f"-I{googleapis}", "--include_imports", "--include_source_info",
                    f"--descriptor_set_out={out}", *ours, *RPC_FILES], check=True)
    return descriptor_pb2.FileDescriptorSet.FromString(out.read_bytes())


def is_of_servers(name: str) -> bool:
    return name.startswith("google/api/") or name in ("dhpmap/v1/permission.proto", "google/protobuf/descriptor.proto")


def make_self_contained(file: descriptor_pb2.FileDescriptorProto) -> None:
    """Takes out what servers alone read, HTTP annotations and permissions, and moves google.rpc into our package."""
    kept = [RPC_FILES.get(name, name) for name in file.dependency if not is_of_servers(name)]
    del file.dependency[:]
    file.dependency.extend(kept)
    for service in file.service:
        for method in service.method:
            method.ClearField("options")
    if file.name in RPC_FILES:
        file.name, file.package = RPC_FILES[file.name], RPC_PACKAGE
    for message in file.message_type:
        rename_types(message)


def rename_types(message: descriptor_pb2.DescriptorProto) -> None:
    for field in message.field:
        field.options.DiscardUnknownFields()  # what the field means to servers
        if field.type_name.startswith(".google.rpc."):
            field.type_name = f".{RPC_PACKAGE}." + field.type_name[len(".google.rpc."):]
    for nested in message.nested_type:
        rename_types(nested)


def generate(googleapis: pathlib.Path, out: pathlib.Path) -> None:
    if not (googleapis / "google/rpc/status.proto").exists():
        sys.exit(f"generate_stubs.py: no google/rpc/status.proto under {googleapis}: run deploy/setup.sh")
    plugin = shutil.which("grpc_python_plugin")
    if plugin is None:
        sys.exit("generate_stubs.py: no grpc_python_plugin: install protobuf-compiler-grpc")
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        read = read_descriptors(googleapis, work)
        files = [file for file in read.file if not is_of_servers(file.name)]
        for file in files:
            make_self_contained(file)
        (work / "set.binpb").write_bytes(descriptor_pb2.FileDescriptorSet(file=files).SerializeToString())
        made = work / "made"
        made.mkdir()
        ours = [file.name for file in files if file.name.startswith("dhpmap/v1/")]
        subprocess.run(["protoc", f"--descriptor_set_in={work / 'set.binpb'}", f"--python_out={made}",
                        f"--pyi_out={made}", f"--plugin=protoc-gen-grpc_python={plugin}",
                        f"--grpc_python_out={made}", *ours], check=True)
        package = made / "dhpmap/v1"
        for stub in package.glob("*_pb2_grpc.py"):
            if not stub.name.endswith("_service_pb2_grpc.py"):
                stub.unlink()  # of a file without services: nothing is in it
        (package / "__init__.py").write_text('"""Messages and stubs of proto/dhpmap/v1; generated, do not edit."""\n')
        replace(package, out)


def replace(made: pathlib.Path, out: pathlib.Path) -> None:
    """What has not changed keeps its time, but for __init__.py, by which a build sees that all is made; what is no
    longer made goes."""
    out.mkdir(parents=True, exist_ok=True)
    for old in out.glob("*.py*"):
        if not (made / old.name).exists():
            old.unlink()
    for new in made.iterdir():
        target = out / new.name
        if not target.exists() or target.read_bytes() != new.read_bytes():
            shutil.copyfile(new, target)
    (out / "__init__.py").touch()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--googleapis", type=pathlib.Path, default=HERE.parent.parent / "build/googleapis")
    parser.add_argument("--out", type=pathlib.Path, default=HERE / "dhpmap/v1")
    options = parser.parse_args()
    generate(options.googleapis, options.out)


if __name__ == "__main__":
    main()
