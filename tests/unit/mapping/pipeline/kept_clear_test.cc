// SPDX-License-Identifier: BSD-3-Clause
// Regions that are kept clear take nothing from frames, and the world around them does not notice.
#include <algorithm>
#include <string>
#include <vector>

#include "mapping/objects/clear_region.h"
#include "tests/unit/mapping/pipeline/gone_scene.h"

namespace dhpmap {
namespace {

using testing::Box;
using testing::Chair;
using testing::EmptyRoom;
using testing::FindThing;
using testing::Info;
using testing::kChair;
using testing::Session;
using testing::WalkFrame;
using testing::With;

/// Around the chair, a part of the floor, and a corner of the walls.
const Region kAroundChair = Eigen::AlignedBox3d(Eigen::Vector3d(1.3, -0.2, -0.1), Eigen::Vector3d(2.1, 0.6, 1.0));
const Region kInCorner = BoundingSphere{{3, 2, 1}, 0.7};

testing::Scene RoomWithChair() { return With(EmptyRoom(), Chair()); }

void Keep(const Region& region, const std::string& name, Session& session) {
  ASSERT_TRUE(session.map().mutable_info().kept_clear.Add({name, region}).ok());
}

/// What a client would send that leaves out points itself.
PanopticFrame CutOut(PanopticFrame frame, const std::vector<Region>& regions) {
  const PinholeCamera& camera = frame.camera->camera;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      float& depth_m = frame.camera->depth_m[static_cast<std::size_t>(v * camera.width_px + u)];
      const auto d = static_cast<double>(depth_m);
      const Eigen::Vector3d p_m = frame.T_map_sensor * Eigen::Vector3d((u - camera.cx_px) / camera.fx_px * d,
                                                                       (v - camera.cy_px) / camera.fy_px * d, d);
      for (const Region& region : regions) {
        if (Contains(region, p_m)) depth_m = 0;
      }
    }
  }
  return frame;
}

/// The same points as a scanner sends them.
PanopticFrame AsScan(PanopticFrame frame) {
  const DepthCameraData image = *frame.camera;
  const PinholeCamera& camera = image.camera;
  frame.camera.reset();
  LidarData& scan = frame.lidar.emplace();
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const auto pixel = static_cast<std::size_t>(v * camera.width_px + u);
      const auto d = static_cast<double>(image.depth_m[pixel]);
      if (d <= 0) continue;
      const Eigen::Vector3d p_m((u - camera.cx_px) / camera.fx_px * d, (v - camera.cy_px) / camera.fy_px * d, d);
      scan.points_m.push_back(p_m.cast<float>());
      scan.segments.push_back(image.segments[pixel]);
    }
  }
  return frame;
}

bool IsInAny(const std::vector<Region>& regions, BlockIndex block, int linear, const SubmapInfo& info) {
  const Eigen::Vector3d p_m = VoxelCentre(VoxelIn(block, linear), info.voxel_size_m);
  return std::any_of(regions.begin(), regions.end(), [&](const Region& region) { return Contains(region, p_m); });
}

struct Seen {
  int inside = 0, outside = 0;
};

/// Observed voxels of all submaps within the regions, and elsewhere.
Seen CountSeen(const MapSnapshot& map, const std::vector<Region>& regions) {
  Seen seen;
  for (const auto& submap : map.submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      for (int i = 0; entry.tsdf != nullptr && i < kBlockVoxels; ++i) {
        if (!entry.tsdf->IsObserved(i)) continue;
        ++(IsInAny(regions, entry.index, i, submap->info()) ? seen.inside : seen.outside);
      }
    }
  }
  return seen;
}

/// Voxels in the regions of which sensors are said to have seen past.
int CountDoubted(const MapSnapshot& map, const std::vector<Region>& regions) {
  int num_doubted = 0;
  for (const auto& submap : map.submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      for (int i = 0; entry.gone != nullptr && i < kBlockVoxels; ++i) {
        num_doubted += entry.gone->Count(i) > 0 && IsInAny(regions, entry.index, i, submap->info());
      }
    }
  }
  return num_doubted;
}

enum class Where { kInside, kOutside };

