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

/// A part of a file, passed to a callback on the calling thread.
struct FilePart {
  std::string_view data;         ///< valid during the call
  std::int64_t total_bytes = 0;  ///< of the whole file
};
/// Receives the next part; false cancels the call, which returns Cancelled.
using TakePart = std::function<bool(const FilePart& part)>;

/// A complete file.
struct FileInfo {
  std::int64_t num_bytes = 0;
  std::int64_t revision = 0;  ///< revision of its content; 0 for files of maps
  std::string etag;           ///< of GLB: equal for equal files
};

struct MeshOptions {
  enum class Format { kPly, kPcd, kGlb };
  enum class Coloring { kSensor, kByClass, kByObject };

  Format format = Format::kPly;
  std::optional<std::int64_t> object;  ///< only this object; kGlb uses its own frame
  Coloring coloring = Coloring::kSensor;
  std::int64_t revision = 0;  ///< a past revision; 0: the current state
  double deadline_s = 600;
};

/// The voxels of an object, as columns of equal length. A value.
struct Voxels {
  std::int64_t revision = 0;
  std::vector<Vector3> center_m;  ///< in the map frame
  std::vector<float> tsdf_m;      ///< distance along sensor rays, negative behind the surface
  std::vector<float> weight;
  std::vector<std::array<std::uint8_t, 3>> rgb;
  std::vector<std::int32_t> class_id;   ///< the most frequent class; -1: none
  std::vector<float> class_confidence;  ///< share of the observations with this class
};

struct VoxelOptions {
  double max_abs_tsdf_m = 0;  ///< maximum distance from the surface; 0: all observed voxels
  std::int64_t revision = 0;  ///< a past revision; 0: the current state
  double deadline_s = 600;
};

}  // namespace dhpmap::client
