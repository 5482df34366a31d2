// SPDX-License-Identifier: BSD-3-Clause
// The old places of moved or deleted objects: free where rays had passed, else as the query says.
#include <memory>
#include <string>

#include "tests/integration/server_on_file.h"
#include "tests/integration/walked_room.h"

namespace dhpmap::testing {
namespace {

/// A room with a crate and a chair. Frames show the crate from the start, and the chair's place free before the chair
/// is placed there. The map is in a file, so servers can restart.
class VacatedPlaces : public ServerOnFile {
 protected:
  void SetUp() override {
    ServerOnFile::SetUp();
    for (const char* map : {"moved", "deleted"}) {
      CreateWalkedMap(*server, map);
      Walk(*server, map, WalkedRoom(false, true), 0, 12);
      Walk(*server, map, WalkedRoom(true, true), 12, 24);
    }
  }
  void Move(const std::string& name, double z_m) {
    v1::UpdateSubmapRequest request;
    request.mutable_submap()->set_name(name);
    request.mutable_submap()->mutable_map_from_submap()->mutable_translation_m()->set_z(z_m);
    request.mutable_update_mask()->add_paths("map_from_submap");
    ASSERT_OK(server->Call(&SubmapStub::UpdateSubmap, request));
  }
  void Delete(const std::string& name) { ASSERT_OK(server->Call(&SubmapStub::DeleteSubmap, name)); }

  v1::PointResult PointAt(const std::string& map, const Eigen::Vector3d& p) {
    v1::QueryPointsRequest request;
    request.set_map("maps/" + map);
    SetVector(p, *request.add_points_m());
    const auto response = server->Call(&QueryStub::QueryPoints, request).value();
    return response.results_size() == 1 ? response.results(0) : v1::PointResult();
  }
  v1::DistanceResult DistanceAt(const std::string& map, const Eigen::Vector3d& p, v1::Vacated::Policy vacated) {
    v1::QueryDistancesRequest request;
    request.set_map("maps/" + map);
    SetVector(p, *request.add_points_m());
    request.mutable_options()->set_vacated_policy(vacated);
    const auto response = server->Call(&QueryStub::QueryDistances, request).value();
    return response.results_size() == 1 ? response.results(0) : v1::DistanceResult();
  }
  /// For a ball of 5 cm, which unobserved space blocks.
  v1::CollisionResult CollisionAt(const std::string& map, const Eigen::Vector3d& p, v1::Vacated::Policy vacated) {
    v1::CheckCollisionsRequest request;
    request.set_map("maps/" + map);
    v1::Sphere& sphere = *request.add_bodies()->mutable_sphere();
    SetVector(p, *sphere.mutable_center_m());
    sphere.set_radius_m(0.05);
    request.mutable_options()->set_vacated_policy(vacated);
    const auto response = server->Call(&QueryStub::CheckCollisions, request).value();
    return response.results_size() == 1 ? response.results(0) : v1::CollisionResult();
  }

