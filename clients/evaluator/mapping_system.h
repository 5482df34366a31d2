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

/// What a system says of the world: surfaces in the map frame, with a class and an instance at each vertex. Class and
/// instance 0 mean that it does not say. A system that keeps several maps of one place gives all their surfaces.
struct LabelledSurface {
  Mesh mesh;
  /// How sure the system is of an instance, 0..1, for average precision; absent = 1.
  std::map<std::uint32_t, float> instance_scores;
};

/// What a system says of some points, in their order: class and instance 0 where it does not say.
struct PointLabels {
  std::vector<std::uint16_t> classes;
  std::vector<std::uint32_t> instances;
};

/// Wall time spent, summed over a run.
struct SystemTimes {
  std::int64_t num_frames = 0;
  double integrate_s = 0;  ///< everything per frame but refinement
  double refine_s = 0;     ///< label management and CRF, while mapping (may be on a thread of its own) and at the end
  double finish_s = 0;     ///< Finish alone, refinement at the end included
};

/// A mapping system under evaluation: one map, fed frame by frame. Thread-compatible.
class MappingSystem {
 public:
  virtual ~MappingSystem() = default;
  /// As in the tables: dhp, dhp_no_refine, panmap, kimera, votes ...
  [[nodiscard]] virtual std::string name() const = 0;
  /// False: only classes; instances of its surface mean nothing.
  [[nodiscard]] virtual bool has_instances() const = 0;
  virtual Status Integrate(const PanopticFrame& frame) = 0;
  /// Ends the session. Called once, before Surface.
  virtual void Finish() = 0;
  [[nodiscard]] virtual LabelledSurface Surface() const = 0;
  /// What is at these points of the map frame, by the voxels that hold them, where these have a surface within the
  /// truncation: as who asks for a point is answered, not by the nearest surface. None: the system answers no points.
  [[nodiscard]] virtual std::optional<PointLabels> LabelsAt(std::span<const Eigen::Vector3f> /*points_m*/) const {
    return std::nullopt;
  }
  [[nodiscard]] virtual SystemTimes times() const = 0;
};

/// All that a system may know before the first frame.
struct SystemSetup {
  MapConfig config;  ///< preset of the data set
  std::shared_ptr<const LabelSet> label_set;
  int num_threads = 0;  ///< 0 = one a core
};

}  // namespace dhpmap::evaluator
