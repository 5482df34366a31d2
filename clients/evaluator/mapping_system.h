// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mapping/labels/label_set.h"
#include "mapping/map/map_config.h"
#include "mapping/mesh/mesh.h"
#include "mapping/sensor/frame.h"

namespace dhpmap::evaluator {

/// A system's output: surfaces in the map frame, with a class and an instance at each vertex; 0 means none. A system
/// with several maps of one place returns all their surfaces.
struct LabelledSurface {
  Mesh mesh;
  /// Confidence in an instance, 0..1, for average precision; 1 if missing.
  std::map<std::uint32_t, float> instance_scores;
};

/// A system's labels of points, in their order: class and instance 0 mean none.
struct PointLabels {
  std::vector<std::uint16_t> classes;
  std::vector<std::uint32_t> instances;
};

/// Wall-clock time, summed over a run.
struct SystemTimes {
  std::int64_t num_frames = 0;
  double integrate_s = 0;  ///< all work of frames except refinement
  double refine_s = 0;     ///< label management and CRF, while mapping (possibly on a separate thread) and at the end
  double finish_s = 0;     ///< Finish alone, with its refinement
};

/// A mapping system under evaluation: one map, fed frame by frame. Thread-compatible.
class MappingSystem {
 public:
  virtual ~MappingSystem() = default;
  /// Name in tables: dhp, dhp_no_refine, panmap, kimera, votes ...
  [[nodiscard]] virtual std::string name() const = 0;
  /// False: classes only; instances of its surface have no meaning.
  [[nodiscard]] virtual bool has_instances() const = 0;
  virtual Status Integrate(const PanopticFrame& frame) = 0;
  /// Ends the session. Called once, before Surface.
  virtual void Finish() = 0;
  [[nodiscard]] virtual LabelledSurface Surface() const = 0;
  /// The labels at points in the map frame, from the voxels that contain them, if these have a surface within the
  /// truncation. This is the answer of a point query, not the label of the nearest surface. Empty: the system has no
  /// point queries.
  [[nodiscard]] virtual std::optional<PointLabels> LabelsAt(std::span<const Eigen::Vector3f> /*points_m*/) const {
    return std::nullopt;
  }
  [[nodiscard]] virtual SystemTimes times() const = 0;
};

/// What a system knows before the first frame.
struct SystemSetup {
  MapConfig config;  ///< preset of the data set
  std::shared_ptr<const LabelSet> label_set;
  int num_threads = 0;  ///< 0: one per core
};

}  // namespace dhpmap::evaluator
