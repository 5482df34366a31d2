# SPDX-License-Identifier: BSD-3-Clause
"""Reads a recording in the flat layout with exact labels, as a user with numpy would, and feeds it."""
import csv
import struct
import zlib

import numpy as np

import dhpmap


def label_set(folder):
    """The classes of the recording: rows that share a ClassID are objects of a class."""
    labels = {}
    for row in rows_of(folder):
        name = row["Name"].rsplit("_", 1)[0] if row["Name"].rsplit("_", 1)[-1].isdigit() else row["Name"]
        size = {"S": "small", "M": "medium", "L": "large"}[row["Size"]]
        kind = "stuff" if row["PanopticID"] == "0" else "thing"
        labels[int(row["ClassID"])] = dhpmap.Label(int(row["ClassID"]), name, kind, size)
    return list(labels.values())


def rows_of(folder):
    with open(folder / "groundtruth_labels.csv", newline="") as file:
        return [row for row in csv.DictReader(file) if row["Name"] != "unknown"]


def camera_of(folder):
    lines = (folder / "camera.txt").read_text().splitlines()
    numbers = next(line for line in lines if not line.startswith("#")).split()
    return dhpmap.Camera(int(numbers[0]), int(numbers[1]), *map(float, numbers[2:]))


def frames_of(folder):
    """depth_m, rgb, labels, segments, T_map_camera, stamp_ns of each frame, by time."""
    run = folder / "run1"
    class_of = {int(row["InstanceID"]): int(row["ClassID"]) for row in rows_of(folder)}
    for line in (run / "timestamps.csv").read_text().splitlines():
        name, stamp_ns = line.split(",")
        if name == "ImageID":
            continue
        labels = read_png(run / f"{name}_segmentation.png")
        segments = {int(number): class_of[int(number)] for number in np.unique(labels) if int(number) in class_of}
        T_map_camera = np.loadtxt(run / f"{name}_pose.txt").reshape(4, 4)
        colors = (labels[..., np.newaxis] * (37, 91, 151)).astype(np.uint8)  # one an object
        yield read_tiff(run / f"{name}_depth.tiff"), colors, labels, segments, T_map_camera, int(stamp_ns)


def feed_recording(target, folder, session="robot1"):
    with target.feed(session, camera=camera_of(folder), persistent_ids=True) as feed:
        for frame in frames_of(folder):
            feed.rgbd(*frame)
    return feed


def read_tiff(path):
    """Uncompressed 32-bit floats, little-endian, in strips."""
    data = path.read_bytes()
    tags = {}
    (at,) = struct.unpack_from("<I", data, 4)
    for entry in range(struct.unpack_from("<H", data, at)[0]):
        tag, kind, count, value = struct.unpack_from("<HHII", data, at + 2 + 12 * entry)
        size = {3: "H", 4: "I"}[kind] if kind in (3, 4) else "B"
        where = at + 2 + 12 * entry + 8 if count * struct.calcsize(size) <= 4 else value
        tags[tag] = struct.unpack_from(f"<{count}{size}", data, where)
    assert tags.get(259, (1,)) == (1,) and tags[339] == (3,), "wanted uncompressed floats"
    strips = b"".join(data[first:first + size] for first, size in zip(tags[273], tags[279]))
    return np.frombuffer(strips, "<f4").reshape(tags[257][0], tags[256][0])


def read_png(path):
    """Grey of 8 or 16 bits, not interlaced."""
    data = path.read_bytes()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack_from(">IIBB", data, at + 8)
            assert color == 0, "wanted grey"
        elif kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    lines = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, -1)
    pixels = unfiltered(lines[:, 0], lines[:, 1:], depth // 8)
    return pixels.copy() if depth == 8 else pixels.view(">u2").astype(np.uint16)


def unfiltered(filters, lines, step):
    """PNG's prediction taken back."""
    out = np.zeros((len(lines) + 1, lines.shape[1] + step), np.uint8)
    for y, (kind, line) in enumerate(zip(filters, lines), 1):
        if kind in (0, 2):
            out[y, step:] = line + (out[y - 1, step:] if kind == 2 else np.uint8(0))  # which wraps
            continue
        above, row = out[y - 1].tolist(), [0] * (len(line) + step)
        for x, value in enumerate(line.tolist(), step):
            left, up, corner = row[x - step], above[x], above[x - step]
            row[x] = value + (left if kind == 1 else (left + up) // 2 if kind == 3 else paeth(left, up, corner)) & 255
        out[y] = row
    return out[1:, step:]


def paeth(left, up, corner):
    guess = left + up - corner
    return min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
