#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The checker of tests/rig/fleet sees what is lost, doubled, or out of order."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "rig/fleet"))
from verdict import Stored, Told, complaints  # noqa: E402

TOLD = Told(num_sent=12, stored=10, edits={"edit-1": 3, "edit-2": 5})
ALL = Stored(num_frames=10, stored=10, edits=[("edit-1", 3), ("edit-2", 5)])


class FleetVerdict(unittest.TestCase):
    def expect(self, stored, text):
        found = complaints(TOLD, stored)
        self.assertTrue(any(text in its for its in found), found)

    def test_what_was_told_and_what_was_under_way_is_well(self):
        self.assertEqual(complaints(TOLD, ALL), [])
        self.assertEqual(complaints(TOLD, Stored(12, 12, [*ALL.edits, ("edit-3", 7)])), [])

    def test_frames_that_are_lost_doubled_or_never_sent_are_seen(self):
        self.expect(ALL._replace(num_frames=9, stored=9), "9 are stored")
        self.expect(ALL._replace(num_frames=11), "lost or doubled")
        self.expect(ALL._replace(num_frames=13, stored=13), "12 were sent")

    def test_edits_that_are_lost_moved_doubled_or_out_of_order_are_seen(self):
        self.expect(ALL._replace(edits=ALL.edits[:1]), "edit-2 was acknowledged as revision 5, and is None")
        self.expect(ALL._replace(edits=[("edit-1", 3), ("edit-2", 6)]), "and is 6")
        self.expect(ALL._replace(edits=[*ALL.edits, ("edit-2", 7)]), "edit-2 is stored twice")
        self.expect(ALL._replace(edits=[("edit-1", 5), ("edit-2", 3)]), "not in the order")
        self.expect(ALL._replace(edits=[*ALL.edits, ("edit-3", 7), ("edit-4", 8)]), "one was under way")


if __name__ == "__main__":
    unittest.main()
