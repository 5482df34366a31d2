// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/base/status.h"
#include "mapping/base/transform.h"
#include "mapping/labels/label_set.h"
#include "mapping/sensor/pinhole_camera.h"

namespace dhpmap {

/// How likely a class is.
struct ClassScore {
  ClassId class_id;
  float score = 0;  ///< 0..1
  bool operator==(const ClassScore&) const = default;
};

/// The likeliest (of equals, the smaller id); nothing if none is above 0.
std::optional<ClassId> LikeliestClass(std::span<const ClassScore> scores);

/// One row of a frame's segment table: what the panoptic segmentation says of a segment id.
struct SegmentInfo {
  SegmentId id;  ///< not 0, unique in its frame
  /// Empty: the object is not known; its points go to the unknown submap.
  std::optional<ClassId> class_id;
  std::optional<float> score;  ///< 0..1; nothing where the network gives none
  /// How likely each class is; empty where the network does not say. At most kMostClassScores, of different classes, in
  /// sum at most 1.
  std::vector<ClassScore> class_scores;

  /// How sure the network is: the score, or, where it gives none, what class_scores have for its class, which may be 0.
  /// Nothing if it says neither.
  [[nodiscard]] std::optional<float> Sureness() const;
  /// The network itself is less sure of it.
  [[nodiscard]] bool IsDoubtful(double min_score) const;
};

inline constexpr std::size_t kMostClassScores = 64;

/// Images of one depth camera, registered to each other: same size, row-major, width * height values.
struct DepthCameraData {
  PinholeCamera camera;
  std::vector<float> depth_m;           ///< along the optical axis; 0, negative, NaN or infinite = no return
  std::vector<Color> color;             ///< empty = grey
  std::vector<std::uint32_t> segments;  ///< segment id a pixel; empty = nothing is labelled
};

/// One LiDAR scan in the sensor frame, N points.
struct LidarData {
  std::vector<Eigen::Vector3f> points_m;
  std::vector<Color> color;             ///< N, or empty = grey
  std::vector<std::uint32_t> segments;  ///< N, or empty = nothing is labelled
  /// N, or empty = none known: 1 for points whose segment was read off an image that shows something before them.
  std::vector<std::uint8_t> is_hidden;
};

/// One posed frame with its panoptic segmentation (input of paper Fig. 2). Exactly one of camera and lidar is set.
struct PanopticFrame {
  std::int64_t stamp_ns = 0;  ///< the sensor's clock
  /// Camera: optical frame, z forward, x right, y down. LiDAR: the scanner's own frame.
  Transform T_map_sensor = Transform::Identity();
  std::vector<SegmentInfo> segments;
  std::string session;  ///< the client's name for the frames that this is one of; empty: none
  /// Ids mean the same object in every frame of the session (ground truth, or a tracking front end); else the tracker
  /// associates each segment anew (paper II-B).
  bool has_persistent_ids = false;
  /// Points whose id has no row in `segments` go to the unknown submap; else such an id is an error.
  bool unlisted_ids_are_unknown = false;

  std::optional<DepthCameraData> camera;
  std::optional<LidarData> lidar;
};

/// INVALID_ARGUMENT, naming every violation at once, for: a pose with non-finite entries, neither or both sensors, a
/// camera that is not usable, image sizes that do not fit, a segment id of 0 or given twice, a class outside the label
/// set, a score outside 0..1, class scores that are none, non-finite points, and an id without a row unless the frame
/// allows it. Violations name the members above: "camera.depth_m", "segments[3].score".
Status ValidateFrame(const PanopticFrame& frame, const LabelSet& label_set);

}  // namespace dhpmap
