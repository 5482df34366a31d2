// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "storage/sqlite_store.h"
#include "tests/integration/test_server.h"

namespace dhpmap::testing {
namespace {

constexpr int kNumNoisyFrames = 12;

/// Labels half of the box as floor in every third frame.
v1::Frame NoisyFrame(int i) {
  constexpr std::uint32_t kBox = 2, kFloor = 3;
  v1::Frame frame = TestFrame(i);
  if (i % 3 != 0) return frame;
  std::string& segments = *frame.mutable_depth_camera()->mutable_segments()->mutable_data();
  auto* ids = reinterpret_cast<std::uint32_t*>(segments.data());
  for (std::size_t p = 0; p < segments.size() / sizeof(std::uint32_t); ++p) {
    if (ids[p] == kBox && p % 8 < 4) ids[p] = kFloor;
  }
  return frame;
}

void CreateMapFrom(TestServer& server, const v1::CreateMapRequest& request) {
  ASSERT_OK(server.Call(&MapStub::CreateMap, request));
}

void FeedNoisyFrames(TestServer& server, int begin, int end) {
  grpc::ClientContext context;
  const auto stream = server.mapping->IntegrateFrames(&context);
  v1::IntegrateFramesRequest request;
  request.set_map("maps/room");
  for (int i = begin; i < end; ++i) {
    *request.mutable_frame() = NoisyFrame(i);
    ASSERT_TRUE(stream->Write(request));
    v1::IntegrateFramesResponse ack;
    ASSERT_TRUE(stream->Read(&ack));
    EXPECT_EQ(ack.error().code(), 0) << ack.error().message();
  }
  stream->WritesDone();
  EXPECT_OK(stream->Finish());
}

v1::FinishMappingResponse FinishMapping(TestServer& server) {
  return server.Call(&MappingStub::FinishMapping, "maps/room").value();
}

TEST(Refinement, FinishMappingReportsWhatItDid) {
  const auto store = MakeMemoryStore();
  std::atomic<int> num_observed = 0;
  TestServer server(*store, {.mapping = {.on_refinement = [&](const RefinementReport&) { ++num_observed; }}});
  CreateMapFrom(server, CreateRequest("room"));
  FeedNoisyFrames(server, 0, kNumNoisyFrames);
  const v1::Refinement refinement = FinishMapping(server).refinement();
  EXPECT_GT(refinement.num_shared_voxels(), 0);
  EXPECT_GT(refinement.num_moved_voxels(), 0);
  EXPECT_GT(refinement.num_crf_voxels(), 0);
  EXPECT_EQ(refinement.num_dropped_bytes(), 0);
  EXPECT_GT(refinement.management_s() + refinement.crf_s(), 0);
  EXPECT_EQ(num_observed, 1);
  EXPECT_EQ(FinishMapping(server).refinement().num_shared_voxels(), 0) << "a second time there is nothing to do";
}

TEST(Refinement, DroppedVoxelLabelsAreReportedAndSurviveARestart) {
  const TempDir dir;
  const std::string path = (dir.path() / "maps.db").string();
  v1::QueryPointsResponse before;
  {
    const auto store = OpenSqliteStore(path);
    ASSERT_OK(store);
    TestServer server(**store);
    v1::CreateMapRequest request = CreateRequest("room");
    request.mutable_config()->mutable_refinement()->set_drop_voxel_labels(true);
    CreateMapFrom(server, request);
    FeedNoisyFrames(server, 0, kNumNoisyFrames);
    EXPECT_GT(FinishMapping(server).refinement().num_dropped_bytes(), 0);
    ASSERT_OK_AND_ASSIGN(before, server.Call(&QueryStub::QueryPoints, TestQuery("room")));
    ASSERT_OK(server.Stop());
  }
  const auto store = OpenSqliteStore(path);
  ASSERT_OK(store);
  TestServer server(**store);
  ASSERT_OK_AND_ASSIGN(const auto answer, server.Call(&QueryStub::QueryPoints, TestQuery("room")));
  ASSERT_EQ(answer.packed().near_surface_size(), before.packed().near_surface_size());
  for (int i = 0; i < before.packed().near_surface_size(); ++i) {
    ASSERT_EQ(answer.packed().near_surface(i), before.packed().near_surface(i));
    ASSERT_EQ(answer.packed().instance_id(i), before.packed().instance_id(i));
    ASSERT_EQ(answer.packed().class_id(i), before.packed().class_id(i));
  }
}

TEST(Refinement, QueriesContinueDuringRefinementAndEachSeesOneRevision) {
  const auto store = MakeMemoryStore();
  TestServer server(*store, {.publish = {.frames = 1}});
  v1::CreateMapRequest request = CreateRequest("room");
  request.mutable_config()->mutable_refinement()->set_every_frames(1);
  CreateMapFrom(server, request);
  std::atomic<bool> is_done = false;
  std::atomic<int> num_answers = 0;
  std::thread planner([&] {
    std::int64_t revision = 0;
    do {
      const auto answer = server.Call(&QueryStub::QueryPoints, TestQuery("room")).value();
      EXPECT_GE(answer.revision(), revision);
      revision = answer.revision();
      ++num_answers;
    } while (!is_done);
  });
  FeedNoisyFrames(server, 0, kNumNoisyFrames);
  const auto finished = FinishMapping(server);
  is_done = true;
  planner.join();
  EXPECT_GT(num_answers, 0);
  EXPECT_EQ(finished.num_frames(), kNumNoisyFrames);
}

}  // namespace
}  // namespace dhpmap::testing
