// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/labels/label_set.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

enum class LabelSource { kPredicted, kGroundTruth, kNone };

/// Detect the format from the files: see OpenDataset.
inline constexpr const char* kAnyFormat = "auto";

struct DatasetOptions {
  /// For LiDAR scans with SemanticKITTI labels: leave out points that are unlabelled or moving.
  bool drop_moving_points = true;
  /// If moving points are kept: remove their labels from the ground truth.
  bool unlabel_moving_points = false;
};

/// An image file as it is on disk.
struct ImageFile {
  std::vector<std::byte> bytes;  ///< empty: no image
  double scale_m = 0;            ///< metres a unit of integer depth
};

/// One frame of a data set, with undecoded images, so that a client can pass them on.
struct DatasetFrame {
  std::string id;  ///< as in the file names
  std::int64_t stamp_ns = 0;
  Eigen::Matrix4d T_map_sensor = Eigen::Matrix4d::Identity();  ///< as read; not checked to be rigid
  std::vector<SegmentInfo> segments;

  struct DepthCamera {
    PinholeCamera camera;
    ImageFile depth, color, segments;
  };
  struct Lidar {
    std::vector<Eigen::Vector3f> points_m;
    std::vector<std::uint32_t> segments;  ///< one per point; empty if they come from the image
    // A camera next to the scanner (see LidarCamera); 0 x 0 without one.
    Eigen::Matrix<double, 3, 4> P_image_lidar = Eigen::Matrix<double, 3, 4>::Zero();
    int image_width_px = 0;
    int image_height_px = 0;
    ImageFile color, segment_image;
  };
  std::optional<DepthCamera> camera;
  std::optional<Lidar> lidar;
};

/// A recorded data set, read lazily. Thread-compatible.
class Dataset {
 public:
  virtual ~Dataset() = default;
  /// The classes of the segments; empty for LabelSource::kNone.
  [[nodiscard]] virtual const std::vector<LabelClass>& label_classes() const = 0;
  /// The preset of MapConfig for the sensor: "indoor" or "outdoor_lidar".
  [[nodiscard]] virtual std::string preset() const = 0;
  /// Whether a segment id means the same object in every frame (ground truth).
  [[nodiscard]] virtual bool has_persistent_ids() const = 0;
  [[nodiscard]] virtual std::size_t num_frames() const = 0;
  /// On an error skip the frame. The error's reason() is its kind: MISSING_FILE, BAD_POSE, BAD_LABELS, BAD_SCAN,
  /// BAD_IMAGE or NO_MATCH (no record close enough in time).
  virtual Result<DatasetFrame> Read(std::size_t index) = 0;
};

/// "predicted", "groundtruth" or "none"; INVALID_ARGUMENT for anything else.
Result<LabelSource> ParseLabelSource(const std::string& name);

/// Decodes the images of a frame, for programs that map in process. Ids without a row in the frame's table count as
/// unknown. INVALID_ARGUMENT for a pose that is not rigid, and for images that cannot be decoded.
Result<PanopticFrame> DecodeFrame(const DatasetFrame& frame, bool has_persistent_ids);

}  // namespace dhpmap
