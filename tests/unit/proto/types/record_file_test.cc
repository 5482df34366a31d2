// SPDX-License-Identifier: BSD-3-Clause
#include "proto/types/record_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

v1::Record FrameOf(int i) {
  v1::Record record;
  record.set_time_ns(i);
  record.mutable_frame()->set_session("robot");
  record.mutable_frame()->set_request(std::string(static_cast<std::size_t>(100 * i), static_cast<char>('a' + i)));
  return record;
}

class RecordFileTest : public ::testing::Test {
 protected:
  /// A start, then frames 0 to `num_frames` - 1. Returns where each record ends.
  std::vector<std::uintmax_t> Write(int num_frames) {
    std::vector<std::uintmax_t> ends;
    auto writer = std::move(RecordWriter::Create(path())).value();
    v1::Record start;
    start.mutable_start()->mutable_map()->set_name("maps/room");
    EXPECT_TRUE(writer.Append(start).ok());
    ends.push_back(fs::file_size(path()));
    for (int i = 0; i < num_frames; ++i) {
      const auto size = BytesInFile(FrameOf(i));
      EXPECT_TRUE(writer.Append(FrameOf(i)).ok());
      EXPECT_EQ(fs::file_size(path()), ends.back() + size);
      ends.push_back(ends.back() + size);
    }
    return ends;
  }
  /// How many frames can be read; all of them are as they were written.
  int Read(bool& is_torn) {
    auto reader = std::move(RecordReader::Open(path())).value();
    EXPECT_EQ(reader.start().map().name(), "maps/room");
    int i = 0;
    for (auto record = reader.Next().value(); record; record = reader.Next().value(), ++i) {
      EXPECT_EQ(record->SerializeAsString(), FrameOf(i).SerializeAsString());
    }
    is_torn = reader.is_torn();
    EXPECT_FALSE(reader.Next().value().has_value()) << "the end stays the end";
    return i;
  }
  [[nodiscard]] std::string path() const { return (dir_.path() / "room.dhprec").string(); }

 private:
  testing::TempDir dir_;
};

TEST_F(RecordFileTest, WhatIsWrittenIsRead) {
  Write(5);
  bool is_torn = true;
  EXPECT_EQ(Read(is_torn), 5);
  EXPECT_FALSE(is_torn);
  EXPECT_EQ(RecordWriter::Create(path()).status().code(), StatusCode::kAlreadyExists) << "no record is written over";
}

TEST_F(RecordFileTest, CutAnywhereItEndsWithTheLastWholeRecord) {
  const std::vector<std::uintmax_t> ends = Write(3);
  for (std::uintmax_t size = ends.back(); size >= ends.front(); --size) {
    fs::resize_file(path(), size);
    int num_whole = -1;
    for (const std::uintmax_t end : ends) num_whole += end <= size;
    bool is_torn = false;
    ASSERT_EQ(Read(is_torn), num_whole) << size;
    ASSERT_EQ(is_torn, std::find(ends.begin(), ends.end(), size) == ends.end()) << size;
  }
  for (std::uintmax_t size = 0; size < ends.front(); size += 3) {
    fs::resize_file(path(), size);
    EXPECT_EQ(RecordReader::Open(path()).status().code(), StatusCode::kDataLoss);
  }
}

TEST_F(RecordFileTest, AFlippedBitEndsItBeforeThatRecord) {
  const std::vector<std::uintmax_t> ends = Write(3);
  for (std::uintmax_t at = ends[1]; at < ends[2]; ++at) {
    std::fstream file(path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(at));
    const int byte = file.get();
    file.seekp(static_cast<std::streamoff>(at));
    file.put(static_cast<char>(byte ^ 4));
    file.close();
    bool is_torn = false;
    ASSERT_EQ(Read(is_torn), 1) << at;
    ASSERT_TRUE(is_torn);
    std::fstream mended(path(), std::ios::in | std::ios::out | std::ios::binary);
    mended.seekp(static_cast<std::streamoff>(at));
    mended.put(static_cast<char>(byte));
  }
}

TEST_F(RecordFileTest, WhatIsNoRecordIsToldSo) {
  EXPECT_EQ(RecordReader::Open(path()).status().code(), StatusCode::kNotFound);
  std::ofstream(path()) << "no record at all, but some text";
  EXPECT_EQ(RecordReader::Open(path()).status().code(), StatusCode::kDataLoss);
}

}  // namespace
}  // namespace dhpmap
