# SPDX-License-Identifier: BSD-3-Clause
"""What is stored against what was acknowledged: the stored history is a prefix of what was sent, has every
acknowledgement, and nothing twice."""
import typing


class Told(typing.NamedTuple):
    """What clients sent and heard."""
    num_sent: int        # frames; their sequences begin with 1
    stored: int          # the last frame that was acknowledged as stored
    edits: dict[str, int]  # "edit-1", ... : the revision that was answered


class Stored(typing.NamedTuple):
    """What a server reads from the database."""
    num_frames: int      # of the map
    stored: int          # the session's last frame
    edits: list[tuple[str, int]]  # author and revision, of the log


def complaints(told: Told, stored: Stored) -> list[str]:
    found = []
    if stored.stored < told.stored:
        found.append(f"frames up to {told.stored} were acknowledged, and {stored.stored} are stored")
    if stored.stored > told.num_sent:
        found.append(f"{stored.stored} frames are stored, and {told.num_sent} were sent")
    if stored.num_frames != stored.stored:
        found.append(f"the map has {stored.num_frames} frames, its only session {stored.stored}: lost or doubled")
    return found + complaints_of_edits(told.edits, stored.edits)


def complaints_of_edits(told, stored):
    found, revisions = [], {}
    for author, revision in stored:
        if author in revisions:
            found.append(f"{author} is stored twice")
        revisions[author] = revision
    for author, revision in told.items():
        if revisions.get(author) != revision:
            found.append(f"{author} was acknowledged as revision {revision}, and is {revisions.get(author)}")
    order = [int(author.split("-")[1]) for author, _ in sorted(stored, key=lambda its: its[1])]
    if order != list(range(1, len(order) + 1)):
        found.append("the edits are not in the order in which they were made")
    if len(order) > len(told) + 1:
        found.append(f"{len(order)} edits are stored, {len(told)} were answered, and one was under way")
    return found
