// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <future>
#include <string>

#include "google/rpc/status.pb.h"
#include "mapping/objects/merge_submaps.h"
#include "tests/integration/test_server.h"
#include "tests/integration/test_store.h"

namespace dhpmap::testing {
namespace {

/// One mapped room; ids of its objects by class.
class EditTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
    ASSERT_OK(Feed(server, "room", 0, 12));
    const v1::ListSubmapsResponse all = List({});
    for (const auto& submap : all.submaps()) {
      if (submap.class_id() == 1) ball = submap;
      if (submap.class_id() == 2) box = submap;
      if (submap.class_id() == 3) floor = submap;
    }
    ASSERT_GT(ball.instance_id() * box.instance_id() * floor.instance_id(), 0);
  }

  v1::ListSubmapsResponse List(v1::ListSubmapsRequest request) {
    request.set_parent("maps/room");
    return server.Call(&SubmapStub::ListSubmaps, request).KeepStatus(status);
  }
  v1::Submap Get(const std::string& name) {
    return server.Call(&SubmapStub::GetSubmap, name).KeepStatus(status).submap();
  }
  v1::Submap Update(const v1::Submap& submap, const std::vector<std::string>& mask) {
    v1::UpdateSubmapRequest request;
    *request.mutable_submap() = submap;
    for (const auto& path : mask) request.mutable_update_mask()->add_paths(path);
    return server.Call(&SubmapStub::UpdateSubmap, request).KeepStatus(status).submap();
  }
  v1::Submap Clone(const v1::CloneSubmapRequest& request) {
    return server.Call(&SubmapStub::CloneSubmap, request).KeepStatus(status).submap();
  }
  void Delete(const std::string& name, const std::string& etag = "") {
    v1::DeleteSubmapRequest request;
    request.set_name(name);
    request.set_etag(etag);
    status = server.Call(&SubmapStub::DeleteSubmap, request).status();
  }
  std::int64_t InstanceAt(double x, double y, double z) {
    v1::QueryPointsRequest request;
    request.set_map("maps/room");
    for (const double value : {x, y, z}) request.add_packed_points_m(static_cast<float>(value));
    const auto response = server.Call(&QueryStub::QueryPoints, request).KeepStatus(status);
    return response.results_size() == 1 && response.results(0).near_surface() ? response.results(0).instance_id() : -1;
  }

  std::unique_ptr<MapStore> store = MakeTestStore();
  TestServer server{*store};
  grpc::Status status;
  v1::Submap ball, box, floor;
};

TEST_F(EditTest, QueriesFindAMovedObjectAtItsNewPlace) {
  ASSERT_EQ(InstanceAt(0, 0, 0.79), ball.instance_id());
  ball.mutable_map_from_submap()->mutable_translation_m()->set_y(5);
  const v1::Submap moved = Update(ball, {"map_from_submap"});
  ASSERT_OK(status);
  EXPECT_NE(moved.etag(), ball.etag());
  EXPECT_NEAR(moved.bounding_sphere().center_m().y(), ball.bounding_sphere().center_m().y() + 5, 1e-9);
  EXPECT_NE(InstanceAt(0, 0, 0.79), ball.instance_id());
  EXPECT_EQ(InstanceAt(0, 5, 0.79), ball.instance_id());
  EXPECT_EQ((*store->LoadMap("room"))->revision(), moved.revision());  // durable before the answer
}

TEST_F(EditTest, APartialPoseKeepsTheRest) {
  v1::Submap turned;
  turned.set_name(ball.name());
  turned.mutable_map_from_submap()->mutable_rotation()->set_z(1);  // half a turn
  turned = Update(turned, {"map_from_submap.rotation"});
  ASSERT_OK(status);
  v1::Submap moved;
  moved.set_name(ball.name());
  moved.mutable_map_from_submap()->mutable_translation_m()->set_x(2);
  moved = Update(moved, {"map_from_submap.translation_m.x"});
  ASSERT_OK(status);
  EXPECT_EQ(moved.map_from_submap().translation_m().x(), 2);
  EXPECT_NEAR(std::abs(moved.map_from_submap().rotation().z()), 1, 1e-9);
}

TEST_F(EditTest, RelabelAndRenameSurviveFurtherMapping) {
  v1::Submap wanted;
  wanted.set_name(ball.name());
  wanted.set_class_id(2);
  wanted.set_display_name("beach ball");
  Update(wanted, {});  // without a mask: the fields that are set
  ASSERT_OK(status);
  ASSERT_OK(Feed(server, "room", 12, 16));
  const v1::Submap now = Get(ball.name());
  EXPECT_EQ(now.class_name(), "thing2");
  EXPECT_EQ(now.display_name(), "beach ball");
}

