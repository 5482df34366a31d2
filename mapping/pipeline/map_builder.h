// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "mapping/base/result.h"
#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"
#include "mapping/pipeline/refinement_slots.h"
#include "mapping/plausibility/frame_check.h"
#include "mapping/refinement/refine_map.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// What became of one frame.
struct FrameReport {
  std::int64_t num_points = 0;          ///< valid and in range
  std::int64_t num_unknown_points = 0;  ///< of these, fused into the unknown submap
  int num_segments = 0;                 ///< of the frame's table, with at least one point
  int num_matched = 0;                  ///< segments associated with a submap there was
  int num_created = 0;                  ///< new submaps
  int num_dissolved = 0;                ///< submaps of wrong frames that went into the unknown submap
  int num_merged = 0;                   ///< submaps that became a part of another
  std::int64_t num_voxels_updated = 0;
  // Wall time by stage; of refinement only what the frame had to wait for: freezing, taking over.
  double bundle_s = 0, check_s = 0, track_s = 0, fuse_s = 0, free_s = 0, activity_s = 0, refine_s = 0;
  std::optional<RefinementReport> refinement;  ///< on the side, taken over at this frame
  [[nodiscard]] double total_s() const {
    return bundle_s + check_s + track_s + fuse_s + free_s + activity_s + refine_s;
  }
};

/// When the outcome of a refinement on the side is taken over, which is the refinement's next turn at the earliest.
enum class RefinementTiming {
  kReproducible,  ///< exactly then, waiting for it if need be: the same frames give the same map
  kNeverWait,     ///< then or as soon as it is ready: for servers. Differs only where refinement cannot keep up
};

/// What becomes of a frame that FrameCheck warns of.
enum class ImplausibleFrames { kFuse, kRefuse };

/// The mapping pipeline (paper Fig. 2): a posed panoptic frame goes in, a new state of the map comes out. The same
/// frames give a bit-identical map for any number of threads. Every refinement.every_frames frames what has settled is
/// refined on a thread of its own (see RefineMap), and taken over when its next turn comes. Thread-compatible: one
/// writer a map.
class MapBuilder {
 public:
  /// Frames are worked on by the threads of `pool`, which several maps may share.
  MapBuilder(MapInfo info, std::shared_ptr<ThreadPool> pool, RefinementTiming timing = RefinementTiming::kReproducible);
  /// Goes on mapping where the snapshot (published or loaded) stopped. With `slots`, which several maps may share, a
  /// refinement begins when one is free.
  MapBuilder(std::shared_ptr<const MapSnapshot> snapshot, std::shared_ptr<ThreadPool> pool,
             RefinementTiming timing = RefinementTiming::kReproducible,
             std::shared_ptr<RefinementSlots> slots = nullptr);
  /// The same with a pool of its own; `num_threads` 0 means one a core.
  MapBuilder(MapInfo info, int num_threads, RefinementTiming timing = RefinementTiming::kReproducible);
  MapBuilder(std::shared_ptr<const MapSnapshot> snapshot, int num_threads,
             RefinementTiming timing = RefinementTiming::kReproducible);
  ~MapBuilder();

  /// Fuses one frame, as a whole or not at all: on error the map is as it was before. INVALID_ARGUMENT for a frame that
  /// is not usable (see ValidateFrame) or beyond the grid; RESOURCE_EXHAUSTED for one that touches more than
  /// kMaxBlocksAFrame blocks, or for which memory does not suffice; INVALID_ARGUMENT, reason IMPLAUSIBLE_FRAME, for one
  /// that is to be refused as such; CANCELLED soon after `stop` is requested; INTERNAL for any other exception.
  Result<FrameReport> Integrate(const PanopticFrame& frame, const std::stop_token& stop = {},
                                ImplausibleFrames implausible = ImplausibleFrames::kFuse);
  /// What was found of the last frame that Integrate was called with, and may have refused; empty if it did not get so
  /// far, or when it was taken before. Whatever is found, the map is the same.
  FrameCheck TakeCheck();
  /// The next frame of the session begins a stream: its stamp need not be after those before it.
  void ForgetStamp(const std::string& session);

  /// Ends a mapping session: every thing becomes inactive, all is refined, empty blocks go, bounding spheres are tight,
  /// and the labels of voxels are dropped if the config says so. If it throws, for want of memory, the map is as
  /// before.
  RefinementReport Finish();
  /// The same, but if `is_cancelled`, which several threads ask now and then, says true, the map stays as it is, and
  /// there is no report.
  std::optional<RefinementReport> Finish(const std::function<bool()>& is_cancelled);

  /// All refinements of this builder so far, summed; times are those of their own threads.
  [[nodiscard]] const RefinementReport& refinement_total() const;

  /// The map for edits between frames, and for Publish.
  [[nodiscard]] Map& map();
  [[nodiscard]] const Map& map() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap
