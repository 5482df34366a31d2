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

/// Statistics of one frame.
struct FrameReport {
  std::int64_t num_points = 0;          ///< valid and in range
  std::int64_t num_unknown_points = 0;  ///< of these, fused into the unknown submap
  int num_segments = 0;                 ///< of the frame's table, with at least one point
  int num_matched = 0;                  ///< segments matched with existing submaps
  int num_created = 0;                  ///< new submaps
  int num_dissolved = 0;                ///< unconfirmed submaps dissolved into the unknown submap
  int num_merged = 0;                   ///< submaps merged into others
  std::int64_t num_voxels_updated = 0;
  // Wall time by stage; for refinement only the time that the frame waited: freezing and merging.
  double bundle_s = 0, check_s = 0, track_s = 0, fuse_s = 0, free_s = 0, activity_s = 0, refine_s = 0;
  std::optional<RefinementReport> refinement;  ///< background refinement merged at this frame
  [[nodiscard]] double total_s() const {
    return bundle_s + check_s + track_s + fuse_s + free_s + activity_s + refine_s;
  }
};

/// When to merge a background refinement; at its next turn at the earliest.
enum class RefinementTiming {
  kReproducible,  ///< exactly then, waiting if necessary: the same frames give the same map
  kNeverWait,     ///< then or as soon as it is ready: for servers. Differs only if refinement cannot keep up
};

/// Treatment of frames with FrameCheck warnings.
enum class ImplausibleFrames { kFuse, kRefuse };

/// The mapping pipeline (paper Fig. 2): takes a posed panoptic frame and produces a new state of the map. The same
/// frames give a bit-identical map for any number of threads. Every refinement.every_frames frames, inactive objects
/// are refined on a background thread (RefineMap), and the result is merged at its next turn. Thread-compatible: one
/// writer a map.
class MapBuilder {
 public:
  /// Works on the threads of `pool`, which several maps may share.
  MapBuilder(MapInfo info, std::shared_ptr<ThreadPool> pool, RefinementTiming timing = RefinementTiming::kReproducible);
  /// Continues mapping from the snapshot (published or loaded). With `slots`, which several maps may share, a
  /// refinement starts when one is free.
  MapBuilder(std::shared_ptr<const MapSnapshot> snapshot, std::shared_ptr<ThreadPool> pool,
             RefinementTiming timing = RefinementTiming::kReproducible,
             std::shared_ptr<RefinementSlots> slots = nullptr);
  /// The same with its own pool; `num_threads` 0 means one a core.
  MapBuilder(MapInfo info, int num_threads, RefinementTiming timing = RefinementTiming::kReproducible);
  MapBuilder(std::shared_ptr<const MapSnapshot> snapshot, int num_threads,
             RefinementTiming timing = RefinementTiming::kReproducible);
  ~MapBuilder();

  /// Fuses one frame atomically: on error the map is unchanged. INVALID_ARGUMENT for an invalid frame (ValidateFrame)
  /// or one beyond the grid; RESOURCE_EXHAUSTED for one that touches more than kMaxBlocksAFrame blocks or runs out of
  /// memory; INVALID_ARGUMENT, reason IMPLAUSIBLE_FRAME, for one refused as implausible; CANCELLED soon after a `stop`
  /// request; INTERNAL for any other exception.
  Result<FrameReport> Integrate(const PanopticFrame& frame, const std::stop_token& stop = {},
                                ImplausibleFrames implausible = ImplausibleFrames::kFuse);
  /// The check of the last frame passed to Integrate, fused or refused; empty if it did not get that far, or was taken
  /// before. The check does not affect the map.
  FrameCheck TakeCheck();
  /// The session's next frame starts a stream: its stamp may be earlier than before.
  void ForgetStamp(const std::string& session);

  /// Finishes mapping: deactivates every thing, refines all, removes empty blocks, tightens bounding spheres, and drops
  /// voxel labels if configured. If it throws std::bad_alloc, the map is unchanged.
  RefinementReport Finish();
  /// The same, but if `is_cancelled`, polled by several threads, returns true, the map is unchanged and there is no
  /// report.
  std::optional<RefinementReport> Finish(const std::function<bool()>& is_cancelled);

  /// Sum of all refinements of this builder; times are those of their own threads.
  [[nodiscard]] const RefinementReport& refinement_total() const;

  /// The map for edits between frames, and for Publish.
  [[nodiscard]] Map& map();
  [[nodiscard]] const Map& map() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap
