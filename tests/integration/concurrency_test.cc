// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"

namespace dhpmap::testing {
namespace {

TEST(Concurrency, QueriesAndEditsDuringMappingSeeCompleteStatesOfRisingRevision) {
  const auto store = MakeMemoryStore();
  TestServer server(*store, {.publish = {.frames = 2}, .commit = {.frames = 3}});
  ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));

  std::atomic<bool> is_mapping = true;
  std::atomic<int> num_queries = 0, num_edits = 0;
  const auto query = [&] {
    std::int64_t revision = 0;
    while (is_mapping) {
      ASSERT_OK_AND_ASSIGN(const auto response, server.Call(&QueryStub::QueryPoints, TestQuery("room")));
      ASSERT_GE(response.revision(), revision);
      revision = response.revision();
      ++num_queries;
    }
  };
  const auto edit = [&] {
    while (is_mapping) {
      v1::CloneSubmapRequest request;
      request.set_name("maps/room/submaps/1");
      request.mutable_map_from_submap()->mutable_translation_m()->set_z(10);
      const auto cloned = server.Call(&SubmapStub::CloneSubmap, request);
      if (!cloned.ok()) continue;  // not mapped yet
      ASSERT_OK_AND_ASSIGN(const auto deleted, server.Call(&SubmapStub::DeleteSubmap, cloned->submap().name()));
      ASSERT_GT(deleted.revision(), cloned->revision());
      ++num_edits;
    }
  };
  std::vector<std::thread> threads;
  threads.emplace_back(query);
  threads.emplace_back(query);
  threads.emplace_back(edit);
  int num_frames = 0;
  const auto feed = [&](int count) {
    const FeedResult fed = Feed(server, "room", num_frames, num_frames + count);
    EXPECT_OK(fed);
    EXPECT_EQ(fed.acks.size(), static_cast<std::size_t>(count));
    num_frames += count;
  };
  feed(24);
  EXPECT_TRUE(Eventually([&] { return num_queries > 2 && num_edits > 0 ? true : (feed(1), false); }));
  is_mapping = false;
  for (std::thread& thread : threads) thread.join();

  EXPECT_OK(server.Stop());
  EXPECT_EQ((*store->LoadMap("room"))->submaps().size(), 4u);
}

TEST(Concurrency, ManyMapsAreFedAtOnceAndDeletedWhileTheyAreQueried) {
  const auto store = MakeMemoryStore();
  TestServer server(*store);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&server, t] {
      const std::string name = "room" + std::to_string(t);
      ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest(name)));
      ASSERT_OK(Feed(server, name, 0, 3));
      std::thread reader([&server, name] {
        grpc::StatusCode code = grpc::OK;
        while (code == grpc::OK) {
          code = server.Call(&QueryStub::QueryPoints, TestQuery(name)).code();
        }
        EXPECT_EQ(code, grpc::NOT_FOUND);
      });
      EXPECT_OK(server.Call(&MapStub::DeleteMap, "maps/" + name));
      reader.join();
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(store->ListMaps()->empty());
}

}  // namespace
}  // namespace dhpmap::testing
