// SPDX-License-Identifier: BSD-3-Clause
// VerifyMap through the door: of a map that is mapped, and of one that was damaged on disk.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/integration/test_server.h"

namespace dhpmap::testing {
namespace {

class VerifyMapTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string Path() const { return (folder_.path() / "maps.db").string(); }

  static grpc::Status Verify(TestServer& server, bool repair, v1::VerifyMapResponse& response) {
    grpc::ClientContext context;
    v1::VerifyMapRequest request;
    request.set_name("maps/room");
    request.set_repair(repair);
    return server.maps->VerifyMap(&context, request, &response);
  }

  /// Flips a byte of the first blob of the file.
  void DamageBlobsOfLabels() {
    std::fstream file(Path(), std::ios::in | std::ios::out | std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    const std::string labels("\x22\x01\x00\x28\xB5\x2F\xFD", 7);  // of a tile, as a frame of zstd
    std::size_t found = bytes.find(labels);
    ASSERT_NE(found, std::string::npos);
    for (; found != std::string::npos; found = bytes.find(labels, found + 1)) {  // those that are dead, too
      file.seekp(static_cast<std::streamoff>(found + 23));
      file.put(static_cast<char>(bytes[found + 23] ^ 0x20));
    }
  }

  TempDir folder_;
};

TEST_F(VerifyMapTest, AMapThatIsMappedIsWholeAndIsNotRepaired) {
  const auto store = std::move(OpenSqliteStore(Path())).value();
  TestServer server(*store);
  grpc::ClientContext create;
  v1::CreateMapResponse made;
  ASSERT_TRUE(server.maps->CreateMap(&create, CreateRequest("room"), &made).ok());
  ASSERT_TRUE(Feed(server, "room", 0, 4).status.ok());
  for (const bool repair : {false, true}) {
    v1::VerifyMapResponse report;
    const grpc::Status status = Verify(server, repair, report);
    ASSERT_TRUE(status.ok()) << status.error_message();
    EXPECT_EQ(report.num_faults(), 0) << report.DebugString();
    EXPECT_FALSE(report.repaired());
    EXPECT_GT(report.num_submaps(), 2);
    EXPECT_GT(report.num_tiles(), 4);
    EXPECT_GT(report.num_blocks(), report.num_tiles());
  }
  grpc::ClientContext context;
  v1::VerifyMapRequest request;
  request.set_name("maps/other");
  v1::VerifyMapResponse report;
  EXPECT_EQ(server.maps->VerifyMap(&context, request, &report).error_code(), grpc::NOT_FOUND);
}

TEST_F(VerifyMapTest, ADamagedMapIsServedAgainAfterARepair) {
  std::int64_t revision = 0;
  {
    const auto store = std::move(OpenSqliteStore(Path())).value();
    TestServer server(*store);
    grpc::ClientContext create;
    v1::CreateMapResponse made;
    ASSERT_TRUE(server.maps->CreateMap(&create, CreateRequest("room"), &made).ok());
    ASSERT_TRUE(Feed(server, "room", 0, 4).status.ok());
    ASSERT_TRUE(server.Stop().ok());
  }
  DamageBlobsOfLabels();
  const auto store = std::move(OpenSqliteStore(Path())).value();
  TestServer server(*store);
  const auto list = [&server] {
    grpc::ClientContext context;
    v1::ListSubmapsRequest request;
    request.set_parent("maps/room");
    v1::ListSubmapsResponse response;
    return server.submaps->ListSubmaps(&context, request, &response);
  };
  EXPECT_EQ(list().error_code(), grpc::DATA_LOSS);
  v1::VerifyMapResponse report;
  ASSERT_TRUE(Verify(server, false, report).ok());
  ASSERT_GE(report.num_faults(), 1);
  EXPECT_EQ(report.faults(0).kind(), v1::VerifyMapResponse::Fault::BLOB) << report.DebugString();
  EXPECT_NE(report.faults(0).place().find(" tile ("), std::string::npos);
  revision = report.revision();

  ASSERT_TRUE(Verify(server, true, report).ok());
  EXPECT_TRUE(report.repaired());
  EXPECT_EQ(report.revision(), revision + 1);
  EXPECT_TRUE(list().ok());
  ASSERT_TRUE(Feed(server, "room", 4, 6).status.ok()) << "mapping goes on";
  v1::VerifyMapResponse after;
  ASSERT_TRUE(Verify(server, false, after).ok());
  EXPECT_EQ(after.num_faults(), 0) << after.DebugString();
}

}  // namespace
}  // namespace dhpmap::testing
