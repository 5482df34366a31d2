// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/base/transform.h"
#include "mapping/plausibility/frame_check.h"
#include "server/app/feeds/sensor_path.h"

namespace dhpmap {

/// Statistics of a feed session since its map was opened.
struct FeedCounts {
  std::int64_t num_fused = 0, num_refused = 0, num_duplicates = 0;  ///< frames
  std::int64_t num_points = 0;                                      ///< of fused frames
  std::int64_t num_bytes = 0;                                       ///< of all messages, as received
  std::optional<std::int64_t> accepted_sequence;                    ///< of the last fused frame
  std::int64_t last_seen_ns = 0;                                    ///< time of the last message, UTC; 0 for none
  double frames_per_s = 0;                                          ///< over the last FeedTally::kRate_s
  std::int64_t num_implausible = 0;                                 ///< frames with a warning, fused or refused
  std::optional<FrameWarning> last_warning;                         ///< the first one of the newest of these
  std::int64_t num_plausible_since = 0;                             ///< checked frames after it
};

/// Collects these over successive streams of a session. Thread-safe.
class FeedTally {
 public:
  static constexpr std::int64_t kRate_s = 10;
  /// Limit of fused frames remembered for the rate; the rate is over at most this many.
  static constexpr std::size_t kMaxRemembered = 512;

  void OnMessage(std::size_t num_bytes, std::int64_t now_ns) DHPMAP_EXCLUDES(mutex_);
  void OnFused(std::int64_t sequence, std::int64_t num_points, std::int64_t now_ns,
               const Transform& T_map_sensor = Transform::Identity()) DHPMAP_EXCLUDES(mutex_);
  /// The warnings of a frame that was checked, fused or not; none: it is plausible.
  void OnChecked(const std::vector<FrameWarning>& warnings) DHPMAP_EXCLUDES(mutex_);
  void OnRefused() DHPMAP_EXCLUDES(mutex_);
  void OnDuplicate() DHPMAP_EXCLUDES(mutex_);

  /// 0 without any message.
  [[nodiscard]] std::int64_t last_seen_ns() const DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] FeedCounts Counts(std::int64_t now_ns) const DHPMAP_EXCLUDES(mutex_);
  /// Of fused frames.
  [[nodiscard]] SensorPath Path() const DHPMAP_EXCLUDES(mutex_);

 private:
  mutable Mutex mutex_;
  FeedCounts counts_ DHPMAP_GUARDED_BY(mutex_);  ///< except the rate
  SensorPath path_ DHPMAP_GUARDED_BY(mutex_);
  std::int64_t first_seen_ns_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::deque<std::int64_t> fused_ns_ DHPMAP_GUARDED_BY(mutex_);  ///< recent times, ascending
};

}  // namespace dhpmap