  void ExpectFree(const std::string& map, const Eigen::Vector3d& p) {
    const v1::PointResult point = PointAt(map, p);
    EXPECT_FALSE(point.near_surface());
    EXPECT_TRUE(point.free()) << "rays had passed";
    for (const auto vacated : {v1::Vacated::POLICY_UNSPECIFIED, v1::Vacated::UNKNOWN, v1::Vacated::FREE}) {
      EXPECT_EQ(DistanceAt(map, p, vacated).status(), v1::QueryStatus::OK) << vacated;
      EXPECT_GT(DistanceAt(map, p, vacated).distance_m(), 0.1) << vacated;
      const v1::CollisionResult collision = CollisionAt(map, p, vacated);
      EXPECT_FALSE(collision.colliding()) << vacated << collision.DebugString();
      EXPECT_EQ(collision.status(), v1::QueryStatus::OK) << vacated;
    }
  }
  void ExpectAsTheAskerSays(const std::string& map, const Eigen::Vector3d& p) {
    const v1::PointResult point = PointAt(map, p);
    EXPECT_FALSE(point.near_surface());
    EXPECT_FALSE(point.free()) << "nobody has seen what is there";
    for (const auto vacated : {v1::Vacated::POLICY_UNSPECIFIED, v1::Vacated::UNKNOWN}) {
      EXPECT_EQ(DistanceAt(map, p, vacated).status(), v1::QueryStatus::UNKNOWN) << vacated;
      const v1::CollisionResult collision = CollisionAt(map, p, vacated);
      EXPECT_TRUE(collision.colliding()) << vacated;
      EXPECT_EQ(collision.status(), v1::QueryStatus::UNKNOWN) << vacated;
      EXPECT_TRUE(collision.contacts_size() == 1 && collision.contacts(0).instance_id() == -1) << vacated;
    }
    EXPECT_EQ(DistanceAt(map, p, v1::Vacated::FREE).status(), v1::QueryStatus::OK);
    EXPECT_GT(DistanceAt(map, p, v1::Vacated::FREE).distance_m(), 0.1);
    const v1::CollisionResult collision = CollisionAt(map, p, v1::Vacated::FREE);
    EXPECT_FALSE(collision.colliding()) << collision.DebugString();
    EXPECT_EQ(collision.status(), v1::QueryStatus::OK);
  }
  /// Checks the old places of both objects.
  void ExpectLeft(const std::string& map) {
    SCOPED_TRACE(map);
    ExpectFree(map, kChairFront_m);
    ExpectFree(map, kChairMiddle_m);
    ExpectAsTheAskerSays(map, kCrateMiddle_m);
  }

  static void SetVector(const Eigen::Vector3d& p, v1::Vector3& vector) {
    vector.set_x(p.x());
    vector.set_y(p.y());
    vector.set_z(p.z());
  }

  inline static const Eigen::Vector3d kChairFront_m{1.46, 0.2, 0.5};
};

TEST_F(VacatedPlaces, AreFreeIfSeenElseAsTheQuerySaysAlsoAfterARestart) {
  const v1::PointResult chair = PointAt("moved", kChairFront_m);
  ASSERT_TRUE(chair.near_surface());
  ASSERT_EQ(chair.class_id(), kChairClass);
  ASSERT_NE(DistanceAt("moved", kCrateMiddle_m, v1::Vacated::FREE).status(), v1::QueryStatus::OK)
      << "it is still inside";
  for (const int class_id : {kChairClass, kCrateClass}) {
    Move(ListedOfClass(*server, "moved", class_id).name(), 5);
    Delete(ListedOfClass(*server, "deleted", class_id).name());
  }
  ExpectLeft("moved");
  ExpectLeft("deleted");
  Restart();
  ExpectLeft("moved");
  ExpectLeft("deleted");
}

TEST_F(VacatedPlaces, AnObjectPlacedByAnEditLeavesNoVacatedSpace) {
  const std::string crate = ListedOfClass(*server, "moved", kCrateClass).name();
  const Eigen::Vector3d middle_there_m = kCrateMiddle_m + 3 * Eigen::Vector3d::UnitZ();  // above all observed space
  ASSERT_FALSE(PointAt("moved", middle_there_m).free());
  Move(crate, 3);
  Move(crate, 8);
  for (const bool is_restarted : {false, true}) {
    if (is_restarted) Restart();
    EXPECT_EQ(DistanceAt("moved", middle_there_m, v1::Vacated::UNKNOWN).status(), v1::QueryStatus::UNKNOWN)
        << is_restarted;
    EXPECT_EQ(DistanceAt("moved", middle_there_m, v1::Vacated::FREE).status(), v1::QueryStatus::UNKNOWN)
        << is_restarted;
    ExpectAsTheAskerSays("moved", kCrateMiddle_m);
  }
}

}  // namespace
}  // namespace dhpmap::testing
