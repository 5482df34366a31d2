// SPDX-License-Identifier: BSD-3-Clause
// Descriptions of objects for people: name and place.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/integration/test_server.h"
#include "tests/support/wire_frame.h"

namespace dhpmap::testing {
namespace {

// A small ball at the corner of eight blocks.
constexpr double kVoxelSize_m = 0.02, kTruncation_m = 0.04, kBallRadius_m = 0.04;
constexpr double kBlock_m = 8 * kVoxelSize_m, kBallHeight_m = 2 * kBlock_m;
const double kBlocksRadius_m = std::sqrt(3.0) * kBlock_m;  // of the sphere around all eight

class ObjectDescriptions : public ::testing::Test {
 protected:
  void Begin(const v1::CreateMapRequest& request) { ASSERT_OK(server.Call(&MapStub::CreateMap, request)); }
  /// The things of the map that match the request, by ascending id.
  std::vector<v1::Submap> Things(v1::ListSubmapsRequest request = {}) {
    request.set_parent("maps/room");
    request.set_kind(v1::LabelClass::THING);
    const auto response = server.Call(&SubmapStub::ListSubmaps, request).value();
    return {response.submaps().begin(), response.submaps().end()};
  }
  v1::Submap Get(const std::string& name) { return server.Call(&SubmapStub::GetSubmap, name).value().submap(); }
  v1::Submap Update(const v1::Submap& submap, const std::string& path) {
    v1::UpdateSubmapRequest request;
    *request.mutable_submap() = submap;
    request.mutable_update_mask()->add_paths(path);
    return server.Call(&SubmapStub::UpdateSubmap, request).value().submap();
  }
  v1::Submap Rename(const std::string& name, const std::string& title) {
    v1::Submap submap;
    submap.set_name(name);
    submap.set_display_name(title);
    return Update(submap, "display_name");
  }
  v1::Submap Relabel(const std::string& name, int class_id) {
    v1::Submap submap;
    submap.set_name(name);
    submap.set_class_id(class_id);
    return Update(submap, "class_id");
  }

