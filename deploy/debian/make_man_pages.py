#!/usr/bin/python3 -B
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a manual page for each command of dhpmap, and one for dhpmap-server, by help2man.

  deploy/debian/make_man_pages.py BIN OUT
"""
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

SUMMARY = {"dhpmap": "client of the DHP Map Server", "dhpmap-server": "map server for robots"}
ENVIRONMENT = {name: value for name, value in os.environ.items() if not name.startswith("DHPMAP_")}


def help_of(folder, command):
    return subprocess.run([folder / command[0], *command[1:], "--help"], check=True, capture_output=True, text=True,
                          env=ENVIRONMENT).stdout


def commands_in(text):
    """Names under `Subcommands:`; what goes on in the next line is indented farther."""
    lines = text.partition("\nSubcommands:\n")[2].split("\n\n")[0].splitlines()
    return [line.split()[0] for line in lines if line.startswith("  ") and line[2] != " "]


def tree(folder, command):
    text = help_of(folder, command)
    yield command, text
    for name in commands_in(text):
        yield from tree(folder, command + [name])


def write_page(folder, out, command, text):
    name, section = "-".join(command), "8" if command[0] == "dhpmap-server" else "1"
    summary = SUMMARY.get(name) or text.strip().splitlines()[0].rstrip(":;")
    version = subprocess.check_output([folder / command[0], "--version"], text=True).split()[-1]
    page = subprocess.run(["help2man", "--no-info", f"--section={section}", f"--name={summary}",
                           f"--version-string={version}", " ".join([str(folder / command[0]), *command[1:]])],
                          check=True, capture_output=True, text=True, env=ENVIRONMENT).stdout
    page = re.sub(r'^\.TH [^"]+(?= ")', f".TH {name.upper()}", page, flags=re.M)
    page = re.sub(r"(\.SH NAME\n).*?(?= \\- )", lambda its: f"{its.group(1)}{name}", page)
    (out / f"{name}.{section}").write_text(page)


def main(folder, out):
    out.mkdir(parents=True, exist_ok=True)
    pages = [page for program in SUMMARY for page in tree(folder, [program])]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(lambda page: write_page(folder, out, *page), pages))
    print(f"{len(pages)} manual pages in {out}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]))
