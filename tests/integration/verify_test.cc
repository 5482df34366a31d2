// SPDX-License-Identifier: BSD-3-Clause
// VerifyMap through the door: for a map in use, and for one that was damaged on disk.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "storage/sqlite_store.h"
#include "tests/integration/test_server.h"

namespace dhpmap::testing {
namespace {

class VerifyMapTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string Path() const { return (folder_.path() / "maps.db").string(); }

  static Answer<v1::VerifyMapResponse> Verify(TestServer& server, bool repair) {
    auto request = About<v1::VerifyMapRequest>("maps/room");
    request.set_repair(repair);
    return server.Call(&MapStub::VerifyMap, request);
  }

  /// Flips a byte of the first blob of the file.
  void DamageBlobsOfLabels() {
    std::fstream file(Path(), std::ios::in | std::ios::out | std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    const std::string labels("\x22\x01\x00\x28\xB5\x2F\xFD", 7);  // of a tile, as a frame of zstd
    std::size_t found = bytes.find(labels);
    ASSERT_NE(found, std::string::npos);
    for (; found != std::string::npos; found = bytes.find(labels, found + 1)) {  // includes unreferenced ones
      file.seekp(static_cast<std::streamoff>(found + 23));
      file.put(static_cast<char>(bytes[found + 23] ^ 0x20));
    }
  }

  TempDir folder_;
};

TEST_F(VerifyMapTest, AnIntactMapIsNotRepaired) {
  const auto store = std::move(OpenSqliteStore(Path())).value();
  TestServer server(*store);
  ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
  ASSERT_OK(Feed(server, "room", 0, 4));
  for (const bool repair : {false, true}) {
    ASSERT_OK_AND_ASSIGN(const auto report, Verify(server, repair));
    EXPECT_EQ(report.num_faults(), 0) << report.DebugString();
    EXPECT_FALSE(report.repaired());
    EXPECT_GT(report.num_submaps(), 2);
    EXPECT_GT(report.num_tiles(), 4);
    EXPECT_GT(report.num_blocks(), report.num_tiles());
  }
  EXPECT_EQ(server.Call(&MapStub::VerifyMap, "maps/other").code(), grpc::NOT_FOUND);
}

TEST_F(VerifyMapTest, ADamagedMapIsServedAgainAfterARepair) {
  {
    const auto store = std::move(OpenSqliteStore(Path())).value();
    TestServer server(*store);
    ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
    ASSERT_OK(Feed(server, "room", 0, 4));
    ASSERT_OK(server.Stop());
  }
  DamageBlobsOfLabels();
  const auto store = std::move(OpenSqliteStore(Path())).value();
  TestServer server(*store);
  const auto list = [&server] { return server.Call(&SubmapStub::ListSubmaps, "maps/room").status(); };
  EXPECT_EQ(list().error_code(), grpc::DATA_LOSS);
  ASSERT_OK_AND_ASSIGN(auto report, Verify(server, false));
  ASSERT_GE(report.num_faults(), 1);
  EXPECT_EQ(report.faults(0).kind(), v1::VerifyMapResponse::Fault::BLOB) << report.DebugString();
  EXPECT_NE(report.faults(0).location().find(" tile ("), std::string::npos);
  const std::int64_t revision = report.revision();

  ASSERT_OK_AND_ASSIGN(report, Verify(server, true));
  EXPECT_TRUE(report.repaired());
  EXPECT_EQ(report.revision(), revision + 1);
  EXPECT_OK(list());
  ASSERT_OK(Feed(server, "room", 4, 6)) << "mapping goes on";
  ASSERT_OK_AND_ASSIGN(const auto after, Verify(server, false));
  EXPECT_EQ(after.num_faults(), 0) << after.DebugString();
}

}  // namespace
}  // namespace dhpmap::testing