  std::unique_ptr<MapStore> store = MakeMemoryStore();
  TestServer server{*store};
};

class SmallObject : public ObjectDescriptions {
 protected:
  void SetUp() override {
    v1::CreateMapRequest request = CreateRequest("room");
    request.mutable_config()->set_voxel_size_m(kVoxelSize_m);
    request.mutable_config()->set_truncation_m(kTruncation_m);
    request.mutable_config()->mutable_tracking()->set_min_points_medium(10);
    Begin(request);
    Look();
    ASSERT_EQ(Things().size(), 1u);
  }
  /// Moves a camera around the ball.
  void Look() {
    const Scene scene{.solids = {{.shape = Solid::Shape::kSphere,
                                  .center_m = {0, 0, kBallHeight_m},
                                  .size_m = {kBallRadius_m, 0, 0},
                                  .segment = 1}}};
    grpc::ClientContext context;
    const auto stream = server.mapping->IntegrateFrames(&context);
    for (int i = 0; i < 12; ++i) {
      const double angle = std::numbers::pi / 6 * i;
      const Eigen::Vector3d eye_m{0.5 * std::cos(angle), 0.5 * std::sin(angle), kBallHeight_m + 0.2};
      v1::IntegrateFramesRequest request;
      request.set_map("maps/room");
      *request.mutable_frame() = ToWire(Render(scene, SmallCamera(), LookAt(eye_m, {0, 0, kBallHeight_m})));
      request.mutable_frame()->set_stamp_ns(1'000'000'000LL + 100'000'000LL * i);
      v1::Segment* segment = request.mutable_frame()->add_segments();
      segment->set_id(1);
      segment->set_class_id(1);
      segment->set_score(0.9f);
      ASSERT_TRUE(stream->Write(request));
      v1::IntegrateFramesResponse ack;
      ASSERT_TRUE(stream->Read(&ack));
      ASSERT_EQ(ack.outcome(), v1::IntegrateFramesResponse::FUSED) << ack.error().message();
    }
    stream->WritesDone();
    v1::IntegrateFramesResponse rest;
    while (stream->Read(&rest)) {
    }
    ASSERT_OK(stream->Finish());
  }
};

TEST_F(SmallObject, HasASphereAroundItsVoxelsNotItsBlocks) {
  const v1::Submap ball = Things()[0];
  ASSERT_GE(ball.num_blocks(), 8) << "or the sphere of its blocks would be small, too";
  const double radius_m = ball.bounding_sphere().radius_m();
  EXPECT_GT(radius_m, kBallRadius_m);
  EXPECT_LT(radius_m, 0.75 * kBlocksRadius_m);
  EXPECT_NEAR(ball.bounding_sphere().center_m().x(), 0, 2 * kVoxelSize_m);
  EXPECT_NEAR(ball.bounding_sphere().center_m().y(), 0, 2 * kVoxelSize_m);
  EXPECT_NEAR(ball.bounding_sphere().center_m().z(), kBallHeight_m, 3 * kVoxelSize_m);
  EXPECT_EQ(Get(ball.name()).bounding_sphere().SerializeAsString(), ball.bounding_sphere().SerializeAsString());
}

TEST_F(SmallObject, IsFoundByItsSphereWhichMovesWithIt) {
  v1::Submap ball = Things()[0];
  v1::ListSubmapsRequest beside;  // contains parts of its blocks, but none of its surface
  beside.mutable_sphere()->mutable_center_m()->set_x(0.9 * kBlocksRadius_m);
  beside.mutable_sphere()->mutable_center_m()->set_z(kBallHeight_m);
  beside.mutable_sphere()->set_radius_m(0.01);
  EXPECT_TRUE(Things(beside).empty());
  beside.mutable_sphere()->mutable_center_m()->set_x(kBallRadius_m);
  EXPECT_EQ(Things(beside).size(), 1u);

  const double radius_m = ball.bounding_sphere().radius_m(), y_m = ball.bounding_sphere().center_m().y();
  ball.mutable_map_from_submap()->mutable_translation_m()->set_y(3);
  const v1::Submap moved = Update(ball, "map_from_submap");
  EXPECT_NEAR(moved.bounding_sphere().center_m().y(), y_m + 3, 1e-9);
  EXPECT_NEAR(moved.bounding_sphere().radius_m(), radius_m, 1e-9);
  EXPECT_TRUE(Things(beside).empty());
}

TEST_F(ObjectDescriptions, NamesFollowTheClassUntilAnEditSetsOne) {
  Begin(CreateRequest("room"));
  ASSERT_OK(Feed(server, "room", 0, 8));
  const std::vector<v1::Submap> things = Things();
  ASSERT_GE(things.size(), 2u);
  for (const v1::Submap& thing : things) {
    EXPECT_EQ(thing.display_name(), thing.class_name() + " " + std::to_string(thing.instance_id()));
  }
  const std::string name = things[0].name(), id = std::to_string(things[0].instance_id());
  const int other_class = 3 - things[0].class_id();
  EXPECT_EQ(Relabel(name, other_class).display_name(), "thing" + std::to_string(other_class) + " " + id);
  EXPECT_EQ(Rename(name, "mug").display_name(), "mug");
  EXPECT_EQ(Relabel(name, things[0].class_id()).display_name(), "mug") << "a name that was given stays";
  EXPECT_EQ(Get(name).display_name(), "mug");
  EXPECT_EQ(Rename(name, "").display_name(), things[0].display_name()) << "taken back, it follows again";
  EXPECT_EQ(Relabel(name, other_class).display_name(), "thing" + std::to_string(other_class) + " " + id);
  EXPECT_EQ(Things()[0].display_name(), "thing" + std::to_string(other_class) + " " + id) << "in lists, too";
  EXPECT_EQ(Things()[1].display_name(), things[1].display_name());
}

}  // namespace
}  // namespace dhpmap::testing
