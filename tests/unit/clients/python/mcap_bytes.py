# SPDX-License-Identifier: BSD-3-Clause
"""MCAP files and messages of ROS 2, made byte by byte: small, and wrong where a test wants it."""
import struct
import zlib

MAGIC = b"\x89MCAP0\r\n"
FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, ATTACHMENT, DATA_END = 0x02, 0x03, 0x04, 0x05, 0x06, 0x09, 0x0F


def text(value):
    return struct.pack("<I", len(value.encode())) + value.encode()


def record(kind, body):
    return struct.pack("<BQ", kind, len(body)) + body


def schema(number, name):
    return record(SCHEMA, struct.pack("<H", number) + text(name) + text("ros2msg") + struct.pack("<I", 0))


def channel(number, topic, schema_number, encoding="cdr"):
    return record(CHANNEL, struct.pack("<HH", number, schema_number) + text(topic) + text(encoding) + bytes(4))


def message(number, data, log_time_ns=0):
    return record(MESSAGE, struct.pack("<HIQQ", number, 0, log_time_ns, log_time_ns) + data)


def chunk(records, compression="", packed=None, size=None, crc=None):
    packed = records if packed is None else packed
    size, crc = len(records) if size is None else size, zlib.crc32(records) if crc is None else crc
    head = struct.pack("<QQQI", 0, 0, size, crc)
    return record(CHUNK, head + text(compression) + struct.pack("<Q", len(packed)) + packed)


def whole(*records):
    """A file without a summary."""
    return MAGIC + record(0x01, text("ros2") + text("")) + b"".join(records) + record(DATA_END, bytes(4)) \
        + record(FOOTER, bytes(20)) + MAGIC


class Cdr:
    """Writes fields: letters of struct, S: a string, a list of pairs (letters, values): a sequence."""

    def __init__(self, order="<"):
        self.order, self.data = order, b""

    def add(self, letters, *values):
        for letter, value in zip(letters, values, strict=True):
            if letter == "S":
                self.add("I", len(value.encode()) + 1).data += value.encode() + b"\0"
            elif letter == "O":
                self.add("I", len(value)).data += bytes(value)
            else:
                size = struct.calcsize(letter)
                self.data += bytes(-len(self.data) % size) + struct.pack(self.order + letter, value)
        return self

    def bytes(self):
        return b"\0" + (b"\1" if self.order == "<" else b"\0") + b"\0\0" + self.data


def header(cdr, stamp_ns, frame_id):
    return cdr.add("iIS", stamp_ns // 1_000_000_000, stamp_ns % 1_000_000_000, frame_id)


def image(stamp_ns, encoding, rows, width, frame_id="camera", order="<", is_bigendian=0):
    """rows: the bytes of each row, with its padding."""
    cdr = header(Cdr(order), stamp_ns, frame_id)
    return cdr.add("IISBIO", len(rows), width, encoding, is_bigendian, len(rows[0]), b"".join(rows)).bytes()


def camera_info(stamp_ns, width, height, d=(), K=None, P=None, binning=0, frame_id="camera"):
    K = K or (50, 0, width / 2, 0, 50, height / 2, 0, 0, 1)
    P = P or (40, 0, width / 2, 0, 0, 40, height / 2, 0, 0, 0, 1, 0)
    cdr = header(Cdr(), stamp_ns, frame_id).add("IIS", height, width, "plumb_bob").add("I" + "d" * len(d), len(d), *d)
    cdr.add("d" * 30, *K, *(1, 0, 0, 0, 1, 0, 0, 0, 1), *P)
    return cdr.add("IIIIIIB", binning, binning, 0, 0, 0, 0, 0).bytes()


def transforms(*links):
    """links: stamp_ns, parent, child, (x, y, z), (x, y, z, w)."""
    cdr = Cdr().add("I", len(links))
    for stamp_ns, parent, child, translation_m, xyzw in links:
        header(cdr, stamp_ns, parent).add("Sddddddd", child, *translation_m, *xyzw)
    return cdr.bytes()


def point_cloud(stamp_ns, fields, step, points, frame_id="lidar", is_bigendian=0):
    """fields: name, offset, datatype; points: the bytes of each."""
    cdr = header(Cdr(), stamp_ns, frame_id).add("III", 1, len(points), len(fields))
    for name, offset, datatype in fields:
        cdr.add("SIBI", name, offset, datatype, 1)
    return cdr.add("BIIOB", is_bigendian, step, step * len(points), b"".join(points), 0).bytes()


class Recording:
    """Topics and messages, written in one go."""

    def __init__(self):
        self.channels, self.records = {}, []

    def add(self, topic, kind, data, log_time_ns):
        if topic not in self.channels:
            number = self.channels[topic] = len(self.channels) + 1
            self.records += [schema(number, kind), channel(number, topic, number)]
        self.records.append(message(self.channels[topic], data, log_time_ns))
        return self

    def write(self, path):
        path.write_bytes(whole(*self.records))
        return path