TEST_F(EditTest, AnObjectIsLockedAndUnlockedByItsField) {
  v1::Submap wanted;
  wanted.set_name(ball.name());
  wanted.set_locked(true);
  EXPECT_TRUE(Update(wanted, {}).locked()) << "without a mask: what is set";
  ASSERT_OK(status);
  wanted.set_display_name("mine");
  EXPECT_TRUE(Update(wanted, {"display_name"}).locked());
  EXPECT_EQ(Get(ball.name()).display_name(), "mine") << "edits of what is locked are made as ever";
  wanted.set_locked(false);
  EXPECT_FALSE(Update(wanted, {"locked"}).locked());
  EXPECT_OK(status);
}

TEST_F(EditTest, ACloneHasItsOwnIdAndPlaceAndSharesTheShape) {
  v1::CloneSubmapRequest request;
  request.set_name(box.name());
  request.set_display_name("second box");
  request.mutable_map_from_submap()->mutable_translation_m()->set_y(-4);
  const v1::Submap clone = Clone(request);
  ASSERT_OK(status);
  EXPECT_GT(clone.instance_id(), box.instance_id());
  EXPECT_EQ(clone.num_blocks(), box.num_blocks());
  EXPECT_EQ(clone.display_name(), "second box");
  EXPECT_EQ(InstanceAt(1.2, 0.3, 0.59), box.instance_id());
  EXPECT_EQ(InstanceAt(1.2, -3.7, 0.59), clone.instance_id());
}

TEST_F(EditTest, ADeletedObjectsIdIsNotReused) {
  Delete(box.name(), box.etag());
  ASSERT_OK(status);
  Get(box.name());
  EXPECT_EQ(status.error_code(), grpc::NOT_FOUND);
  Delete(box.name());
  EXPECT_EQ(status.error_code(), grpc::NOT_FOUND);
  v1::CloneSubmapRequest request;
  request.set_name(ball.name());
  EXPECT_GT(Clone(request).instance_id(), box.instance_id());
}

TEST_F(EditTest, AnOldEtagIsAborted) {
  ball.set_display_name("a");
  const std::string old = ball.etag();
  Update(ball, {"display_name"});
  ASSERT_OK(status);
  Update(ball, {"display_name"});
  EXPECT_EQ(status.error_code(), grpc::ABORTED);
  Delete(ball.name(), old);
  EXPECT_EQ(status.error_code(), grpc::ABORTED);
  EXPECT_EQ(Get(ball.name()).display_name(), "a");
}

TEST_F(EditTest, ImpossibleEditsAreRefusedWithAReason) {
  v1::Submap submap;
  submap.set_name("maps/room/submaps/0");
  submap.set_display_name("x");
  Update(submap, {"display_name"});
  EXPECT_EQ(status.error_code(), grpc::FAILED_PRECONDITION);
  submap.set_name("maps/room/submaps/999");
  Update(submap, {"display_name"});
  EXPECT_EQ(status.error_code(), grpc::NOT_FOUND);
  submap.set_name("maps/hall/submaps/1");
  Update(submap, {"display_name"});
  EXPECT_EQ(status.error_code(), grpc::NOT_FOUND);
  submap.set_name("room/1");
  Update(submap, {"display_name"});
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);

  const auto refuses = [this](const std::function<void(v1::Submap&)>& change, const std::string& path) {
    v1::Submap wanted = ball;
    change(wanted);
    Update(wanted, {path});
    return status.error_code() == grpc::INVALID_ARGUMENT;
  };
  EXPECT_TRUE(refuses([](auto& s) { s.set_class_id(3); }, "class_id"));   // a thing cannot become stuff
  EXPECT_TRUE(refuses([](auto& s) { s.set_class_id(50); }, "class_id"));  // no such class
  EXPECT_TRUE(refuses([](auto& s) { s.set_class_id(-1); }, "class_id"));
  EXPECT_TRUE(refuses([](auto& s) { s.set_voxel_size_m(1); }, "voxel_size_m"));
  EXPECT_TRUE(refuses([](auto&) {}, "no_such_field"));
  EXPECT_TRUE(refuses([](auto& s) { s.set_display_name(std::string(1000, 'x')); }, "display_name"));
  EXPECT_TRUE(refuses([](auto& s) { s.mutable_map_from_submap()->mutable_translation_m()->set_x(std::nan("")); },
                      "map_from_submap"));
  EXPECT_EQ(Get(ball.name()).SerializeAsString(), ball.SerializeAsString());
}

TEST_F(EditTest, ErrorsCarryTheirReasonAndFields) {
  ball.set_class_id(50);
  Update(ball, {"class_id"});
  google::rpc::Status details;
  ASSERT_TRUE(details.ParseFromString(status.error_details()));
  EXPECT_EQ(details.code(), 3);
  EXPECT_EQ(details.details_size(), 2);
  EXPECT_EQ(ErrorInfoOf(status).reason(), "BAD_EDIT");
  EXPECT_EQ(ErrorInfoOf(status).domain(), "dhpmap");
  EXPECT_EQ(BadFieldOf(status), "class_id");
}