/// Whether every voxel of `a` inside or outside the regions is in `b` to the bit.
::testing::AssertionResult HoldsTheSame(Where where, const MapSnapshot& a, const MapSnapshot& b,
                                        const std::vector<Region>& regions) {
  for (const auto& submap : a.submaps()) {
    const Submap* other = b.Find(submap->id());
    for (const BlockEntry& entry : submap->blocks().entries()) {
      for (int i = 0; entry.tsdf != nullptr && i < kBlockVoxels; ++i) {
        if (!entry.tsdf->IsObserved(i)) continue;
        if (IsInAny(regions, entry.index, i, submap->info()) != (where == Where::kInside)) continue;
        const BlockEntry* found = other != nullptr ? other->blocks().Find(entry.index) : nullptr;
        const auto at = static_cast<std::size_t>(i);
        const bool is_same =
            found != nullptr && found->tsdf != nullptr && found->tsdf->distance_m[at] == entry.tsdf->distance_m[at] &&
            found->tsdf->weight[at] == entry.tsdf->weight[at] && found->tsdf->color[at] == entry.tsdf->color[at] &&
            (entry.labels == nullptr || entry.labels->Get(i) == found->labels->Get(i));
        if (!is_same) return ::testing::AssertionFailure() << "submap " << submap->id().value << " differs";
      }
    }
  }
  return ::testing::AssertionSuccess();
}

