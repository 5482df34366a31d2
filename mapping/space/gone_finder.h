// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "mapping/base/cache_line.h"
#include "mapping/base/index_map.h"
#include "mapping/base/stopped.h"
#include "mapping/base/thread_pool.h"
#include "mapping/map/kept_clear.h"
#include "mapping/map/map.h"
#include "mapping/map/map_grid.h"
#include "mapping/space/gone_look.h"
#include "mapping/space/look_tiles.h"

namespace dhpmap {

/// Finds the surface voxels of a map's submaps that a view contradicts, and counts them (GoneBlock).
///
/// Tiles are tested in turn, by the number of the frame, until one of their voxels is counted. Tiles of things that the
/// frame has not observed, and of the unknown submap (parts of any object without a label), are tested every frame,
/// because there may be few views of a place that an object has left. Looking through a large part of a block's surface
/// counts twice. So does looking through surface of the unknown submap, if the same view looks through a thing that the
/// frame has not observed, in the same block or right beside it.
///
/// Never changes submaps that an edit has placed or locked, submaps on another grid than the map's, or voxels in
/// ignored regions, of which frames have no points. Reuses its buffers except a map of indices. Thread-compatible.
class GoneFinder {
 public:
  /// Returns the submaps with counted voxels, by ascending id. The result does not depend on the number of threads.
  /// Throws Stopped soon after a `stop` request.
  template <typename View>
  std::vector<SubmapId> Look(const View& view, const GridOrigin& origin, const Viewpoint& from, Map& map,
                             ThreadPool& pool, const std::stop_token& stop = {}) {
    const MapConfig& config = map.info().config;
    const float farther_by_vox = GoneLook<View>::FartherBy_vox(config.voxel_size_m, config.truncation_m);
    ListTiles(view, origin, tiles_, farther_by_vox);
    ListJobs(view.Reach().GrownBy(farther_by_vox), origin, from, map);
    NoteLeft(from, pool, stop);
    pool.ParallelFor(num_jobs_, [&](std::size_t i) {
      ThrowIfStopped(stop);
      Job& job = jobs_[i];
      const SubmapInfo& info = job.submap->info();
      job.found.clear();
      GoneLook<View>(view, origin, from, left_, info.voxel_size_m, info.truncation_m, job.found).Look(*job.tile);
      LeaveOutKeptClear(map.info().kept_clear, info, job.found);
    });
    return Count(from, map);
  }

 private:
  /// Contradictions of fewer voxels in a block do not count: noise affects single voxels, a departed object affects
  /// dozens.
  static constexpr int kLeastVoxels = 8;
  /// They count nevertheless if this many voxels of the block, in all submaps, are gone or contradicted: voxels at the
  /// border of a departed object belong to several submaps, a few to each.
  static constexpr int kLeastTogether = 12;

  /// The expectation for a submap.
  enum class Role : std::uint8_t {
    kStays,        ///< probably still there
    kMayHaveLeft,  ///< a thing that the frame has not observed
    kNameless,     ///< the unknown submap, which may have parts of any object
  };

  struct alignas(kCacheLineBytes) Job {
    SubmapId id;
    // Valid until the map is written to:
    const Submap* submap = nullptr;
    const BlockTile* tile = nullptr;
    bool has_counts = false;
    Role role = Role::kStays;
    std::vector<ContradictedBlock> found;
  };

  /// Removes voxels in ignored regions from `found`.
  static void LeaveOutKeptClear(const KeptClear& kept_clear, const SubmapInfo& info,
                                std::vector<ContradictedBlock>& found);
  /// The tiles of submaps that are in view.
  void ListJobs(const Box& reach, const GridOrigin& origin, const Viewpoint& from, const Map& map);
  /// `turn` is the frame's.
  void AddJobs(const Submap& submap, Role role, std::uint64_t turn);
  void AddJob(const Submap& submap, const TileEntry& entry, Role role, std::uint64_t turn);
  /// Reads the tiles with counts from disk if necessary.
  void NoteLeft(const Viewpoint& from, ThreadPool& pool, const std::stop_token& stop);
  void AddUp();
  [[nodiscard]] bool IsEnough(const ContradictedBlock& block) const;
  /// Whether the view looks through things of kMayHaveLeft in the block or right beside it.
  [[nodiscard]] bool IsByWhatLeaves(BlockIndex block) const;
  std::vector<SubmapId> Count(const Viewpoint& from, Map& map);

  std::vector<TileToLook> tiles_;  ///< in view
  IndexMap<TileIndex> in_view_;    ///< the same
  std::vector<Job> jobs_;          ///< entries beyond num_jobs_ are kept for their memory
  std::size_t num_jobs_ = 0;
  LeftBlocks left_;      ///< before the view
  LeftBlocks together_;  ///< including the view
  LeftBlocks leaving_;   ///< of this view alone, in things that the frame has not observed
};

}  // namespace dhpmap