TEST_F(EditTest, AMergedObjectIsAnsweredWithItsSuccessorAlsoAfterARestart) {
  std::promise<bool> merged;
  const auto session = server.registry().GetOpen("room");
  ASSERT_OK(session);
  const SubmapId from(static_cast<std::uint32_t>(box.instance_id())),
      into(static_cast<std::uint32_t>(ball.instance_id()));
  (*session)->Edit(
      [&](Map& map) -> Result<SubmapId> {
        if (!CanMerge(map, from, into)) return NotFound("they cannot be merged");
        MergeSubmaps(from, into, map);
        return into;
      },
      [&merged](const Result<EditOutcome>& outcome) { merged.set_value(outcome.ok()); });
  ASSERT_TRUE(merged.get_future().get());

  const auto expect_merged = [&](TestServer& of) {
    const grpc::Status got = of.Call(&SubmapStub::GetSubmap, box.name()).status();
    EXPECT_EQ(got.error_code(), grpc::NOT_FOUND);
    ASSERT_EQ(ReasonOf(got), "MERGED_INTO");
    EXPECT_EQ(ErrorInfoOf(got).metadata().at("merged_into"), ball.name());
  };
  expect_merged(server);
  EXPECT_EQ(Get(ball.name()).instance_id(), ball.instance_id());
  ASSERT_OK(server.Stop());
  TestServer again(*store);
  expect_merged(again);
}

TEST_F(EditTest, ListsAreFiltered) {
  v1::ListSubmapsRequest request;
  request.add_class_names("thing1");
  EXPECT_EQ(List(request).submaps_size(), 1);
  request.add_class_names("stuff3");
  EXPECT_EQ(List(request).submaps_size(), 2);
  request.set_kind(v1::LabelClass::STUFF);
  EXPECT_EQ(List(request).submaps_size(), 1);
  request.add_class_ids(1);
  EXPECT_EQ(List(request).submaps_size(), 0);

  v1::ListSubmapsRequest near;
  near.mutable_sphere()->mutable_center_m()->set_x(0);
  near.mutable_sphere()->mutable_center_m()->set_z(0.5);
  near.mutable_sphere()->set_radius_m(0.01);
  near.set_kind(v1::LabelClass::THING);
  ASSERT_EQ(List(near).submaps_size(), 1);
  EXPECT_EQ(List(near).submaps(0).instance_id(), ball.instance_id());

  v1::ListSubmapsRequest region;
  region.mutable_region()->mutable_min_m()->set_z(50);
  region.mutable_region()->mutable_max_m()->set_z(60);
  EXPECT_EQ(List(region).submaps_size(), 0);
  EXPECT_OK(status);
  region.mutable_region()->mutable_min_m()->set_x(1);
  List(region);
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);
  v1::ListSubmapsRequest unknown;
  unknown.add_class_names("no such class");
  List(unknown);
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);
}

TEST_F(EditTest, VoxelsAndMeshesComeInChunksThatFit) {
  ASSERT_OK_AND_ASSIGN(const auto voxels, server.Call(&SubmapStub::StreamSubmapVoxels, floor.name()));
  int num_voxels = 0;
  for (const auto& part : voxels) {
    num_voxels += part.tsdf_m_size();
    EXPECT_LE(part.ByteSizeLong(), 256u * 1024);
    EXPECT_EQ(part.xyz_m_size(), 3 * part.tsdf_m_size());
    EXPECT_EQ(part.rgb().size(), 3u * static_cast<unsigned>(part.tsdf_m_size()));
    EXPECT_EQ(part.class_id_size(), part.tsdf_m_size());
    EXPECT_GT(part.revision(), 0);
  }
  EXPECT_GT(num_voxels, 10000);
  EXPECT_GT(voxels.size(), 1u);

  for (const std::string& name : {ball.name(), std::string("maps/room")}) {
    for (const auto format : {v1::GetSubmapMeshRequest::PLY, v1::GetSubmapMeshRequest::PCD}) {
      auto request = About<v1::GetSubmapMeshRequest>(name);
      request.set_format(format);
      ASSERT_OK_AND_ASSIGN(const auto mesh, server.Call(&SubmapStub::GetSubmapMesh, request));
      std::string file;
      for (const auto& chunk : mesh) {
        EXPECT_EQ(chunk.content_type().empty(), !file.empty());
        EXPECT_LE(chunk.ByteSizeLong(), 256u * 1024);
        file += chunk.data();
      }
      EXPECT_EQ(static_cast<std::int64_t>(file.size()), mesh.at(0).total_bytes());
      EXPECT_GT(file.size(), 10000u);
      EXPECT_EQ(file.substr(0, 3), format == v1::GetSubmapMeshRequest::PLY ? "ply" : "# .");
    }
  }
}

}  // namespace
}  // namespace dhpmap::testing
