#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""read_format.py DATABASE MAP: what a map holds, block by block, read from the file by storage/FORMAT.md alone.

An independent reader: it shares nothing with the server but that page. Exits with 77 where there is no libzstd, with 1
where the file is not as the page says. Lines as in tests/unit/storage/map_text.cc."""
import ctypes
import ctypes.util
import sqlite3
import struct
import sys

MASK64 = (1 << 64) - 1
MASK_BYTES = 64


class Damaged(Exception):
    pass


def check(good, what):
    if not good:
        raise Damaged(what)


# CRC-32C.

def make_table():
    table = []
    for byte in range(256):
        for _ in range(8):
            byte = (byte >> 1) ^ (0x82F63B78 if byte & 1 else 0)
        table.append(byte)
    return table


TABLE = make_table()


def crc32c(data):
    crc = 0xFFFFFFFF
    for byte in data:
        crc = (crc >> 8) ^ TABLE[(crc ^ byte) & 0xFF]
    return crc ^ 0xFFFFFFFF


# zstd.

def load_zstd():
    try:
        library = ctypes.CDLL("libzstd.so.1")
    except OSError:
        print("there is no libzstd.so.1", file=sys.stderr)
        sys.exit(77)
    library.ZSTD_getFrameContentSize.restype = ctypes.c_ulonglong
    library.ZSTD_getFrameContentSize.argtypes = [ctypes.c_char_p, ctypes.c_size_t]
    library.ZSTD_decompress.restype = ctypes.c_size_t
    library.ZSTD_decompress.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]
    return library


ZSTD = load_zstd()


def decompress(packed):
    size = ZSTD.ZSTD_getFrameContentSize(packed, len(packed))
    check(size <= 512 * 1024 + 64 * len(packed), "zstd frame says an implausible length")
    out = ctypes.create_string_buffer(max(1, size))
    check(ZSTD.ZSTD_decompress(out, size, packed, len(packed)) == size, "zstd frame does not decompress")
    return out.raw[:size]


class Reader:
    """Takes little-endian values off the front of some bytes."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def bytes(self, size):
        check(self.at + size <= len(self.data), "too short")
        self.at += size
        return self.data[self.at - size:self.at]

    def one(self, code):
        return struct.unpack("<" + code, self.bytes(struct.calcsize("<" + code)))[0]

    def varint(self):
        value, shift = 0, 0
        while True:
            byte = self.one("B")
            value |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                return value

    def at_end(self):
        return self.at == len(self.data)


def unseal(blob, index):
    """Kind, plain part, packable part."""
    check(crc32c(struct.pack("<3i", *index) + blob[:-4]) == struct.unpack("<I", blob[-4:])[0], "wrong checksum")
    reader = Reader(blob[:-4])
    kind, packing = reader.one("B"), reader.one("B")
    plain = reader.bytes(reader.varint())
    rest = reader.bytes(len(reader.data) - reader.at)
    check(packing in (0, 1), "unknown packing")
    return kind, Reader(plain), Reader(decompress(rest) if packing == 1 else rest)


# Voxels and their predictions.

