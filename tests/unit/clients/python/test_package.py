# SPDX-License-Identifier: BSD-3-Clause
"""The package as a whole: what it exports, its types, its wheel, what notebooks show."""
import ast
import inspect
import pathlib
import re
import shutil
import subprocess
import sys
import zlib

import pytest

import dhpmap

ROOT = pathlib.Path(__file__).resolve().parents[4]
PACKAGE = ROOT / "clients/python"


def test_what_is_exported_is_there_and_documented():
    assert sorted(dhpmap.__all__) == sorted(set(dhpmap.__all__))
    for name in dhpmap.__all__:
        assert getattr(dhpmap, name).__doc__, name
    named = {name for name, its in vars(dhpmap).items() if not name.startswith("_") and not inspect.ismodule(its)}
    assert named == set(dhpmap.__all__)


@pytest.mark.parametrize("kind", [dhpmap.Server, dhpmap.Map, dhpmap.PastMap, dhpmap.Loop, dhpmap.Edit, dhpmap.Feed,
                                  dhpmap.Watch], ids=lambda its: its.__name__)
def test_most_methods_say_what_they_do(kind):
    methods = [its for name, its in inspect.getmembers(kind, inspect.isfunction) if not name.startswith("_")]
    silent = [its.__name__ for its in methods if not its.__doc__]
    assert len(silent) <= 2, silent  # whose names say all


def test_modules_are_underscored_and_import_nothing_that_is_not_declared():
    allowed = {"grpc", "numpy", "google.protobuf", "dhpmap", "tqdm", *sys.stdlib_module_names}
    for path in [*(PACKAGE / "dhpmap").glob("*.py"), *(PACKAGE / "dhpmap/mcap").glob("*.py")]:
        assert path.name.startswith("_"), path
        for node in ast.walk(ast.parse(path.read_text())):
            names = [node.module] if isinstance(node, ast.ImportFrom) else []
            names += [its.name for its in node.names] if isinstance(node, ast.Import) else []
            for name in names:
                assert name.split(".")[0] in allowed or name.startswith("google.protobuf"), (path, name)


def test_nothing_of_google_rpc_or_google_api_is_taken_or_hidden():
    program = ("import dhpmap, sys; from google.protobuf import descriptor_pool as p\n"
               "print([m for m in sys.modules if m.startswith(('google.rpc', 'google.api'))])\n"
               "try: p.Default().FindFileByName('google/rpc/status.proto')\nexcept KeyError: print('free')")
    said = subprocess.run([sys.executable, "-B", "-c", program], env={"PYTHONPATH": str(PACKAGE)}, check=True,
                          capture_output=True, text=True)
    assert said.stdout == "[]\nfree\n" and said.stderr == ""
    assert not (PACKAGE / "google").exists()


def test_a_package_whose_stubs_are_not_made_says_how(tmp_path):
    shutil.copytree(PACKAGE / "dhpmap", tmp_path / "dhpmap", ignore=shutil.ignore_patterns("v1"))
    said = subprocess.run([sys.executable, "-B", "-c", "import dhpmap"], env={"PYTHONPATH": str(tmp_path)},
                          capture_output=True, text=True)
    assert "ImportError: dhpmap.v1 is not made yet: build the target python_client" in said.stderr


def test_mypy_strict_has_nothing_to_say(tmp_path):
    checked = subprocess.run(["/usr/bin/mypy", "--cache-dir", tmp_path], cwd=PACKAGE, capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout


def test_users_mistakes_are_found_by_mypy(tmp_path):
    (tmp_path / "used.py").write_text(
        "import dhpmap\nm = dhpmap.connect()['a']\nm.distances([(1, 2, 3)], ignored=[1])\n"
        "m.find('sofa', near=(1, 2, 3))[0].colour\nreveal_type(m.distances([(1, 2, 3)]).distance_m)\n")
    (tmp_path / "mypy.ini").write_text("[mypy]\nenable_incomplete_feature = Unpack\nignore_missing_imports = True\n"
                                       "[mypy-dhpmap.v1.*]\nignore_errors = True\n")
    checked = subprocess.run(
        ["/usr/bin/mypy", "--cache-dir", tmp_path / "cache", "used.py"],
        cwd=tmp_path, env={"MYPYPATH": f"{PACKAGE}:{PACKAGE / 'typings'}", "PATH": "/usr/bin"}, capture_output=True,
        text=True)
    assert 'used.py:3: error: Unexpected keyword argument "ignored"' in checked.stdout
    assert 'used.py:4: error: "Object" has no attribute "colour"' in checked.stdout
    assert "_32Bit" in checked.stdout


def test_the_wheel_runs_in_an_environment_of_its_own(tmp_path):
    def run(*command, **more):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)
        assert done.returncode == 0, done.stdout
        return done.stdout

    run("/usr/bin/python3", "-m", "pip", "wheel", "--no-build-isolation", "--no-index", "--no-deps", "-q",
        "-w", tmp_path, PACKAGE)
    wheel = next(tmp_path.glob("dhpmap-*.whl"))
    run("/usr/bin/python3", "-m", "venv", "--system-site-packages", tmp_path / "env")
    python = tmp_path / "env/bin/python"
    run(python, "-m", "pip", "install", "-q", "--no-index", "--no-deps", wheel)
    said = run(python, "-c", "import dhpmap.v1.query_service_pb2_grpc as s; print(dhpmap.__version__, dhpmap.__file__)"
               .replace("import dhpmap.v1", "import dhpmap, dhpmap.v1"), cwd=tmp_path)
    assert said.startswith(f"{dhpmap.__version__} {tmp_path / 'env'}") and (tmp_path / "env").is_dir()
    files = run(python, "-m", "zipfile", "-l", wheel)
    assert "dhpmap/mcap/__main__.py" in files and "dhpmap/label_sets/coco_panoptic.csv" in files
    assert "dhpmap/py.typed" in files and "dhpmap/v1/types_pb2.pyi" in files and not re.search(r"^google", files, re.M)


def test_the_version_is_that_of_the_project():
    assert f"VERSION {dhpmap.__version__} " in (ROOT / "CMakeLists.txt").read_text()


def test_notebooks_show_maps_and_objects(apartment, sofa):
    with apartment.edit() as e:
        e.rename(sofa, "<script>")
    shown = apartment._repr_html_() + apartment.objects[sofa]._repr_html_() + apartment.objects._repr_html_()
    assert "&lt;script&gt;" in shown and "<script>" not in shown and "more</p>" in shown
    apartment.undo()


def test_notebooks_show_slices_as_a_picture(apartment):
    shown = apartment.slice(0.1, 1.2, include_objects=True)
    assert apartment.distance_grid(dhpmap.Box((1, 1, 0), (2, 3, 1)), 0.1)._repr_png_().startswith(b"\x89PNG")
    png = shown._repr_png_()
    assert png.startswith(b"\x89PNG") and int.from_bytes(png[16:20], "big") % shown.cells.shape[1] == 0
    at = png.index(b"IDAT")
    rows = zlib.decompress(png[at + 4:at + 4 + int.from_bytes(png[at - 4:at], "big")])
    width, height = int.from_bytes(png[16:20], "big"), int.from_bytes(png[20:24], "big")
    assert len(rows) == height * (1 + 3 * width)
