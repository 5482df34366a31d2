// SPDX-License-Identifier: BSD-3-Clause
// What the tests' client returns for a call, and the messages of failed assertions.
#include "tests/support/client.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/integration/test_server.h"

namespace dhpmap::testing {
namespace {

TEST(IsOk, DescribesTheErrorOfEachKindOfStatus) {
  EXPECT_TRUE(IsOk(Status::Ok()));
  EXPECT_TRUE(IsOk(Result<int>(3)));
  EXPECT_TRUE(IsOk(FeedResult()));
  const grpc::Status status(grpc::NOT_FOUND, "no such room");
  const Answer<v1::GetMapResponse> answer(status, {});
  for (const ::testing::AssertionResult& refused :
       {IsOk(NotFound("no such room")), IsOk(Result<int>(NotFound("no such room"))), IsOk(status), IsOk(answer),
        IsOk(FeedResult{.acks = {}, .status = status})}) {
    EXPECT_FALSE(refused);
    EXPECT_NE(std::string(refused.message()).find("no such room"), std::string::npos) << refused.message();
  }
}

TEST(Client, ReturnsTheStatusAndFailsATestThatReadsAMissingValue) {
  const auto store = MakeMemoryStore();
  TestServer server(*store);
  ASSERT_OK_AND_ASSIGN(const auto made, server.Call(&MapStub::CreateMap, CreateRequest("room")));
  EXPECT_EQ(server.Call(&MapStub::GetMap, "maps/room").value().map().name(), made.map().name());
  const auto refused = server.Call(&MapStub::GetMap, "maps/nowhere");
  EXPECT_EQ(refused.code(), grpc::NOT_FOUND);
  EXPECT_EQ(refused.reason(), "MAP_NOT_FOUND");
  EXPECT_FALSE(refused->has_map());
  EXPECT_NONFATAL_FAILURE((void)server.Call(&MapStub::GetMap, "maps/nowhere").value(), "nowhere");
  const auto mesh = server.Call(&SubmapStub::GetSubmapMesh, "maps/nowhere");
  EXPECT_EQ(mesh.reason(), "MAP_NOT_FOUND");
  EXPECT_TRUE(mesh->empty());
}

}  // namespace
}  // namespace dhpmap::testing
