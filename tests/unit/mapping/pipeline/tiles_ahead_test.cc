// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/pipeline/tiles_ahead.h"

#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/paging/tile_directory.h"
#include "mapping/paging/tile_page.h"
#include "mapping/pipeline/map_builder.h"
#include "tests/support/map_equality.h"
#include "tests/unit/mapping/pipeline/ball_scene.h"

namespace dhpmap {
namespace {

using testing::BallInfo;

template <typename Layer>
std::shared_ptr<const Layer> CopyOf(const std::shared_ptr<const Layer>& layer) {
  return layer == nullptr ? nullptr : std::shared_ptr<const Layer>(new Layer(*layer));
}

/// Has the tiles of a submap, and may wait with each until another one is read, too.
class KeptTiles final : public TileSource {
 public:
  explicit KeptTiles(const Submap& submap) {
    for (const TileEntry& entry : submap.blocks().tiles()) tiles_[entry.index] = entry.tile;
  }

  Result<std::vector<BlockEntry>> Read(const TileOnDisk& tile) override {
    Meet();
    std::vector<BlockEntry> blocks;
    for (const BlockEntry& entry : tiles_.at(tile.index)->entries()) {
      BlockEntry& block = blocks.emplace_back(BlockEntry{.index = entry.index});
      block.tsdf = CopyOf(entry.tsdf);
      block.labels = CopyOf(entry.labels);
      block.gone = CopyOf(entry.gone);
    }
    return blocks;
  }

  /// Whether two reads have met; the first waits for that from now on.
  static bool HaveMet() {
    const MutexLock lock(mutex_);
    return have_met_;
  }
  static void WaitToMeet(bool do_wait) {
    const MutexLock lock(mutex_);
    do_wait_ = do_wait;
    have_met_ = false;
  }

 private:
  static void Meet() {
    constexpr std::chrono::seconds kPatience{20};  // only what fails needs it
    const MutexLock lock(mutex_);
    if (!do_wait_) return;
    have_met_ = have_met_ || ++num_inside_ == 2;
    if (have_met_) met_.NotifyAll();
    do_wait_ = met_.WaitFor(mutex_, kPatience, []() DHPMAP_REQUIRES(mutex_) { return have_met_; });
    --num_inside_;
  }

  static inline Mutex mutex_;
  static inline CondVar met_;
  static inline bool do_wait_ DHPMAP_GUARDED_BY(mutex_) = false;
  static inline bool have_met_ DHPMAP_GUARDED_BY(mutex_) = false;
  static inline int num_inside_ DHPMAP_GUARDED_BY(mutex_) = 0;

