// SPDX-License-Identifier: BSD-3-Clause
// A distance grid, message by message, compared with distances of the same points.
#include <cstdint>
#include <map>

#include "tests/integration/mapped_scene.h"

namespace dhpmap::testing {
namespace {

// A float represents the nodes' coordinates exactly, so both queries use the same points.
constexpr double kCorner_m[3] = {-0.625, -0.5, -0.125}, kResolution_m = 0.0625;
constexpr int kNodes[3] = {30, 17, 20};

class GridChunksTest : public MappedScene {
 protected:
  static v1::QueryDistanceGridRequest GridOf(const v1::QueryOptions& options) {
    v1::QueryDistanceGridRequest request;
    request.set_map("maps/room");
    v1::Vector3 &low_m = *request.mutable_box()->mutable_min_m(), &high_m = *request.mutable_box()->mutable_max_m();
    low_m.set_x(kCorner_m[0]), low_m.set_y(kCorner_m[1]), low_m.set_z(kCorner_m[2]);
    high_m.set_x(kCorner_m[0] + kResolution_m * (kNodes[0] - 1));
    high_m.set_y(kCorner_m[1] + kResolution_m * (kNodes[1] - 1));
    high_m.set_z(kCorner_m[2] + kResolution_m * (kNodes[2] - 1));
    request.set_resolution_m(kResolution_m);
    request.set_include_gradients(true);
    request.set_include_objects(true);
    *request.mutable_options() = options;
    return request;
  }
  /// The distances of nodes [first, first + count), numbered as in the proto.
  static v1::QueryDistancesResponse DistancesOf(std::int64_t first, int count, const v1::QueryOptions& options) {
    v1::QueryDistancesRequest request;
    request.set_map("maps/room");
    request.set_packed(true);
    *request.mutable_options() = options;
    for (std::int64_t n = first; n < first + count; ++n) {
      const std::int64_t ijk[3] = {n % kNodes[0], n / kNodes[0] % kNodes[1], n / kNodes[0] / kNodes[1]};
      for (int axis = 0; axis < 3; ++axis) {
        request.add_packed_points_m(
            static_cast<float>(kCorner_m[axis] + kResolution_m * static_cast<double>(ijk[axis])));
      }
    }
    return server_->Call(&QueryStub::QueryDistances, request).value();
  }
  static void ExpectChunkIsTheDistances(const v1::QueryDistanceGridResponse& chunk, const v1::QueryOptions& options) {
    const v1::QueryDistancesResponse answer = DistancesOf(chunk.first_node(), chunk.distance_m_size(), options);
    const v1::PackedDistanceResults& packed = answer.packed();
    EXPECT_EQ(chunk.revision(), answer.revision());
    v1::QueryDistanceGridResponse expected;
    *expected.mutable_distance_m() = packed.distance_m();
    *expected.mutable_gradient() = packed.gradient();
    *expected.mutable_instance_id() = packed.instance_id();
    *expected.mutable_status() = packed.status();
    v1::QueryDistanceGridResponse content = chunk;
    for (v1::QueryDistanceGridResponse* message : {&content, &expected}) {
      message->clear_revision(), message->clear_first_node();
      message->clear_num_x(), message->clear_num_y(), message->clear_num_z();
    }
    EXPECT_TRUE(content.SerializeAsString() == expected.SerializeAsString()) << "from node " << chunk.first_node();
  }
  /// Reads the grid and compares each message as it arrives; returns the number of nodes with each status.
  static std::map<int, int> ExpectGridIsTheDistances(const v1::QueryOptions& options) {
    std::map<int, int> statuses;
    std::int64_t next = 0;
    int num_chunks = 0;
    for (const auto& chunk : server_->Call(&QueryStub::QueryDistanceGrid, GridOf(options)).value()) {
      EXPECT_EQ(chunk.first_node(), next) << "each node once, in their order";
      EXPECT_EQ(chunk.num_x(), num_chunks == 0 ? kNodes[0] : 0);
      EXPECT_EQ(chunk.num_y(), num_chunks == 0 ? kNodes[1] : 0);
      EXPECT_EQ(chunk.num_z(), num_chunks == 0 ? kNodes[2] : 0);
      EXPECT_GT(chunk.distance_m_size(), 0);
      EXPECT_LE(chunk.ByteSizeLong(), 256u * 1024);
      ExpectChunkIsTheDistances(chunk, options);
      next += chunk.distance_m_size();
      for (const int status : chunk.status()) ++statuses[status];
      ++num_chunks;
    }
    EXPECT_EQ(next, std::int64_t{kNodes[0]} * kNodes[1] * kNodes[2]);
    EXPECT_GT(num_chunks, 1);
    return statuses;
  }
};

TEST_F(GridChunksTest, EachContainsTheDistancesOfItsNodes) {
  const auto statuses = ExpectGridIsTheDistances({});
  EXPECT_TRUE(statuses.contains(v1::QueryStatus::OK));
  EXPECT_TRUE(statuses.contains(v1::QueryStatus::UNKNOWN)) << "inside the ball, below the floor";
}

TEST_F(GridChunksTest, EachRespectsTheQueryFrameAndOptions) {
  v1::QueryOptions options;
  options.mutable_map_from_query()->mutable_translation_m()->set_x(0.5);
  options.mutable_map_from_query()->mutable_translation_m()->set_z(0.25);
  options.mutable_map_from_query()->mutable_rotation()->set_z(1);
  options.mutable_map_from_query()->mutable_rotation()->set_w(2);
  options.set_max_distance_m(0.3);
  options.add_excluded_submaps(ObjectOfClass(1));
  options.mutable_padding()->set_default_padding_m(0.05);
  const auto statuses = ExpectGridIsTheDistances(options);
  EXPECT_TRUE(statuses.contains(v1::QueryStatus::CLAMPED)) << "beyond 0.3 m";
  EXPECT_TRUE(statuses.contains(v1::QueryStatus::OK));
  options.set_unknown_policy(v1::QueryOptions::FREE);
  EXPECT_FALSE(ExpectGridIsTheDistances(options).contains(v1::QueryStatus::UNKNOWN));
}

TEST_F(GridChunksTest, ContainGradientsAndObjectsOnlyOnRequest) {
  v1::QueryDistanceGridRequest request = GridOf({});
  request.clear_include_gradients();
  request.clear_include_objects();
  ASSERT_OK_AND_ASSIGN(const auto chunks, server_->Call(&QueryStub::QueryDistanceGrid, request));
  EXPECT_FALSE(chunks.empty());
  for (const auto& chunk : chunks) {
    EXPECT_GT(chunk.distance_m_size(), 0);
    EXPECT_EQ(chunk.status_size(), chunk.distance_m_size());
    EXPECT_EQ(chunk.gradient_size() + chunk.instance_id_size(), 0);
  }
}

}  // namespace
}  // namespace dhpmap::testing
