// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stop_token>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// Finds the space that a frame looks through, adds it to the map's free space, and counts it against existing surfaces
/// there (GoneBlock, GoneLook); the map's config enables both. Whole cells of voxels are classified by the minimum and
/// maximum range of their pixels, so the cost depends on the surfaces in view, not on the volume.
///
/// A voxel is free if its centre lies more than the truncation in front of the measured point in its direction, and
/// within integration.max_range_m. A return beyond that range frees the space in front of it; a missing return frees
/// nothing. CameraView and LidarView define the pixels and beams. Reuses its buffers. Thread-compatible.
class FreeSpaceFinder {
 public:
  FreeSpaceFinder();
  ~FreeSpaceFinder();
  FreeSpaceFinder(FreeSpaceFinder&&) noexcept;
  FreeSpaceFinder& operator=(FreeSpaceFinder&&) noexcept;

  /// The frame must be valid (ValidateFrame) and on the map's grid (CheckFrameIsOnGrid). The result is the same to the
  /// bit for any number of threads and, except the tiles' stamps, for any order of frames. If it throws std::bad_alloc,
  /// or Stopped soon after a `stop` request, part of the frame may have been added: see Map::Fork. Returns the submaps
  /// with newly counted voxels, by ascending id.
  std::vector<SubmapId> Look(const PanopticFrame& frame, Map& map, ThreadPool& pool, const std::stop_token& stop = {});

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;  ///< null before the first frame
};

}  // namespace dhpmap