  std::map<TileIndex, std::shared_ptr<const BlockTile>> tiles_;
};

/// The same state with all voxels left on a disk.
std::shared_ptr<const MapSnapshot> OnDisk(const MapSnapshot& whole) {
  std::vector<std::shared_ptr<const Submap>> submaps;
  for (const auto& submap : whole.submaps()) {
    const auto source = std::make_shared<KeptTiles>(*submap);
    auto same = std::make_shared<Submap>(submap->info(), 0);
    same->set_bounding_sphere(submap->bounding_sphere());
    for (const TileEntry& entry : submap->blocks().tiles()) {
      TileOnDisk there{.index = entry.index, .store = 1};
      for (std::size_t i = 0; i < kNumBlockLayers; ++i) {
        there.cells[i] = entry.tile->CellsWith(static_cast<BlockLayer>(i));
        there.keys[i] = there.cells[i] != 0 ? 1 : 0;
      }
      same->PutTile(entry.index, std::make_shared<const BlockTile>(std::make_shared<const TilePage>(there, source)));
    }
    submaps.push_back(std::move(same));
  }
  return std::make_shared<const MapSnapshot>(whole.info(), std::move(submaps), whole.free_space(),
                                             VacatedSpace{whole.vacated()});
}

/// A ball on a floor, seen from one side or from the other.
PanopticFrame FrameFrom(double eye_y_m) { return testing::BallFrameFrom({0, eye_y_m, 1.2}, 0); }

std::shared_ptr<const MapSnapshot> MappedOnce() {
  MapBuilder builder(BallInfo(), 1);
  EXPECT_TRUE(builder.Integrate(FrameFrom(0)).ok());
  return builder.map().Publish(1);
}

bool IsRead(const Map& map, SubmapId submap, TileIndex tile) {
  return map.Find(submap)->blocks().FindTile(tile)->tile->IsRead();
}

TEST(TilesAhead, AMapOnTheDiskIsMappedFurtherAsOneInMemory) {
  const auto whole = MappedOnce();
  MapBuilder in_memory(whole, 2), on_disk(OnDisk(*whole), 2);
  for (const double eye_y_m : {0.5, -0.5}) {
    ASSERT_TRUE(in_memory.Integrate(FrameFrom(eye_y_m)).ok());
    ASSERT_TRUE(on_disk.Integrate(FrameFrom(eye_y_m)).ok());
    EXPECT_TRUE(testing::MapsAreEqual(*in_memory.map().Publish(2), *on_disk.map().Publish(2)));
  }
}

TEST(TilesAhead, AFrameReadsSeveralTilesAtATime) {
  MapBuilder builder(OnDisk(*MappedOnce()), 2);
  KeptTiles::WaitToMeet(true);
  const auto report = builder.Integrate(FrameFrom(0));
  EXPECT_TRUE(KeptTiles::HaveMet());
  KeptTiles::WaitToMeet(false);
  EXPECT_TRUE(report.ok());
}

TEST(TilesAhead, AreThoseInWhichItEndsAndMayWriteOfWhatLiesAsMapped) {
  // Two objects with the same tiles, of which one was moved; in each a tile at the origin, one beside it and one afar.
  MapInfo info = BallInfo();
  Map made(info);
  const TileIndex here{0, 0, 0}, beside{-1, 0, 0}, afar{9, 0, 0};
  for (int i = 0; i < 2; ++i) {
    Submap& thing = made.Create({.panoptic = Panoptic::kThing,
                                 .voxel_size_m = info.config.voxel_size_m,
                                 .truncation_m = info.config.truncation_m});
    for (const TileIndex tile : {here, beside, afar}) {
      TsdfBlock& block = thing.MutableTsdf({kTileSide * tile.x, 0, 0});
      block.weight[0] = 1;
    }
    thing.UpdateBoundingSphere();
    if (i == 1) thing.mutable_info().T_map_submap.translation().x() = 1;
  }
  const Map map(OnDisk(*made.Publish(1)));
  EXPECT_TRUE(HasTilesOnDisk(map));
  EXPECT_FALSE(HasTilesOnDisk(made));
  std::vector<SegmentBundles> segments(1);
  segments[0].FindOrInsert({0, 1, 1});
  ThreadPool pool(1);
  ReadTilesAhead(segments, map, pool);
  const SubmapId first = map.submaps()[1]->id(), moved = map.submaps()[2]->id();
  EXPECT_TRUE(IsRead(map, first, here));
  EXPECT_TRUE(IsRead(map, first, beside)) << "the band around the ends reaches there";
  EXPECT_FALSE(IsRead(map, first, afar));
  for (const TileIndex tile : {here, beside, afar}) EXPECT_FALSE(IsRead(map, moved, tile));
}

/// Of an object of which nothing can be read.
class LostDirectory final : public TileDirectory {
 public:
  Result<std::vector<Tile>> ReadAll() override { return DataLoss("all of it is lost"); }
  Result<std::shared_ptr<const BlockTile>> ReadOne(TileIndex) override { return DataLoss("all of it is lost"); }
  [[nodiscard]] bool HasFew() const override { return true; }
};

TEST(TilesAhead, AnObjectElsewhereThatCannotBeReadIsNoMatterOfAFrame) {
  const auto whole = MappedOnce();
  std::vector<std::shared_ptr<const Submap>> submaps = whole->submaps();
  SubmapInfo lost = submaps.back()->info();
  lost.id = whole->info().next_submap_id;
  auto elsewhere =
      std::make_shared<Submap>(lost, 0, std::make_shared<const UnreadTiles>(std::make_shared<LostDirectory>()));
  elsewhere->set_bounding_sphere({{40, 40, 1}, 0.5});
  submaps.push_back(std::move(elsewhere));
  MapInfo info = whole->info();
  info.next_submap_id++;
  MapBuilder builder(std::make_shared<const MapSnapshot>(info, submaps, whole->free_space(), VacatedSpace{}), 1);
  EXPECT_TRUE(HasTilesOnDisk(builder.map()));
  for (const double eye_y_m : {0.5, -0.5}) {
    const auto report = builder.Integrate(FrameFrom(eye_y_m));
    EXPECT_TRUE(report.ok()) << report.status().ToString();
  }
}

}  // namespace
}  // namespace dhpmap
