#!/usr/bin/env -S python3 -B
# SPDX-License-Identifier: BSD-3-Clause
"""Prints docs/cli.md: what the programs say of themselves with --help.

  docs/make_cli_page.py build/release/bin > docs/cli.md
"""
import os
import subprocess
import sys

PROGRAMS = ["dhpmap", "dhpmap-server", "dhpmap-simulate", "dhpmap-evaluate"]
EXIT_CODES = "\nExit codes: "


def help_of(folder, command):
    environment = {name: value for name, value in os.environ.items() if not name.startswith("DHPMAP_")}
    program = os.path.join(folder, command[0])
    answer = subprocess.run([program, *command[1:], "--help"], check=True, capture_output=True, text=True, env=environment)
    text, _, codes = answer.stdout.partition(EXIT_CODES)
    return text.strip(), codes.strip()


def commands_in(text):
    """Names under `Subcommands:`; what goes on in the next line is indented farther."""
    lines = text.partition("\nSubcommands:\n")[2].split("\n\n")[0].splitlines()
    return [line.split()[0] for line in lines if line.startswith("  ") and line[2] != " "]


def print_command(folder, command):
    text, codes = help_of(folder, command)
    print(f"\n{'#' * min(len(command) + 1, 4)} {' '.join(command)}")
    if len(command) == 1 and codes:
        print(f"Exit codes: {codes}\n")
    print(f"```\n{text}\n```")
    for name in commands_in(text):
        print_command(folder, command + [name])


def main():
    folder = sys.argv[1]
    print("# Commands\nWhat each program says with `--help`. Made by `docs/make_cli_page.py build/release/bin > docs/cli.md`.")
    for program in PROGRAMS:
        print_command(folder, [program])


main()
