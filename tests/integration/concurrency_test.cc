// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"

namespace dhpmap::testing {
namespace {

TEST(Concurrency, QueriesAndEditsDuringMappingSeeWholeStatesOfRisingRevision) {
  const auto store = MakeMemoryStore();
  TestServer server(*store, {.publish_frames = 2, .commit_frames = 3});
  grpc::ClientContext create;
  v1::CreateMapResponse created;
  ASSERT_TRUE(server.maps->CreateMap(&create, CreateRequest("room"), &created).ok());

  std::atomic<bool> is_mapping = true;
  std::atomic<int> num_queries = 0, num_edits = 0;
  const auto query = [&] {
    std::int64_t revision = 0;
    while (is_mapping) {
      v1::QueryPointsResponse response;
      grpc::ClientContext context;
      ASSERT_TRUE(server.queries->QueryPoints(&context, TestQuery("room"), &response).ok());
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
      v1::CloneSubmapResponse cloned;
      grpc::ClientContext clone;
      if (!server.submaps->CloneSubmap(&clone, request, &cloned).ok()) continue;  // not mapped yet
      v1::DeleteSubmapRequest deletion;
      deletion.set_name(cloned.submap().name());
      v1::DeleteSubmapResponse deleted;
      grpc::ClientContext remove;
      ASSERT_TRUE(server.submaps->DeleteSubmap(&remove, deletion, &deleted).ok());
      ASSERT_GT(deleted.revision(), cloned.revision());
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
    EXPECT_TRUE(fed.status.ok()) << fed.status.error_message();
    EXPECT_EQ(fed.acks.size(), static_cast<std::size_t>(count));
    num_frames += count;
  };
  feed(24);
  EXPECT_TRUE(Eventually([&] { return num_queries > 2 && num_edits > 0 ? true : (feed(1), false); }));
  is_mapping = false;
  for (std::thread& thread : threads) thread.join();

  EXPECT_TRUE(server.Stop().ok());
  EXPECT_EQ((*store->LoadMap("room"))->submaps().size(), 4u);
}

TEST(Concurrency, ManyMapsAreFedAtOnceAndDeletedWhileTheyAreQueried) {
  const auto store = MakeMemoryStore();
  TestServer server(*store);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&server, t] {
      const std::string name = "room" + std::to_string(t);
      grpc::ClientContext create;
      v1::CreateMapResponse created;
      ASSERT_TRUE(server.maps->CreateMap(&create, CreateRequest(name), &created).ok());
      ASSERT_TRUE(Feed(server, name, 0, 3).status.ok());
      std::thread reader([&server, name] {
        grpc::StatusCode code = grpc::OK;
        while (code == grpc::OK) {
          v1::QueryPointsResponse response;
          grpc::ClientContext context;
          code = server.queries->QueryPoints(&context, TestQuery(name), &response).error_code();
        }
        EXPECT_EQ(code, grpc::NOT_FOUND);
      });
      v1::DeleteMapRequest request;
      request.set_name("maps/" + name);
      v1::DeleteMapResponse deleted;
      grpc::ClientContext remove;
      EXPECT_TRUE(server.maps->DeleteMap(&remove, request, &deleted).ok());
      reader.join();
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(store->ListMaps()->empty());
}

}  // namespace
}  // namespace dhpmap::testing
