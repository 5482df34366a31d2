# SPDX-License-Identifier: BSD-3-Clause
"""MCAP files byte by byte: cut off, damaged, packed, with and without an index."""
import pathlib
import struct
import sys
import tracemalloc
import warnings

import pytest

import dhpmap
import mcap_bytes as made
from dhpmap.mcap import McapWarning, Recording

WALK = pathlib.Path(__file__).parent / "mcap/walk.mcap"
DECLARED = made.schema(1, "std_msgs/msg/String") + made.channel(7, "/said", 1)


def written(tmp_path, data, name="its.mcap"):
    (tmp_path / name).write_bytes(data)
    return tmp_path / name


def said(path):
    return [its.data for its in Recording(path).messages()]


def three(*, packed=lambda records: made.chunk(records)):
    return [packed(DECLARED + made.message(7, b"one")), made.message(7, b"two"), packed(made.message(7, b"three"))]


def test_messages_within_chunks_and_without_come_in_order(tmp_path):
    path = written(tmp_path, made.whole(*three()))
    assert said(path) == [b"one", b"two", b"three"]
    assert Recording(path).topics == (dhpmap.mcap.Topic("/said", "std_msgs/msg/String", "cdr", 3),)


def test_records_of_other_kinds_are_passed_over(tmp_path):
    path = written(tmp_path, made.whole(made.record(made.ATTACHMENT, bytes(99)), DECLARED, made.record(0xEE, b"new"),
                                        made.chunk(made.record(0xEE, b"new") + made.message(7, b"one"))))
    assert said(path) == [b"one"]


@pytest.mark.parametrize("missing", range(1, 200, 7))
def test_a_file_that_was_cut_off_gives_what_is_whole(tmp_path, missing):
    data = made.whole(*three())
    path = written(tmp_path, data[:-missing])
    if missing <= len(made.MAGIC) + 29:  # of the footer: all messages are there, and the record that ends them
        assert said(path) == [b"one", b"two", b"three"]
        return
    with pytest.warns(McapWarning, match="ends within a record at byte .* was cut off"):
        got = said(path)
    last = len(three()[2])
    assert got == [b"one", b"two", b"three"][:2 if missing > len(made.MAGIC) + 29 + 13 else 3][:len(got)]
    assert len(got) >= 2 or missing > len(made.MAGIC) + 29 + 13 + last


def test_the_index_and_the_scan_of_one_file_agree(tmp_path):
    whole = Recording(WALK)
    cut = Recording(written(tmp_path, WALK.read_bytes()[:-9]))  # which takes the index away, but no message
    assert cut.topics == whole.topics
    wanted = {"/panoptic/labels", "/tf_static"}
    scanned = list(cut.messages(wanted))
    assert scanned == list(whole.messages(wanted)) and len(scanned) == 7


def test_chunks_without_a_wanted_topic_are_not_read(tmp_path):
    data = bytearray(WALK.read_bytes())
    middle = len(data) // 2
    data[middle] ^= 0xFF  # within a chunk of images
    damaged = Recording(written(tmp_path, data))
    assert len(list(damaged.messages({"/tf_static"}))) == 1
    with pytest.raises(dhpmap.DataLoss, match="its.mcap has a damaged chunk: its checksum does not hold"):
        list(damaged.messages())


def test_a_damaged_index_is_not_believed(tmp_path):
    head, name, tail = WALK.read_bytes().rpartition(b"/tf_static")  # in the summary, which repeats the topics
    data = head + name.replace(b"c", b"k") + tail
    assert Recording(written(tmp_path, data)).topics == Recording(WALK).topics


@pytest.mark.parametrize("data, message", [
    (b"", "its.mcap is empty"), (b"hello there", "does not begin as an MCAP file"),
    (b"#ROSBAG V2.0\n", "is a bag of ROS 1"), (b"SQLite format 3\0", "ros2 bag convert"),
    (b"\x28\xb5\x2f\xfd....", "zstd -d"), (b"\x89MCAP1\r\n", "version 0")],
    ids=("empty", "text", "ros1", "sqlite", "zstd", "version_1"))
def test_what_is_no_mcap_file_is_told_what_it_is(tmp_path, data, message):
    with pytest.raises(dhpmap.DataLoss, match=message):
        Recording(written(tmp_path, data))


