// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/channel.h>

#include <memory>
#include <string>
#include <vector>

#include "dhpmap/v1/mapping_service.pb.h"
#include "tests/rig/load/bulk_calls.h"

namespace dhpmap::rig {

/// A frame that must be refused, and what is wrong with it.
struct LyingFrame {
  std::string what;
  v1::IntegrateFramesRequest request;
};

/// Images whose heads say more than they hold, small files of many pixels, raw images of another size, tables of 10^6
/// rows, and depth noise that meets more blocks than a frame may, for a map of voxels of 5 mm.
std::vector<LyingFrame> LyingFrames();

/// Sends them all, from 8 streams at once, to a map that it makes for them. Whether each was refused with a reason of
/// the API, the map has no frame, and it could be deleted; otherwise says so. Takes less than 15 s.
bool SendLyingFrames(const Target& target);

}  // namespace dhpmap::rig