def masked(mask):
    return [v for v in range(512) if mask[v // 8] >> (v % 8) & 1]


def unzigzag(code):
    return (code >> 1) ^ -(code & 1)


class Walk:
    """Which voxels are written before each, as its neighbours below."""

    def __init__(self, voxels):
        written, previous, self.sites = set(), None, []
        for v in voxels:
            x, y, z = v % 8, v // 8 % 8, v // 64

            def below(dx, dy, dz):
                if x < dx or y < dy or z < dz:
                    return None
                neighbour = v - dx - 8 * dy - 64 * dz
                return neighbour if neighbour in written else None
            lower = [below(1, 0, 0), below(0, 1, 0), below(0, 0, 1)]
            near = next((n for n in lower if n is not None), previous)
            faces = []
            for a, b, corner in ((0, 1, (1, 1, 0)), (0, 2, (1, 0, 1)), (1, 2, (0, 1, 1))):
                diagonal = below(*corner)
                if None not in (lower[a], lower[b], diagonal):
                    faces.append((lower[a], lower[b], diagonal))
            self.sites.append((v, near, faces))
            written.add(v)
            previous = v


def near_values(walk, differences, bits, signed):
    values = {}
    for (v, near, _), difference in zip(walk.sites, differences):
        value = ((values[near] if near is not None else 0) + difference) & ((1 << bits) - 1)
        if signed and value >> (bits - 1):
            value -= 1 << bits
        values[v] = value
    return values


def smooth_values(walk, differences):
    values = {}
    for (v, near, faces), difference in zip(walk.sites, differences):
        if faces:
            total = sum(values[a] + values[b] - values[c] for a, b, c in faces)
            predicted = abs(total) // len(faces) * (1 if total >= 0 else -1)
        else:
            predicted = values[near] if near is not None else 0
        values[v] = (predicted + difference) & 0xFF
    return values


def joined(planes, first, count, begin, size):
    """The zigzag differences that `count` planes from `first` make, of the voxels from `begin`."""
    out = []
    for i in range(begin, begin + size):
        out.append(unzigzag(sum(planes[first + k][i] << (8 * k) for k in range(count))))
    return out


def as_f32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


def cells_in(cells):
    return [c for c in range(64) if cells >> c & 1]


# Layers. Each gives {cell: block}.

def read_tsdf(plain, packable, of_tile):
    cells, exact = (packable.one("Q"), packable.one("Q")) if of_tile else (1, 0)
    step_m = packable.one("f")
    if not of_tile and step_m == 0:
        exact = 1
    in_packable = packable.one("B")
    walks = {c: Walk(masked(packable.bytes(MASK_BYTES))) for c in cells_in(cells)}
    planes = []
    for p in range(8):
        size = sum(len(walks[c].sites) for c in walks if p >= 2 or not exact >> c & 1)
        planes.append((packable if in_packable >> p & 1 else plain).bytes(size))
    blocks, begin, begin_rounded = {}, 0, 0
    for c, walk in walks.items():
        size = len(walk.sites)
        codes = near_values(walk, joined(planes, 2, 3, begin, size), 24, False)
        weights = {v: struct.unpack("<f", struct.pack("<I", code << 7))[0] for v, code in codes.items()}
        green, red, blue = (smooth_values(walk, joined(planes, p, 1, begin, size)) for p in (5, 6, 7))
        if exact >> c & 1:
            distances = {v: plain.one("f") for v, _, _ in walk.sites}
        else:
            steps = near_values(walk, joined(planes, 0, 2, begin_rounded, size), 16, True)
            distances = {v: as_f32(n * step_m) for v, n in steps.items()}
            begin_rounded += size
        begin += size
        blocks[c] = [(v, distances[v], weights[v], red[v], green[v], blue[v]) for v, _, _ in walk.sites]
    check(plain.at_end() and packable.at_end(), "longer than its voxels need")
    return blocks


def read_counts(reader, number, counts, last):
    for _ in range(number):
        last += reader.varint()
        counts.append((last, reader.varint()))
    return counts


def read_labels(plain, packable, of_tile):
    cells, concluded = (packable.one("Q"), packable.one("Q")) if of_tile else (1, 0)
    walks = {c: Walk(masked(packable.bytes(MASK_BYTES))) for c in cells_in(cells)}
    for _ in cells_in(concluded):
        check(any(packable.bytes(MASK_BYTES)), "nothing concluded of a block")
    size = sum(len(walk.sites) for walk in walks.values())
    planes = [packable.bytes(size) for _ in range(5)]
    blocks, begin = {}, 0
    for c, walk in walks.items():
        size = len(walk.sites)
        first = near_values(walk, joined(planes, 1, 2, begin, size), 16, False)
        count = near_values(walk, joined(planes, 3, 2, begin, size), 16, False)
        blocks[c] = []
        for i, (v, _, _) in enumerate(walk.sites):
            form = planes[0][begin + i]
            if form == 0x7F:
                classes = read_counts(packable, packable.varint(), [], 0)
                instances = read_counts(packable, packable.varint(), [], 0)
            else:
                classes = read_counts(packable, (form & 0x7F) - 1, [(first[v], count[v])], first[v])
                if form & 0x80:
                    instances = read_counts(packable, packable.varint(), [], 0)
                else:
                    instances = [(0, sum(n for _, n in classes))]
            blocks[c].append((v, classes, instances))
        begin += size
    check(plain.at_end() and packable.at_end(), "longer than its voxels need")
    return blocks


def read_gone(plain, packable, of_tile):
    blocks = {}
    for c in cells_in(packable.one("Q") if of_tile else 1):
        stamp_ns, position = plain.one("q"), [plain.one("d") for _ in range(3)]
        bits = [packable.one("Q") for _ in range(16)]
        counts = [(bits[v // 64] >> v % 64 & 1) + 2 * (bits[8 + v // 64] >> v % 64 & 1) for v in range(512)]
        blocks[c] = (counts, position, stamp_ns)
    check(plain.at_end() and packable.at_end(), "longer than its voxels need")
    return blocks


LAYERS = {1: read_tsdf, 2: read_labels, 4: read_gone}


def block_index(tile, cell):
    return tuple(4 * t + (cell >> 2 * axis & 3) for axis, t in enumerate(tile))


def read_tile(layer, tile, blob):
    kind, plain, packable = unseal(blob, tile)
    check(kind >> 4 == layer, "a blob of another layer")
    if kind & 0xF == 2:
        return LAYERS[layer](plain, packable, True)
    check(kind & 0xF == 0xF, "a kind that is not in FORMAT.md")
    blocks = {}
    for cell in cells_in(plain.one("Q")):
        inner, inner_plain, inner_packable = unseal(plain.bytes(plain.varint()), block_index(tile, cell))
        check(inner == layer << 4 | 1, "a kind that is not in FORMAT.md")
        blocks[cell] = LAYERS[layer](inner_plain, inner_packable, False)[0]
    check(plain.at_end(), "a bundle is longer than its blocks")
    return blocks


def read_free(layer, tile, blob):
    """Number of voxels of a tile of the map's own layers."""
    kind, plain, packable = unseal(blob, tile)
    check(kind == layer << 4 | 1, "a kind that is not in FORMAT.md")
    plain.one("q")
    full, mixed = packable.one("Q"), packable.one("Q")
    voxels = 512 * bin(full).count("1")
    for _ in cells_in(mixed):
        voxels += sum(bin(packable.one("Q")).count("1") for _ in range(8))
    check(plain.at_end() and packable.at_end(), "longer than its voxels need")
    return voxels


# Rows.

def mix(word):
    word = ((word ^ word >> 30) * 0xBF58476D1CE4E5B9) & MASK64
    word = ((word ^ word >> 27) * 0x94D049BB133111EB) & MASK64
    return word ^ word >> 31


def hash_of(row):
    value = 0
    for part in row:
        value = mix((value + 0x9E3779B97F4A7C15 + part) & MASK64)
    return value


def tiles_of(database, owner, tiles_sum):
    schema = database.execute("PRAGMA user_version").fetchone()[0]
    rows = database.execute("SELECT x, y, z, layer, blob_key, num_blocks, %s, %s, blob FROM tiles JOIN tile_blobs"
                            " USING (blob_key) WHERE owner_key = ? ORDER BY x, y, z, layer"
                            % ("cells" if schema >= 11 else "0", "extent" if schema >= 13 else "0"),
                            (owner,)).fetchall()
    total = sum(hash_of(row[:5]) for row in rows) & MASK64
    check(tiles_sum is None or total == tiles_sum & MASK64, "tiles_sum does not match the rows")
    return rows


def text_of_tsdf(block):
    data = b"".join(struct.pack("<IffBBB", *voxel) for voxel in block)
    return "    tsdf %d voxels %08x" % (len(block), crc32c(data))


def varint_bytes(value):
    out = b""
    while value >= 0x80:
        out += bytes([value & 0x7F | 0x80])
        value >>= 7
    return out + bytes([value])


def text_of_labels(block):
    data = b""
    for v, classes, instances in block:
        text = "classes" + "".join(" %d:%d" % entry for entry in sorted(classes))
        text += " instances" + "".join(" %d:%d" % entry for entry in sorted(instances))
        data += struct.pack("<I", v) + varint_bytes(len(text)) + text.encode()
    return "    labels %d voxels %08x" % (len(block), crc32c(data))


def text_of_gone(block):
    counts, position, stamp_ns = block
    return "    gone %d voxels %08x from %.17g %.17g %.17g at %d" % (
        counts.count(3), crc32c(bytes(counts)), *position, stamp_ns)


TEXTS = {1: text_of_tsdf, 2: text_of_labels, 4: text_of_gone}


def extent_of(blocks):
    """Of the voxels of a TSDF tile, as column extent has it."""
    places = [[8 * (cell >> 2 * axis & 3) + (voxel[0] >> 3 * axis & 7) for axis in range(3)]
              for cell, block in blocks.items() for voxel in block]
    code = 1 << 42
    for axis, along in enumerate(zip(*places)):
        code |= min(along) << 14 * axis | (max(along) + 1) << 14 * axis + 7
    return code


def print_submap(database, row):
    submap_key, submap_id, version, tiles_sum, *counts = row
    tiles, num_blocks = {}, {1: 0, 2: 0, 4: 0}
    rows = tiles_of(database, submap_key, tiles_sum if version >= 3 else None)
    for x, y, z, layer, _, num, cells, extent, blob in rows:
        blocks = read_tile(layer, (x, y, z), blob)
        check(len(blocks) == num, "num_blocks does not match the blob")
        check(cells == 0 or cells & MASK64 == sum(1 << cell for cell in blocks), "cells do not match the blob")
        check(extent == 0 or layer == 1 and extent == extent_of(blocks), "the extent does not match the blob")
        num_blocks[layer] += num
        for cell, block in blocks.items():
            tiles.setdefault((x, y, z), {}).setdefault(cell, {})[layer] = block
    check(list(num_blocks.values()) == counts, "a submap has not as many blocks as its row says")
    print("submap %d" % submap_id)
    ordered = sorted(tiles.items(), key=lambda tile: min(block_index(tile[0], cell) for cell in tile[1]))
    for tile, cells in ordered:
        for cell in sorted(cells):
            print("  block %d %d %d" % block_index(tile, cell))
            for layer in sorted(cells[cell]):
                print(TEXTS[layer](cells[cell][layer]))


def print_map(database, name):
    check(database.execute("PRAGMA application_id").fetchone()[0] == 0x6468704D, "another application's file")
    map_key, version, tiles_sum, num_tiles = database.execute(
        "SELECT map_key, checksum_version, tiles_sum, num_tiles FROM maps WHERE name = ?", (name,)).fetchone()
    submaps = database.execute(
        "SELECT submap_key, submap_id, checksum_version, tiles_sum, num_tsdf_blocks, num_label_blocks, num_gone_blocks "
        "FROM submaps WHERE map_key = ? ORDER BY submap_id", (map_key,)).fetchall()
    for row in submaps:
        print_submap(database, row)
    rows = tiles_of(database, -map_key, tiles_sum if version >= 6 else None)
    check(len(rows) == num_tiles, "a map has not as many tiles as its row says")
    voxels = {3: 0, 5: 0}
    for x, y, z, layer, _, _, cells, extent, blob in rows:
        check(cells == 0 and extent == 0, "a layer of a map has cells")
        voxels[layer] += read_free(layer, (x, y, z), blob)
    print("free %d vacated %d" % (voxels[3], voxels[5]))


def main():
    database = sqlite3.connect("file:%s?mode=ro" % sys.argv[1], uri=True)
    try:
        print_map(database, sys.argv[2])
    except Damaged as why:
        print("not as FORMAT.md says: %s" % why, file=sys.stderr)
        sys.exit(1)


main()
