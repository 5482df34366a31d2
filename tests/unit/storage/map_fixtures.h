// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <string_view>

#include "mapping/map/map.h"
#include "mapping/submap/submap_fields.h"

namespace dhpmap::testing {

/// Made maps, and comparison of maps that went through a store. Everything follows from the seed.
class MapGenerator {
 public:
  explicit MapGenerator(std::uint32_t seed) : random_(seed) {}

  int Below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(random_); }
  double Uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  MapInfo Info(const std::string& name) {
    MapInfo info;
    info.name = name;
    info.display_name = "Map \xC3\xA9 " + name;
    info.history_id = 1 + static_cast<std::uint64_t>(Below(1 << 30));
    info.config.voxel_size_m = 0.05;
    info.config.truncation_m = 0.2;
    info.config.tracking.iou_threshold = 0.1 + 1.0 / 3;
    info.create_time_ns = 1'700'000'000'123'456'789;
    info.sessions.Set({"robot-1:" + name, -7, 1'700'000'000'000'000'021});
    info.sessions.Set({"Robot.2", 4'000'000'000'123, 1'700'000'000'000'000'022});
    info.merged.Add(SubmapId(77), SubmapId(3));
    info.merged.Add(SubmapId(4'000'000'000u), SubmapId(1));
    info.pairs.AddEvidence(SubmapId(2), SubmapId(1), 1 + Below(40), -120, 120);
    info.pairs.AddEvidence(SubmapId(4), SubmapId(2), -1 - Below(40), -120, 120);
    info.pairs.SetVerdict(SubmapId(4), SubmapId(2), PairVerdict::kMustBeTwo);
    auto labels = LabelSet::Create({{ClassId(1), "chair", Panoptic::kThing, SizeClass::kSmall, {1, 2, 3}},
                                    {ClassId(9), "wall", Panoptic::kStuff, SizeClass::kLarge, {255, 254, 0}}});
    info.label_set = std::make_shared<const LabelSet>(std::move(labels).value());
    return info;
  }

  /// A noisy slanted plane through the block, observed on one side of it.
  void FillTsdf(TsdfBlock& block, double truncation_m) {
    const double slope = Uniform(-0.5, 0.5), offset = Uniform(-0.5, 0.5);
    for (int i = 0; i < kBlockVoxels; ++i) {
      const VoxelIndex v = VoxelIn({}, i);
      const double d = (v.z - 3.5 + slope * (v.x - 3.5)) / 8 + offset + Uniform(-0.02, 0.02);
      if (std::abs(d) > 1) continue;
      block.distance_m[i] = static_cast<float>(d * truncation_m);
      block.weight[i] = static_cast<float>(Uniform(0.01, 40));
      block.color[i] = {static_cast<std::uint8_t>(20 * v.x + Below(4)),
                        static_cast<std::uint8_t>(100 + 8 * v.y + Below(4)), static_cast<std::uint8_t>(Below(256))};
    }
  }

  /// Mostly one class; some voxels with many classes, other instances or huge counts.
  void FillLabels(LabelBlock& block) {
    for (int i = 0; i < kBlockVoxels; ++i) {
      const int kind = Below(20);
      if (kind < 4) continue;
      for (int n = Below(6); n >= 0; --n) block.AddObservation(i, ClassId(9));
      if (kind == 5) block.AddObservation(i, ClassId(1));
      if (kind == 6)
        block.Add(i,
                  {{{2, 70'000}, {3, 1}, {700, 2}}, {{kOwnInstance, 3}, {SeenInstance(SubmapId(17)), 4'000'000'000u}}});
      if (kind == 7) block.Set(i, {{}, {{kOwnInstance, 5}}});
    }
  }

  /// Voxels that were looked through up to three times.
  GoneBlock SomeGone() {
    GoneBlock gone;
    for (int n = 1 + Below(3); n > 0; --n) {
      VoxelMask voxels{};
      for (int k = 1 + Below(40); k > 0; --k)
        voxels[static_cast<std::size_t>(Below(8))] |= std::uint64_t{1} << Below(64);
      gone.Raise(voxels, {{Uniform(-9, 9), -0.0, 1e-300}, 1'600'000'000'000'000'000 + Below(1 << 30)});
    }
    return gone;
  }

  BlockIndex Index() { return {Below(6) - 3, Below(6) - 3, Below(6) - 3}; }

  void AddBlocks(Submap& submap, int count) {
    for (; count > 0; --count) {
      const BlockIndex index = Index();
      FillTsdf(submap.MutableTsdf(index), submap.info().truncation_m);
      if (submap.id() != kUnknownSubmap) FillLabels(submap.MutableLabels(index));
      if (submap.id() != kUnknownSubmap && index.x % 2 == 0) submap.MutableLabels(index).SetConcluded(77, true);
      if (Below(2)) submap.PutGone(index, std::make_shared<const GoneBlock>(SomeGone()));
    }
    submap.UpdateBoundingSphere();
  }

  Submap& AddSubmap(Map& map, int num_blocks) {
    SubmapInfo info;
    info.panoptic = Below(2) ? Panoptic::kThing : Panoptic::kStuff;
    info.class_id = ClassId(Below(2) ? 1 : 9);
    info.class_is_fixed = Below(2) != 0;
    info.display_name = "object " + std::to_string(Below(100));
    info.T_map_submap = Pose();
    info.voxel_size_m = map.info().config.voxel_size_m;
    info.truncation_m = map.info().config.truncation_m;
    info.class_counts = {{ClassId(1), 5'000'000'000u}, {ClassId(9), 77}};
    info.instance_confidence = static_cast<float>(Uniform(0, 1));
    info.activity = Below(2) ? Activity::kActive : Activity::kInactive;
    info.is_confirmed = Below(2) != 0;
    info.num_frames_observed = Below(1000);
    info.num_frames_missed = Below(5);
    info.num_frames_overlooked = Below(4);
    info.first_observed_ns = 1'600'000'000'000'000'001 + Below(9);
    info.last_observed_ns = 1'600'000'000'000'000'011 + Below(9);
    info.track_id = static_cast<std::uint32_t>(Below(3));
    info.sightings = SomeSightings(info.num_frames_observed);
    info.presence = Below(2) ? Presence::kPresent : Presence::kAbsent;
    info.last_contradicted_ns = 1'600'000'000'000'000'021 + Below(9);
    info.is_placed = Below(2) != 0;
    info.is_locked = info.num_frames_observed % 4 == 0;
    info.edited_revision = Below(100);
    Submap& submap = map.Create(info);
    AddBlocks(submap, num_blocks);
    return submap;
  }

  /// Of one of a few kinds.
  static Sightings SomeSightings(std::int64_t kind) {
    Sightings sightings;
    for (std::int64_t i = 0; i < kind % 3; ++i)
      sightings.OnSeen("robot-" + std::to_string((kind + 5 * i) % 4), 1 + kind);
    if (sightings.IsInSight()) sightings.OnMissed(sightings.all().front().session, 300 + kind);
    if (kind % 2 == 0) sightings.SetTrack(kind % 4 == 0 ? "" : "robot-9", 0x8000'0000u >> (kind % 32));
    return sightings;
  }

  /// Whole blocks and parts of blocks of a tile.
  void AddVoxels(FreeSpace& layer) {
    FreeBlocks seen;
    for (int n = 1 + Below(3); n > 0; --n) seen.full |= std::uint64_t{1} << Below(64);
    for (int n = Below(4); n > 0; --n) {
      const auto cell = static_cast<std::size_t>(Below(64));
      seen.mixed |= ~seen.full & std::uint64_t{1} << cell;
      for (std::uint64_t& word : seen.masks[cell]) word = std::uint64_t{random_()} << Below(33);
    }
    const TileIndex index{Below(4) - 2, Below(3) - 2, Below(2)};
    layer.Add(index, seen, 1'600'000'000'000'000'000 + Below(1 << 30));
  }

  Transform Pose() {
    Transform T = Transform::Identity();
    T.rotate(Eigen::AngleAxisd(Uniform(-3, 3), Eigen::Vector3d(Uniform(-1, 1), 1, Uniform(-1, 1)).normalized()));
    T.translation() = Eigen::Vector3d(Uniform(-9, 9), -0.0, 1e-300);
    return T;
  }

  /// One to four random writes to a map, as mapping and edits do them.
  void Change(Map& map) {
    MapInfo& info = map.mutable_info();
    info.num_frames += 1;
    info.pairs.AddEvidence(SubmapId(1), SubmapId(2 + static_cast<std::uint32_t>(Below(3))), Below(9) - 4, -120, 120);
    if (Below(4) == 0) info.merged.Add(SubmapId(1000 + static_cast<std::uint32_t>(info.num_frames)), SubmapId(1));
    info.sessions.Set({"run" + std::to_string(info.num_frames % 3), info.num_frames, 5 + info.num_frames});
    for (int n = 1 + Below(4); n > 0; --n) ChangeOnce(map);
    for (int n = Below(3); n > 0; --n) AddVoxels(map.mutable_free_space());
    for (int n = Below(2); n > 0; --n) AddVoxels(map.mutable_vacated());
    if (Below(8) == 0 && !map.free_space().empty()) {
      map.mutable_free_space().Erase(map.free_space().tiles().front().index);
    }
  }

 private:
  void ChangeOnce(Map& map) {
    const auto& submaps = map.submaps();
    const SubmapId id = submaps[static_cast<std::size_t>(Below(static_cast<int>(submaps.size())))]->id();
    switch (Below(9)) {
      case 0: AddSubmap(map, Below(4)); break;
      case 1: map.Clone(id); break;
      case 2: map.Remove(id); break;
      case 3: map.FindMutable(id)->mutable_info().T_map_submap = Pose(); break;
      case 4: map.FindMutable(id)->DropLabels(); break;
      case 8: map.FindMutable(id)->DropGone(); break;
      case 5: {
        Submap* submap = map.FindMutable(id);
        if (!submap->blocks().empty()) submap->EraseBlock(submap->blocks().entries().front().index);
        submap->UpdateBoundingSphere();
        break;
      }
      default: AddBlocks(*map.FindMutable(id), 1 + Below(3));
    }
  }

  std::mt19937 random_;
};

inline void ExpectSameTsdf(const TsdfBlock& expected, const TsdfBlock& actual, double distance_bound_m,
                           double weight_share) {
  for (int i = 0; i < kBlockVoxels; ++i) {
    ASSERT_EQ(expected.IsObserved(i), actual.IsObserved(i)) << "voxel " << i;
    if (!expected.IsObserved(i)) continue;
    ASSERT_NEAR(expected.distance_m[i], actual.distance_m[i], distance_bound_m) << "voxel " << i;
    ASSERT_NEAR(expected.weight[i], actual.weight[i], weight_share * expected.weight[i]) << "voxel " << i;
    ASSERT_EQ(expected.color[i], actual.color[i]) << "voxel " << i;
  }
}

/// All but the sightings, which changes do not tell of.
inline void ExpectSameInfo(const SubmapInfo& expected, const SubmapInfo& actual) {
  const auto expected_pose = expected.T_map_submap.matrix(), actual_pose = actual.T_map_submap.matrix();
  for (int i = 0; i < 16; ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(expected_pose(i / 4, i % 4)),
              std::bit_cast<std::uint64_t>(actual_pose(i / 4, i % 4)));
  }
  VisitSubmapFields([&](const auto& field) {
    if (std::string_view(field.name) == "sightings") return;
    EXPECT_TRUE(IsSameValue(field.Of(expected), field.Of(actual))) << field.name;
  });
}

inline void ExpectSameVoxels(const FreeSpace& expected, const FreeSpace& actual) {
  ASSERT_EQ(expected.tiles().size(), actual.tiles().size());
  for (const FreeTileEntry& entry : expected.tiles()) {
    const FreeTile* found = actual.Find(entry.index);
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(*entry.tile, *found);
  }
}

inline void ExpectSameMapInfo(const MapInfo& e, const MapInfo& a) {
  EXPECT_EQ(e.name, a.name);
  EXPECT_EQ(e.display_name, a.display_name);
  EXPECT_EQ(e.history_id, a.history_id);
  EXPECT_EQ(ConfigToText(e.config), ConfigToText(a.config));
  EXPECT_EQ(*e.label_set, *a.label_set);
  EXPECT_EQ(e.revision, a.revision);
  EXPECT_EQ(e.num_frames, a.num_frames);
  EXPECT_EQ(e.next_submap_id, a.next_submap_id);
  EXPECT_EQ(e.create_time_ns, a.create_time_ns);
  EXPECT_EQ(e.update_time_ns, a.update_time_ns);
  EXPECT_EQ(e.sessions, a.sessions);
  EXPECT_EQ(e.merged, a.merged);
  EXPECT_EQ(e.pairs, a.pairs);
  EXPECT_TRUE(e.kept_clear == a.kept_clear);
}

/// Equal, with distances within the store's contract of truncation / 4096.
inline void ExpectSameMap(const MapSnapshot& expected, const MapSnapshot& actual) {
  ExpectSameMapInfo(expected.info(), actual.info());
  ExpectSameVoxels(*expected.free_space(), *actual.free_space());
  ExpectSameVoxels(*expected.vacated(), *actual.vacated());
  ASSERT_EQ(expected.submaps().size(), actual.submaps().size());
  for (std::size_t s = 0; s < expected.submaps().size(); ++s) {
    const Submap &one = *expected.submaps()[s], &other = *actual.submaps()[s];
    SCOPED_TRACE("submap " + std::to_string(one.id().value));
    ExpectSameInfo(one.info(), other.info());
    EXPECT_TRUE(one.info().sightings == other.info().sightings);
    EXPECT_EQ(one.bounding_sphere().center_m, other.bounding_sphere().center_m);
    EXPECT_EQ(one.bounding_sphere().radius_m, other.bounding_sphere().radius_m);
    ASSERT_EQ(one.blocks().size(), other.blocks().size());
    for (const BlockEntry& entry : one.blocks().entries()) {
      const BlockEntry* found = other.blocks().Find(entry.index);
      ASSERT_NE(found, nullptr);
      ASSERT_EQ(entry.tsdf == nullptr, found->tsdf == nullptr);
      ASSERT_EQ(entry.labels == nullptr, found->labels == nullptr);
      if (entry.tsdf) ExpectSameTsdf(*entry.tsdf, *found->tsdf, one.info().truncation_m / 4096, 1.0 / 65536);
      EXPECT_TRUE(!entry.labels || *entry.labels == *found->labels);
      ASSERT_EQ(entry.gone == nullptr, found->gone == nullptr);
      EXPECT_TRUE(!entry.gone || *entry.gone == *found->gone);
    }
  }
}

}  // namespace dhpmap::testing