@pytest.mark.parametrize("records, message", [
    ([made.message(7, b"")], "message of channel 7, which is not declared"),
    ([made.record(made.CHANNEL, struct.pack("<HHI", 1, 1, 1 << 30))], "channel record is damaged"),
    ([made.record(made.SCHEMA, b"\1")], "schema record is damaged"),
    ([made.chunk(DECLARED, crc=1)], "checksum does not hold"),
    ([made.chunk(DECLARED, size=3)], "unpacks to other than 3 bytes"),
    ([made.chunk(DECLARED, size=1 << 40)], "at most"),
    ([made.chunk(DECLARED[:-1])], "records reach beyond its end"),
    ([made.chunk(b"\5" + struct.pack("<Q", 1 << 62) + bytes(9))], "records reach beyond its end"),
    ([made.record(made.CHUNK, bytes(28) + made.text("") + struct.pack("<Q", 1 << 40))], "chunk record is damaged"),
    ([made.chunk(DECLARED, "lz4", b"no lz4")], "has a damaged chunk"),
    ([made.chunk(DECLARED, "zstd", b"no zstd")], "has a damaged chunk"),
], ids=("undeclared", "channel", "schema", "checksum", "too_small", "too_large", "cut_record", "long_record",
        "no_chunk", "lz4", "zstd"))
def test_damage_is_an_error_of_its_own(tmp_path, records, message):
    for module in ("lz4.frame", "zstandard"):
        pytest.importorskip(module)
    with pytest.raises(dhpmap.DataLoss, match=message):
        said(written(tmp_path, made.whole(*records)))


def test_any_flipped_byte_is_read_or_refused_but_never_worse(tmp_path):
    data = made.whole(*three())
    for at in range(len(data)):
        damaged = bytearray(data)
        damaged[at] ^= 0xFF
        path = written(tmp_path, damaged)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", McapWarning)  # any other is an error
            try:
                assert len(said(path)) <= 3
            except dhpmap.Error:
                pass


def test_a_record_cannot_claim_more_than_the_file_has(tmp_path):
    path = written(tmp_path, made.MAGIC + struct.pack("<BQ", made.MESSAGE, 1 << 63))
    with pytest.warns(McapWarning, match="cut off"):
        assert said(path) == []


@pytest.mark.parametrize("compression, module", [("lz4", "lz4.frame"), ("zstd", "zstandard")], ids=("lz4", "zstd"))
def test_packed_chunks_are_unpacked(tmp_path, compression, module):
    its = pytest.importorskip(module)
    pack = its.compress if compression == "lz4" else its.ZstdCompressor().compress
    path = written(tmp_path, made.whole(*three(packed=lambda records: made.chunk(records, compression, pack(records)))))
    assert said(path) == [b"one", b"two", b"three"]


@pytest.mark.parametrize("compression, module", [("lz4", "lz4.frame"), ("zstd", "zstandard")], ids=("lz4", "zstd"))
def test_a_chunk_never_unpacks_to_more_than_it_says(tmp_path, compression, module):
    its = pytest.importorskip(module)
    bomb = bytes(50_000_000)
    pack = its.compress if compression == "lz4" else its.ZstdCompressor().compress
    path = written(tmp_path, made.whole(made.chunk(b"12345", compression, pack(bomb))))
    del bomb
    tracemalloc.start()
    with pytest.raises(dhpmap.DataLoss, match="unpacks to other than 5 bytes"):
        said(path)
    most_bytes = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most_bytes < 5_000_000


@pytest.mark.parametrize("compression, module, install", [
    ("lz4", "lz4.frame", "install python3-lz4"), ("zstd", "zstandard", "install python3-zstandard"),
    ("brotli", "none", "none, lz4 and zstd can be read")], ids=("lz4", "zstd", "brotli"))
def test_what_cannot_be_unpacked_says_what_to_install(tmp_path, monkeypatch, compression, module, install):
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(dhpmap.Unimplemented, match=install):
        said(written(tmp_path, made.whole(made.chunk(DECLARED, compression))))


def test_a_folder_is_read_in_the_order_of_its_numbers(tmp_path):
    for number in (10, 9, 1):
        written(tmp_path, made.whole(DECLARED, made.message(7, b"%d" % number)), f"walk_{number}.mcap")
    assert said(tmp_path) == [b"1", b"9", b"10"]
    assert Recording(tmp_path).topics[0].num_messages == 3


def test_a_missing_recording_is_not_found(tmp_path):
    with pytest.raises(dhpmap.NotFound, match="there is no recording"):
        Recording(tmp_path / "none.mcap")
    with pytest.raises(dhpmap.NotFound, match="has no file"):
        Recording(tmp_path)
