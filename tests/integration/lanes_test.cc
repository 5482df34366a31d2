// SPDX-License-Identifier: BSD-3-Clause
// Calls of one kind do not wait for those of another, and what nobody waits for ends.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/integration/failing_store.h"
#include "tests/integration/feeder.h"
#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"

namespace dhpmap::testing {
namespace {

constexpr int kManyPoints = 300'000;

v1::QueryPointsRequest ManyPoints(const std::string& map_id) {
  v1::QueryPointsRequest request;
  request.set_map("maps/" + map_id);
  request.set_packed(true);
  for (int i = 0; i < 3 * kManyPoints; ++i) request.add_xyz_m(0.001f * static_cast<float>(i % 997));
  return request;
}

class Lanes : public ::testing::Test {
 protected:
  void SetUp() override {
    grpc::ClientContext create;
    v1::CreateMapResponse created;
    ASSERT_TRUE(server_.maps->CreateMap(&create, CreateRequest("room"), &created).ok());
    ASSERT_TRUE(Feed(server_, "room", 0, 3).status.ok());
  }

  grpc::Status GetMap() {
    grpc::ClientContext context;
    v1::GetMapRequest request;
    request.set_name("maps/room");
    v1::GetMapResponse response;
    return server_.maps->GetMap(&context, request, &response);
  }

  std::unique_ptr<MapStore> store_ = MakeMemoryStore();
  static constexpr std::size_t kEnoughForAll_bytes = 512u << 20;
  TestServer server_{
      *store_,
      {},
      {.num_threads = 2, .num_bulk_threads = 1, .inflight = std::make_shared<ByteBudget>(kEnoughForAll_bytes)}};
};

TEST_F(Lanes, AQuickCallIsAnsweredWhileBulkCallsWait) {
  constexpr int kNumBulk = 8;
  const v1::QueryPointsRequest request = ManyPoints("room");
  std::atomic<int> num_begun = 0, num_ended = 0;
  std::vector<std::thread> clients;
  clients.reserve(kNumBulk);
  for (int i = 0; i < kNumBulk; ++i) {
    clients.emplace_back([&] {
      grpc::ClientContext context;
      v1::QueryPointsResponse response;
      ++num_begun;
      EXPECT_TRUE(server_.queries->QueryPoints(&context, request, &response).ok());
      EXPECT_EQ(response.packed().observed_size(), kManyPoints);
      ++num_ended;
    });
  }
  EXPECT_TRUE(Eventually([&] { return num_begun == kNumBulk; }));
  EXPECT_TRUE(GetMap().ok());
  EXPECT_LT(num_ended, kNumBulk) << "it waited for all of them";
  for (std::thread& client : clients) client.join();
}

TEST_F(Lanes, CallsWhoseClientIsGoneLeaveTheQueueUnserved) {
  constexpr int kNumAbandoned = 40;
  const v1::QueryPointsRequest request = ManyPoints("room");
  const auto start = std::chrono::steady_clock::now();
  {
    grpc::ClientContext context;
    v1::QueryPointsResponse response;
    ASSERT_TRUE(server_.queries->QueryPoints(&context, request, &response).ok());
  }
  const auto one_call = std::chrono::steady_clock::now() - start;
  std::vector<std::thread> clients;
  clients.reserve(kNumAbandoned);
  for (int i = 0; i < kNumAbandoned; ++i) {
    clients.emplace_back([&] {
      grpc::ClientContext context;
      context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(1));
      v1::QueryPointsResponse response;
      EXPECT_FALSE(server_.queries->QueryPoints(&context, request, &response).ok());
    });
  }
  for (std::thread& client : clients) client.join();
  const auto then = std::chrono::steady_clock::now();
  grpc::ClientContext context;
  v1::QueryPointsResponse response;
  ASSERT_TRUE(server_.queries->QueryPoints(&context, request, &response).ok());
  // Served in turn, the abandoned ones would have taken forty times one call.
  EXPECT_LT(std::chrono::steady_clock::now() - then, 20 * one_call);
}

TEST_F(Lanes, AMeshThatNobodyTakesAnyMoreEnds) {
  grpc::ClientContext context;
  v1::GetSubmapMeshRequest request;
  request.set_name("maps/room");
  auto mesh = server_.submaps->GetSubmapMesh(&context, request);
  v1::GetSubmapMeshResponse part;
  ASSERT_TRUE(mesh->Read(&part));
  EXPECT_GT(part.total_bytes(), 0);
  context.TryCancel();
  while (mesh->Read(&part)) {
  }
  EXPECT_EQ(mesh->Finish().error_code(), grpc::StatusCode::CANCELLED);
  EXPECT_TRUE(server_.Stop().ok()) << "nothing is left that would hold up the end";
}

TEST(LanesOfClosedMaps, CallsThatWaitForTheDiskDoNotHoldUpThoseOnOpenMaps) {
  FailingStore store;
  TestServer server(store, {}, {.num_threads = 2, .num_bulk_threads = 1});
  const auto create = [&](const std::string& map_id) {
    grpc::ClientContext context;
    v1::CreateMapResponse created;
    ASSERT_TRUE(server.maps->CreateMap(&context, CreateRequest(map_id), &created).ok());
  };
  const auto list = [&](const std::string& map_id, std::chrono::seconds patience) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + patience);
    v1::ListSubmapsRequest request;
    request.set_parent("maps/" + map_id);
    v1::ListSubmapsResponse response;
    return server.submaps->ListSubmaps(&context, request, &response).ok();
  };
  constexpr int kNumClosed = 6;  // more than there are quick threads, and than are loaded at a time
  constexpr std::chrono::seconds kSoon{5}, kLate{60};
  create("open");
  for (int i = 0; i < kNumClosed; ++i) create("closed" + std::to_string(i));
  ASSERT_TRUE(list("open", kSoon));

  std::promise<void> disk;
  std::atomic<int> num_loading = 0;
  store.set_before_load([&num_loading, done = disk.get_future().share()] {
    ++num_loading;
    done.wait();
  });
  std::vector<std::future<bool>> waiting;
  waiting.reserve(kNumClosed);
  for (int i = 0; i < kNumClosed; ++i) {
    waiting.push_back(std::async(std::launch::async, [&, i] { return list("closed" + std::to_string(i), kLate); }));
  }
  EXPECT_TRUE(Eventually([&] { return num_loading >= 2; }));
  EXPECT_TRUE(list("open", kSoon)) << "it waited for the disk";
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kSoon);
  v1::GetMapRequest request;
  request.set_name("maps/closed0");
  v1::GetMapResponse response;
  EXPECT_TRUE(server.maps->GetMap(&context, request, &response).ok()) << "for which no map is loaded";
  disk.set_value();
  for (std::future<bool>& answer : waiting) EXPECT_TRUE(answer.get());
}

