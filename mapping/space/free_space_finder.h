// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stop_token>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// Finds what a frame looks through, adds it to the map's free space, and counts it against the surfaces that are said
/// to be there (GoneBlock, GoneLook): what the map's config asks for of both. Whole cells of voxels are told by the
/// least and greatest range of the pixels before which they lie, so the cost goes with the surfaces in view, not with
/// the volume.
///
/// A voxel is called free if its centre lies nearer than the truncation before what the sensor measured in its
/// direction, and within integration.max_range_m; a return from beyond that range frees what lies before it, no return
/// frees nothing. How pixels and beams are taken: CameraView, LidarView. Keeps its buffers from frame to frame.
/// Thread-compatible.
class FreeSpaceFinder {
 public:
  FreeSpaceFinder();
  ~FreeSpaceFinder();
  FreeSpaceFinder(FreeSpaceFinder&&) noexcept;
  FreeSpaceFinder& operator=(FreeSpaceFinder&&) noexcept;

  /// The frame must be valid (ValidateFrame) and on the map's grid (CheckFrameIsOnGrid). The outcome has the same bits
  /// for any number of threads, and for any order of frames but for the tiles' stamps. If it throws, for want of
  /// memory, or Stopped soon after `stop` is requested, a part may have been added: see Map::Fork.
  /// Returns the submaps of which voxels were counted as looked through, by ascending id.
  std::vector<SubmapId> Look(const PanopticFrame& frame, Map& map, ThreadPool& pool, const std::stop_token& stop = {});

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;  ///< null before the first frame
};

}  // namespace dhpmap
