// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dhpmap/geometry.h"

namespace dhpmap::client {

/// A file that comes in parts, on the calling thread.
struct FilePart {
  std::string_view data;         ///< valid during the call
  std::int64_t total_bytes = 0;  ///< of the whole file
};
/// Takes the next part; false: no more are wanted, and the call is Cancelled.
using TakePart = std::function<bool(const FilePart& part)>;

/// A file that came as a whole.
struct FileInfo {
  std::int64_t num_bytes = 0;
  std::int64_t revision = 0;  ///< that it shows; of files of maps 0
  std::string etag;           ///< of GLB: equal for equal files
};

struct MeshOptions {
  enum class Format { kPly, kPcd, kGlb };
  enum class Coloring { kSensor, kByClass, kByObject };

  Format format = Format::kPly;
  std::optional<std::int64_t> object;  ///< only this one; of kGlb in its own frame
  Coloring coloring = Coloring::kSensor;
  std::int64_t revision = 0;  ///< as it was then; 0: as it is
  double deadline_s = 600;
};

/// The voxels of an object, a column each, all of one length. A value.
struct Voxels {
  std::int64_t revision = 0;
  std::vector<Vector3> center_m;  ///< in the map's frame
  std::vector<float> tsdf_m;      ///< distance along the rays of sensors, negative behind the surface
  std::vector<float> weight;
  std::vector<std::array<std::uint8_t, 3>> rgb;
  std::vector<std::int32_t> class_id;   ///< the most frequent one; -1: none
  std::vector<float> class_confidence;  ///< share of the observations that said so
};

struct VoxelOptions {
  double max_abs_tsdf_m = 0;  ///< only voxels so near the surface; 0: all that were observed
  std::int64_t revision = 0;  ///< as it was then; 0: as it is
  double deadline_s = 600;
};

}  // namespace dhpmap::client