TEST(LanesOfClosedMaps, FramesThatWaitForTheDiskDoNotHoldUpThoseOfOpenMaps) {
  FailingStore store;
  TestServer server(store);
  constexpr int kNumClosed = 3;  // more than there are threads for frames
  const auto create = [&](const std::string& map_id) {
    grpc::ClientContext context;
    v1::CreateMapResponse created;
    ASSERT_TRUE(server.maps->CreateMap(&context, CreateRequest(map_id), &created).ok());
  };
  create("open");
  for (int i = 0; i < kNumClosed; ++i) create("closed" + std::to_string(i));
  Feeder robot(server, "open");
  ASSERT_TRUE(robot.Feed(0));

  std::promise<void> disk;
  std::atomic<int> num_loading = 0;
  store.set_before_load([&num_loading, done = disk.get_future().share()] {
    ++num_loading;
    done.wait();
  });
  std::vector<std::unique_ptr<Feeder>> waiting;
  for (int i = 0; i < kNumClosed; ++i) {
    waiting.push_back(std::make_unique<Feeder>(server, "closed" + std::to_string(i)));
    EXPECT_TRUE(waiting.back()->Send(0, 0));
  }
  EXPECT_TRUE(Eventually([&] { return num_loading == kNumClosed; }));
  auto fed = std::async(std::launch::async, [&] { return robot.Feed(1).has_value(); });
  EXPECT_EQ(fed.wait_for(kPatience), std::future_status::ready) << "it waited for the disk";
  disk.set_value();
  EXPECT_TRUE(fed.get());
  for (const auto& feeder : waiting) {
    const auto fused = feeder->Read();
    ASSERT_TRUE(fused);
    EXPECT_EQ(fused->outcome(), v1::FUSED);
  }
}

}  // namespace
}  // namespace dhpmap::testing
