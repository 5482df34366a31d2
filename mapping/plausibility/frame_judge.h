// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <list>
#include <optional>
#include <string>

#include "mapping/map/map.h"
#include "mapping/plausibility/earlier_view.h"
#include "mapping/plausibility/frame_check.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// Checks, before fusion, whether a frame fits the map and earlier frames of its session, and if not, which mistake of
/// the client explains it. Warns only on evidence: a frame in unknown space raises no doubt. Constant cost, on a sample
/// of the frame; does not change the map. Thread-compatible.
class FrameJudge {
 public:
  /// The frame must be valid; it becomes part of its session's history. Throws StatusError if tiles of the map cannot
  /// be read.
  FrameCheck Judge(const PanopticFrame& frame, const Map& map);
  /// Call after fusion: the next stamp should be later than this frame's.
  void NoteFused(const PanopticFrame& frame);
  /// Allows any stamp for the session's next frame.
  void ForgetStamp(const std::string& session);

 private:
  /// Recent frames of a session.
  struct Session {
    std::string name;
    std::optional<std::int64_t> last_stamp_ns;
    std::deque<EarlierView> views;  ///< from distinct places, the newest last

    void Remember(const PanopticFrame& frame);
  };

  Session& SessionOf(const std::string& name);

  std::list<Session> sessions_;  ///< most recently used first
};

}  // namespace dhpmap
