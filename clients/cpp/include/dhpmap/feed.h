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

/// A pinhole camera without distortion; the centre of the upper left pixel is (0, 0).
struct Camera {
  int width_px = 0, height_px = 0;
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
};

/// The segmentation's entry for one id of a label image or scan.
struct Segment {
  std::uint32_t id = 0;                  ///< not 0
  std::optional<std::int32_t> class_id;  ///< in the map's label set; none: an unknown object
  std::optional<double> score;           ///< 0 to 1; none: unknown
};

/// Registered images of one camera, row by row from the upper left. The memory is read during Feed::Push only. Ids
/// without a segment count as unknown.
struct RgbdFrame {
  std::span<const float> depth_m;         ///< along the optical axis; 0 or NaN: no return
  std::span<const std::uint8_t> rgb;      ///< r, g, b for each pixel; or empty
  std::span<const std::uint16_t> labels;  ///< ids of segments, 0: none; or empty
  std::span<const Segment> segments;
  Pose T_map_camera;          ///< of the optical frame: x right, y down, z forward
  std::int64_t stamp_ns = 0;  ///< by the sensor's clock, ascending
};

/// One scan, in the LiDAR's frame. The memory is read during Feed::Push only.
struct LidarFrame {
  std::span<const float> points_m;             ///< x, y, z for each point
  std::span<const std::uint32_t> segment_ids;  ///< one for each point, 0: none; or empty
  std::span<const Segment> segments;
  std::span<const std::uint8_t> rgb;  ///< r, g, b for each point; or empty
  Pose T_map_lidar;
  std::int64_t stamp_ns = 0;  ///< by the sensor's clock, ascending
};

struct FeedOptions {
  std::string session;                    ///< the robot's name: 1 to 64 of A-Z a-z 0-9 . _ -
  Camera camera;                          ///< for RgbdFrame
  bool persistent_ids = false;            ///< a segment's id means the same object in every frame
  bool take_over = false;                 ///< ends all streams that feed the map now
  bool refuse_implausible = false;        ///< refuse implausible frames instead of fusing them with a warning
  double reconnect_s = 60;                ///< how long to wait for a lost connection
  double deadline_s = 60;                 ///< timeout of a call of the feed without messages from the server
  std::int64_t memory_bytes = 512 << 20;  ///< limit of frames that are not known to be stored
};

/// A frame that the server refused, or fused with a warning.
struct FrameNote {
  std::int64_t sequence = 0;
  bool is_refused = false;
  std::string reason;  ///< such as "BAD_IMAGE"; for warnings the fault, such as "POSE_INVERTED"
  std::string message;
};

struct FeedState {
  std::int64_t num_sent = 0;   ///< pushed frames
  std::int64_t num_fused = 0;  ///< frames that the server has reported as fused
  std::int64_t num_refused = 0;
  std::optional<std::int64_t> stored_sequence;  ///< the newest stored frame; all before it are stored, too
};

/// A feed session of one robot. Keeps frames until the server has stored them. After a lost connection or a restart of
/// the server it reconnects and sends missing frames again. Push and Close are for one thread; the rest is thread-safe.
class Feed {
 public:
  Feed(Feed&&) noexcept;
  Feed& operator=(Feed&&) noexcept;
  /// Closes the connection at once; frames that are not stored may be lost. Close waits for them.
  ~Feed();

  /// Returns the frame's sequence once there is space, before it is fused: up to eight frames are in flight.
  /// InvalidArgument for a wrong frame, before it is sent; the error that ended the feed, such as Aborted, reason
  /// FEED_TAKEN_OVER; DeadlineExceeded.
  Result<std::int64_t> Push(const RgbdFrame& frame);
  Result<std::int64_t> Push(const LidarFrame& frame);
  /// Waits until all frames are stored.
  Status Close();

  [[nodiscard]] FeedState state() const;
  /// Returns the notes since the last call: the newest 1,000.
  std::vector<FrameNote> TakeNotes();

 private:
  friend class Map;
  struct Impl;
  explicit Feed(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::client
