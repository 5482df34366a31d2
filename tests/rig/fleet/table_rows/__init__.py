# SPDX-License-Identifier: BSD-3-Clause
"""Rows of tests/rig/fleet/table.py, and what they run on."""