TEST(KeptClearRegions, HoldNothingAndTheWorldOutsideIsAsIfTheirPointsWereNeverSent) {
  const std::vector<Region> regions = {kAroundChair, kInCorner};
  Session kept, sent;
  Keep(kAroundChair, "chair", kept);
  Keep(kInCorner, "corner", kept);
  for (int i = 0; i < 12; ++i) {
    kept.Take(WalkFrame(RoomWithChair(), i));
    sent.Take(CutOut(WalkFrame(RoomWithChair(), i), regions));
  }
  for (const bool is_finished : {false, true}) {
    if (is_finished) {
      kept.builder().Finish();
      sent.builder().Finish();
    }
    const auto a = kept.Now(), b = sent.Now();
    const Seen seen = CountSeen(*a, regions);
    EXPECT_EQ(seen.inside, 0);
    EXPECT_GT(seen.outside, 10'000);
    EXPECT_EQ(seen.outside, CountSeen(*b, regions).outside);
    EXPECT_TRUE(HoldsTheSame(Where::kOutside, *a, *b, regions));
    EXPECT_TRUE(HoldsTheSame(Where::kOutside, *b, *a, regions));
    EXPECT_EQ(FindThing(*a, kChair), nullptr);
  }
}

TEST(KeptClearRegions, FillAgainOnceTheyAreLifted) {
  Session session;
  Keep(kAroundChair, "chair", session);
  session.Walk(RoomWithChair(), 6);
  EXPECT_EQ(CountSeen(*session.Now(), {kAroundChair}).inside, 0);
  ASSERT_TRUE(session.map().mutable_info().kept_clear.Lift("chair"));
  session.Walk(RoomWithChair(), 6);
  EXPECT_GT(CountSeen(*session.Now(), {kAroundChair}).inside, 1000);
  EXPECT_NE(FindThing(*session.Now(), kChair), nullptr);
}

TEST(KeptClearRegions, LeaveWhatIsThereAndKeepOutWhatWouldComeBackIntoAClearedPlace) {
  Session session;
  session.Walk(RoomWithChair(), 8);
  const SubmapId first = FindThing(*session.Now(), kChair)->id();
  session.map().Remove(first);  // deleted alone, it comes back as a new object
  session.Walk(RoomWithChair(), 6);
  const Submap* again = FindThing(*session.Now(), kChair);
  ASSERT_NE(again, nullptr);
  EXPECT_NE(again->id(), first);

  Keep(kAroundChair, "chair", session);
  const int before = CountSeen(*session.Now(), {kAroundChair}).inside;
  session.Walk(RoomWithChair(), 6);
  EXPECT_EQ(CountSeen(*session.Now(), {kAroundChair}).inside, before) << "what lies there stays";
  ClearRegion(
      kAroundChair, [](const SubmapInfo&) { return true; }, session.map());
  session.Walk(RoomWithChair(), 12);
  session.builder().Finish();
  EXPECT_EQ(CountSeen(*session.Now(), {kAroundChair}).inside, 0);
}

TEST(KeptClearRegions, HaveNothingInThemThatIsGoneForBeingLookedThrough) {
  for (const bool is_kept : {false, true}) {
    Session session;
    session.Walk(RoomWithChair(), 12);
    const SubmapId chair = FindThing(*session.Now(), kChair)->id();
    const int before = CountDoubted(*session.Now(), {kAroundChair});
    if (is_kept) Keep(kAroundChair, "chair", session);
    session.Walk(EmptyRoom(), 14);
    const auto after = session.Now();
    EXPECT_EQ(after->Find(chair)->IsAbsent(), !is_kept);
    if (is_kept) {
      EXPECT_EQ(CountDoubted(*after, {kAroundChair}), before);
    } else {
      EXPECT_GT(CountDoubted(*after, {kAroundChair}), before + 100);
    }
  }
}

TEST(KeptClearRegions, HaveNothingPutInThemThatAScannerCouldNotConfirm) {
  Session session;
  for (int i = 0; i < 2; ++i) session.Take(AsScan(WalkFrame(RoomWithChair(), i)));
  const auto before = session.Now();
  const Submap* chair = FindThing(*before, kChair);
  ASSERT_NE(chair, nullptr);
  ASSERT_FALSE(chair->info().is_confirmed);
  ASSERT_TRUE(Contains(kAroundChair, chair->BoundingSphereInMap().center_m));
  Keep(kAroundChair, "chair", session);
  for (int i = 2; i < 12; ++i) session.Take(AsScan(WalkFrame(RoomWithChair(), i)));
  const auto after = session.Now();
  EXPECT_NE(after->Find(chair->id()), nullptr) << "it stays an object";
  EXPECT_EQ(CountSeen(*after, {kAroundChair}).inside, CountSeen(*before, {kAroundChair}).inside);
  EXPECT_TRUE(HoldsTheSame(Where::kInside, *before, *after, {kAroundChair}));
}

TEST(KeptClearRegions, MayHoldAllThatAFrameShows) {
  Session session;
  Keep(BoundingSphere{{0, 0, 0}, 100}, "all", session);
  session.Walk(RoomWithChair(), 3);
  EXPECT_EQ(CountSeen(*session.Now(), {}).outside, 0);
  EXPECT_EQ(session.Now()->info().num_frames, 3);
  EXPECT_EQ(session.Now()->submaps().size(), 1u);
}

TEST(KeptClearRegions, HoldForObjectsThatHaveAGridOfTheirOwn) {
  Session session;
  session.Walk(RoomWithChair(), 8);
  const SubmapId id = FindThing(*session.Now(), kChair)->id();
  Submap& chair = *session.map().FindMutable(id);  // by less than a voxel, turned a little
  chair.mutable_info().T_map_submap =
      Eigen::Translation3d(0.004, 0.003, 0) * Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitZ());
  chair.mutable_info().is_placed = true;
  chair.mutable_info().track_id = kChair.value;
  const auto before = session.Now();
  Keep(kAroundChair, "chair", session);
  PanopticFrame beside = WalkFrame(With(EmptyRoom(), Box(kChair, {1.7, 0.2, 0.4}, {0.25, 0.6, 0.4})), 3);  // juts out
  beside.has_persistent_ids = true;
  session.Take(beside);
  const auto after = session.Now();
  ASSERT_GT(after->Find(id)->info().num_frames_observed, before->Find(id)->info().num_frames_observed);
  for (const BlockEntry& entry : after->Find(id)->blocks().entries()) {
    const BlockEntry* old = before->Find(id)->blocks().Find(entry.index);
    for (int i = 0; entry.tsdf != nullptr && i < kBlockVoxels; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Eigen::Vector3d p_m = after->Find(id)->info().T_map_submap *
                                  VoxelCentre(VoxelIn(entry.index, i), after->Find(id)->info().voxel_size_m);
      const float weight = old != nullptr && old->tsdf != nullptr ? old->tsdf->weight[at] : 0.0f;
      if (!Contains(kAroundChair, p_m)) continue;
      ASSERT_EQ(entry.tsdf->weight[at], weight);
    }
  }
}

}  // namespace
}  // namespace dhpmap
