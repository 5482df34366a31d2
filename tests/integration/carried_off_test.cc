// SPDX-License-Identifier: BSD-3-Clause
// A chair is removed. Clients learn whether it is present, since when, and what remains of its shape.
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "tests/integration/test_store.h"
#include "tests/integration/walked_room.h"
#include "tests/integration/watcher.h"

namespace dhpmap::testing {
namespace {

constexpr int kCarriedOffAt = 12, kWalkEnds = 26;  // frames

class CarriedOff : public ::testing::Test {
 protected:
  CarriedOff() { CreateWalkedMap(server, "room"); }
  void WalkWithChair() { Walk(server, "room", WalkedRoom(true), 0, kCarriedOffAt); }
  void WalkWithout() { Walk(server, "room", WalkedRoom(false), kCarriedOffAt, kWalkEnds); }
  v1::Submap Chair() { return ListedOfClass(server, "room", kChairClass); }
  v1::GetSubmapResponse Get(const std::string& name) { return server.Call(&SubmapStub::GetSubmap, name).value(); }

  std::unique_ptr<MapStore> store = MakeTestStore();
  TestServer server{*store};
};

TEST_F(CarriedOff, GetAndListReturnItsAbsenceAndTheTimesOfItsViews) {
  WalkWithChair();
  const v1::Submap before = Chair();
  ASSERT_FALSE(before.name().empty());
  EXPECT_EQ(before.presence(), v1::Submap::PRESENT);
  EXPECT_EQ(before.first_observed_stamp_ns(), WalkStamp_ns(0));
  EXPECT_EQ(before.last_observed_stamp_ns(), WalkStamp_ns(kCarriedOffAt - 1));
  EXPECT_EQ(before.last_contradicted_stamp_ns(), 0) << "never";
  EXPECT_EQ(Get(before.name()).submap().SerializeAsString(), before.SerializeAsString());

  WalkWithout();
  const v1::Submap after = Chair();
  EXPECT_EQ(after.name(), before.name()) << "it is kept, and listed";
  EXPECT_EQ(after.presence(), v1::Submap::ABSENT);
  EXPECT_EQ(after.last_observed_stamp_ns(), before.last_observed_stamp_ns());
  EXPECT_GE(after.last_contradicted_stamp_ns(), WalkStamp_ns(kCarriedOffAt + 2)) << "by three frames at least";
  EXPECT_LE(after.last_contradicted_stamp_ns(), WalkStamp_ns(kWalkEnds - 1));
  EXPECT_EQ(after.num_blocks(), before.num_blocks());
  EXPECT_EQ(Get(before.name()).submap().SerializeAsString(), after.SerializeAsString());
  const v1::ListSubmapsResponse all = ListAll(*server.submaps, "room");
  for (const v1::Submap& other : all.submaps()) {
    EXPECT_TRUE(other.name() == after.name() || other.presence() == v1::Submap::PRESENT) << other.name();
  }

  Walk(server, "room", WalkedRoom(true), kWalkEnds, kWalkEnds + 1);
  const v1::Submap back = Chair();
  EXPECT_EQ(back.name(), before.name());
  EXPECT_EQ(back.presence(), v1::Submap::PRESENT) << "seen again";
  EXPECT_EQ(back.last_observed_stamp_ns(), WalkStamp_ns(kWalkEnds));
  EXPECT_GE(back.last_contradicted_stamp_ns(), after.last_contradicted_stamp_ns());
}

TEST_F(CarriedOff, AWatcherReceivesItsAbsenceAndAgreesWithAList) {
  WalkWithChair();
  const v1::ListSubmapsResponse list = ListAll(*server.submaps, "room");
  const v1::Submap before = Chair();
  HeldSubmaps held(list);
  Watcher watcher(server, "room", list.revision() + 1);
  WalkWithout();
  const v1::ListSubmapsResponse now = ListAll(*server.submaps, "room");
  int num_times_it_became_absent = 0;
  v1::Submap::Presence told = v1::Submap::PRESENT;
  std::string position;
  v1::WatchMapResponse message;
  while (position.empty() || RevisionOf(position) < now.revision()) {
    ASSERT_TRUE(watcher.Read(message));
    position = message.position();
    held.Apply(message.change());
    for (const v1::SubmapEvent& event : message.change().submaps()) {
      if (event.submap().name() != before.name()) continue;
      EXPECT_EQ(event.kind(), v1::SubmapEvent::CHANGED);
      if (event.submap().presence() == told) continue;
      told = event.submap().presence();
      const auto& parts = event.parts();
      EXPECT_NE(std::find(parts.begin(), parts.end(), v1::SubmapEvent::ACTIVITY), parts.end());
      num_times_it_became_absent += told == v1::Submap::ABSENT ? 1 : 0;
    }
  }
  EXPECT_EQ(num_times_it_became_absent, 1);
  EXPECT_EQ(held.submaps(), HeldSubmaps(now).submaps());
}

/// On the sides and the top of the chair, with a margin beyond its edges, except near the floor.
bool IsOfTheChair(const Eigen::Vector3f& p) {
  const Eigen::Vector3d from_middle = p.cast<double>() - kChairMiddle_m;
  return p.z() > 0.16f && from_middle.x() > -0.31 && from_middle.x() < 0.31 && std::abs(from_middle.y()) < 0.31 &&
         from_middle.z() < 0.46;
}

/// On the side that faces the camera: around its surface, at half its height.
bool IsOfTheFront(const Eigen::Vector3f& p) {
  return p.x() < 1.53f && p.y() > 0.f && p.y() < 0.4f && p.z() > 0.3f && p.z() < 0.65f;
}

TEST_F(CarriedOff, NoMeshHasASurfaceWhereItWas) {
  WalkWithChair();
  const std::string chair = Chair().name();
  const auto count = [this](const std::string& name, bool (*is_there)(const Eigen::Vector3f&)) {
    const auto vertices_m = MeshVerticesOf(server, name);
    return std::count_if(vertices_m.begin(), vertices_m.end(), is_there);
  };
  const auto of_map = count("maps/room", IsOfTheChair), of_front = count(chair, IsOfTheFront);
  const auto elsewhere = static_cast<long>(MeshVerticesOf(server, "maps/room").size()) - of_map;
  ASSERT_GT(of_map, 250);
  ASSERT_GT(of_front, 50);
  WalkWithout();
  EXPECT_LE(count("maps/room", IsOfTheChair), of_map / 20) << "nothing of it in the mesh of the map";
  EXPECT_LE(count(chair, IsOfTheFront), of_front / 20) << "nor in its own, where sensors have looked through";
  const auto elsewhere_now =
      static_cast<long>(MeshVerticesOf(server, "maps/room").size()) - count("maps/room", IsOfTheChair);
  EXPECT_GT(elsewhere_now, elsewhere) << "all else is there, and what the chair hid";
}

/// Distances and weights of an object's voxels by their centres, in millimetres.
using VoxelsByPlace = std::map<std::array<long, 3>, std::array<float, 2>>;

VoxelsByPlace StreamedVoxels(TestServer& server, const std::string& name) {
  VoxelsByPlace voxels;
  for (const auto& part : server.Call(&SubmapStub::StreamSubmapVoxels, name).value()) {
    for (int i = 0; i < part.tsdf_m_size(); ++i) {
      std::array<long, 3> place;
      for (int axis = 0; axis < 3; ++axis) {
        place[static_cast<std::size_t>(axis)] = std::lround(1000 * part.xyz_m(3 * i + axis));
      }
      voxels[place] = {part.tsdf_m(i), part.weight(i)};
    }
  }
  return voxels;
}

TEST_F(CarriedOff, ItsVoxelsAreStreamedWithoutContradictedOnes) {
  WalkWithChair();
  const std::string chair = Chair().name();
  const VoxelsByPlace before = StreamedVoxels(server, chair);
  WalkWithout();
  const VoxelsByPlace after = StreamedVoxels(server, chair);
  const auto num_front = [](const VoxelsByPlace& voxels) {
    return std::count_if(voxels.begin(), voxels.end(), [](const auto& voxel) {
      const auto& [x, y, z] = voxel.first;
      const bool is_surface = std::abs(voxel.second[0]) < 0.04f;
      return is_surface && IsOfTheFront(0.001f * Eigen::Vector3f(static_cast<float>(x), static_cast<float>(y),
                                                                 static_cast<float>(z)));
    });
  };
  ASSERT_GT(num_front(before), 50);
  EXPECT_LE(num_front(after), num_front(before) / 20);
  EXPECT_LT(after.size(), before.size());
  for (const auto& [place, values] : after) {
    const auto found = before.find(place);
    ASSERT_NE(found, before.end());
    EXPECT_EQ(found->second, values) << "what is left is as it was observed";
  }
}

}  // namespace
}  // namespace dhpmap::testing
