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

/// Finds what a view contradicts of a map's submaps and counts it there (GoneBlock). Tiles take turns, by the number of
/// the frame, until something of them is counted, but for those of things that the same frame has not observed, and of
/// the unknown submap, which has what no prediction has named of anything: of what may have left there may be few
/// views. A look through much of what a block says of a surface counts as two, and so does one at what is nameless
/// where the same look goes through such things, in the block or right beside it. Submaps that somebody has put where
/// they are or has locked, and those on another grid than the map's, which were moved, are left alone, and so are
/// voxels in regions that are kept clear, of which no point is seen. Keeps its buffers but for a map of indices.
/// Thread-compatible.
class GoneFinder {
 public:
  /// Returns the submaps of which voxels were counted, by ascending id. The outcome does not depend on the number of
  /// threads. Throws Stopped soon after `stop` is requested.
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
  /// A frame that sees past fewer voxels of a block says nothing: noise strikes single ones, what leaves takes dozens.
  static constexpr int kLeastVoxels = 8;
  /// Unless so many of the block, in all submaps, are gone or seen past: voxels at the border of what leaves belong to
  /// other submaps, a few to each.
  static constexpr int kLeastTogether = 12;

  /// What a look has to find of a submap.
  enum class Role : std::uint8_t {
    kStays,        ///< is there, most likely
    kMayHaveLeft,  ///< a thing that the frame has not observed
    kNameless,     ///< the unknown submap, which has parts of anything
  };

  struct alignas(kCacheLineBytes) Job {
    SubmapId id;
    // Until the map is written to:
    const Submap* submap = nullptr;
    const BlockTile* tile = nullptr;
    bool has_counts = false;
    Role role = Role::kStays;
    std::vector<ContradictedBlock> found;
  };

  /// Takes the voxels of the submap that are kept clear out of what was found.
  static void LeaveOutKeptClear(const KeptClear& kept_clear, const SubmapInfo& info,
                                std::vector<ContradictedBlock>& found);
  /// The tiles of submaps that are in view.
  void ListJobs(const Box& reach, const GridOrigin& origin, const Viewpoint& from, const Map& map);
  /// `turn`: of the frame.
  void AddJobs(const Submap& submap, Role role, std::uint64_t turn);
  void AddJob(const Submap& submap, const TileEntry& entry, Role role, std::uint64_t turn);
  /// Reads what is on the disk of the tiles that have counts.
  void NoteLeft(const Viewpoint& from, ThreadPool& pool, const std::stop_token& stop);
  void AddUp();
  [[nodiscard]] bool IsEnough(const ContradictedBlock& block) const;
  /// Whether things that are leaving are looked through there or right beside it.
  [[nodiscard]] bool IsByWhatLeaves(BlockIndex block) const;
  std::vector<SubmapId> Count(const Viewpoint& from, Map& map);

  std::vector<TileToLook> tiles_;  ///< in view
  IndexMap<TileIndex> in_view_;    ///< the same
  std::vector<Job> jobs_;          ///< beyond num_jobs_ they are kept for their memory
  std::size_t num_jobs_ = 0;
  LeftBlocks left_;      ///< before the look
  LeftBlocks together_;  ///< after it, with what it says
  LeftBlocks leaving_;   ///< of the look alone, what goes through things that the frame has not observed
};

}  // namespace dhpmap
