// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "mapping/map/map.h"
#include "mapping/sensor/frame.h"

namespace dhpmap::testing {

/// Analytic solids with exact signed distance, from which frames are rendered: the truth that tests compare with.
struct Solid {
  enum class Shape { kSphere, kBox, kHalfSpace };
  Shape shape = Shape::kSphere;
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();  ///< of a sphere or box; a point of a half space's face
  Eigen::Vector3d size_m = Eigen::Vector3d::Ones();    ///< sphere: radius in x; box: half extents; half space: normal
  std::uint32_t segment = 1;                           ///< id rendered for it
  Color color{128, 128, 128};

  [[nodiscard]] double Distance(const Eigen::Vector3d& p) const;
};

struct Scene {
  std::vector<Solid> solids;
  /// Signed distance to the union, and the nearest solid.
  [[nodiscard]] double Distance(const Eigen::Vector3d& p) const;
  [[nodiscard]] const Solid* Nearest(const Eigen::Vector3d& p) const;
};

/// 160 x 120 pixels, 90 degrees wide.
PinholeCamera SmallCamera();

/// Camera at `eye` that looks at `target`, image y down, map z up.
Transform LookAt(const Eigen::Vector3d& eye_m, const Eigen::Vector3d& target_m);

/// Depth, colour and segment ids of what the camera sees, exact to 0.1 mm; pixels that hit nothing within 20 m are 0.
/// `frame.segments` is left empty.
PanopticFrame Render(const Scene& scene, const PinholeCamera& camera, const Transform& T_map_camera);

/// Classes 1..num_things are things, the next num_stuff are stuff.
std::shared_ptr<const LabelSet> MakeLabelSet(int num_things, int num_stuff);

/// A fresh folder below the system's temporary one, removed at the end of life.
class TempDir {
 public:
  TempDir();
  ~TempDir();
  TempDir(const TempDir&) = delete;
  TempDir& operator=(const TempDir&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The developers' data, or an empty path where it is not there; tests on it then skip with a message.
std::filesystem::path SharedDataDir();

}  // namespace dhpmap::testing
