// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dhpmap/geometry.h"
#include "dhpmap/result.h"

namespace dhpmap::client {

/// A pinhole camera without distortion; the centre of the upper left pixel is 0, 0.
struct Camera {
  int width_px = 0, height_px = 0;
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
};

/// What the panoptic segmentation says of one id of a label image or scan.
struct Segment {
  std::uint32_t id = 0;                  ///< not 0
  std::optional<std::int32_t> class_id;  ///< of the map's label set; none: an unknown object
  std::optional<double> score;           ///< 0 to 1; none: none is known
};

/// Images of one camera that belong together pixel by pixel, row by row from the upper left. The memory is read during
/// Feed::Push only. Ids without a segment count as unknown.
struct RgbdFrame {
  std::span<const float> depth_m;         ///< along the optical axis; 0 or NaN: no return
  std::span<const std::uint8_t> rgb;      ///< r, g, b a pixel; or empty
  std::span<const std::uint16_t> labels;  ///< ids of segments, 0: none; or empty
  std::span<const Segment> segments;
  Pose T_map_camera;          ///< of the optical frame: x right, y down, z forward
  std::int64_t stamp_ns = 0;  ///< of the sensor's clock, ascending
};

/// One scan, in the LiDAR's frame. The memory is read during Feed::Push only.
struct LidarFrame {
  std::span<const float> points_m;             ///< x, y, z a point
  std::span<const std::uint32_t> segment_ids;  ///< one a point, 0: none; or empty
  std::span<const Segment> segments;
  std::span<const std::uint8_t> rgb;  ///< r, g, b a point; or empty
  Pose T_map_lidar;
  std::int64_t stamp_ns = 0;  ///< of the sensor's clock, ascending
};

struct FeedOptions {
  std::string session;                    ///< the robot's name: 1 to 64 of A-Z a-z 0-9 . _ -
  Camera camera;                          ///< of RgbdFrame
  bool persistent_ids = false;            ///< a segment's id means the same object in every frame
  bool take_over = false;                 ///< ends all that feed the map now
  bool refuse_implausible = false;        ///< frames are refused rather than warned of
  double reconnect_s = 60;                ///< so long a lost connection is waited for
  double deadline_s = 60;                 ///< a call of the feed fails after so long without a word of the server
  std::int64_t memory_bytes = 512 << 20;  ///< of frames that are not known to be stored
};

/// What the server says of a frame that it refused, or doubts and has fused all the same.
struct FrameNote {
  std::int64_t sequence = 0;
  bool is_refused = false;
  std::string reason;  ///< such as "BAD_IMAGE"; of doubts the fault, such as "POSE_INVERTED"
  std::string message;
};

struct FeedState {
  std::int64_t num_sent = 0;   ///< pushed
  std::int64_t num_fused = 0;  ///< that the server has said to be fused
  std::int64_t num_refused = 0;
  std::optional<std::int64_t> stored_sequence;  ///< the newest frame that is stored, with all before it
};

/// A session of frames of one robot. Frames are kept until the server has stored them: a lost connection, or a server
/// that starts anew, is waited for, and what it lacks is sent again. Push and Close are for one thread; the rest is
/// safe from any.
class Feed {
 public:
  Feed(Feed&&) noexcept;
  Feed& operator=(Feed&&) noexcept;
  /// Ends the connection at once; what is not stored may be lost. Close waits for it.
  ~Feed();

  /// Returns the frame's sequence once there is room, before it is fused: eight are on their way at once.
  /// InvalidArgument for what is wrong with it, before it is sent; what has ended the feed, such as Aborted, reason
  /// FEED_TAKEN_OVER; DeadlineExceeded.
  Result<std::int64_t> Push(const RgbdFrame& frame);
  Result<std::int64_t> Push(const LidarFrame& frame);
  /// Waits until all is stored.
  Status Close();

  [[nodiscard]] FeedState state() const;
  /// What was said of frames since the last call: the newest 1,000.
  std::vector<FrameNote> TakeNotes();

 private:
  friend class Map;
  struct Impl;
  explicit Feed(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::client
