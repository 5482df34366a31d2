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

/// Score of a class.
struct ClassScore {
  ClassId class_id;
  float score = 0;  ///< 0..1
  bool operator==(const ClassScore&) const = default;
};

/// The class of the highest score (ties: the smaller id); nothing if none is above 0.
std::optional<ClassId> LikeliestClass(std::span<const ClassScore> scores);

/// One row of a frame's segment table: class and scores of a segment id.
struct SegmentInfo {
  SegmentId id;  ///< not 0, unique in its frame
  /// Empty: unknown object; its points go to the unknown submap.
  std::optional<ClassId> class_id;
  std::optional<float> score;  ///< 0..1; nothing if the network gives none
  /// Scores of several classes; empty if the network gives none. At most kMostClassScores, each class once, their sum
  /// at most 1.
  std::vector<ClassScore> class_scores;

  /// The network's confidence: the score, else the entry of class_scores for its class (0 if missing). Nothing without
  /// either.
  [[nodiscard]] std::optional<float> Sureness() const;
  /// Whether Sureness is known and below `min_score`.
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
  /// N, or empty = unknown: 1 for points that the camera does not see, so that their segment is that of an occluder.
  std::vector<std::uint8_t> is_hidden;
};

/// One posed frame with its panoptic segmentation (input of paper Fig. 2). Exactly one of camera and lidar is set.
struct PanopticFrame {
  std::int64_t stamp_ns = 0;  ///< the sensor's clock
  /// Camera: optical frame, z forward, x right, y down. LiDAR: the scanner's own frame.
  Transform T_map_sensor = Transform::Identity();
  std::vector<SegmentInfo> segments;
  std::string session;  ///< the client's name of the feed session; may be empty
  /// Ids mean the same object in every frame of the session (ground truth, or a tracking front end); else the tracker
  /// associates each segment anew (paper II-B).
  bool has_persistent_ids = false;
  /// Points whose id has no row in `segments` go to the unknown submap; else such an id is an error.
  bool unlisted_ids_are_unknown = false;

  std::optional<DepthCameraData> camera;
  std::optional<LidarData> lidar;
};

/// INVALID_ARGUMENT, naming every violation at once, for: a pose with non-finite entries, neither or both sensors, an
/// invalid camera, wrong image sizes, a segment id of 0 or given twice, a class outside the label set, a score outside
/// 0..1, invalid class scores, non-finite points, and an id without a row unless the frame allows it. Violations name
/// the members above: "camera.depth_m", "segments[3].score".
Status ValidateFrame(const PanopticFrame& frame, const LabelSet& label_set);

}  // namespace dhpmap
