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

/// Tells before a frame is fused whether it fits the map and the frames of its session before it, and if it does not,
/// what the client has probably mistaken. Warns only of what it has evidence for: a frame that meets nothing known is
/// not doubted. Costs a sample of the frame, however large that is, and changes nothing of the map. Thread-compatible.
class FrameJudge {
 public:
  /// The frame is valid, and known from now on as one of its session. Throws StatusError where tiles of the map cannot
  /// be read.
  FrameCheck Judge(const PanopticFrame& frame, const Map& map);
  /// The frame is fused: the next one's stamp should be after its.
  void NoteFused(const PanopticFrame& frame);
  /// The next frame of the session may have any stamp.
  void ForgetStamp(const std::string& session);

 private:
  /// What the last frames of a session were like.
  struct Session {
    std::string name;
    std::optional<std::int64_t> last_stamp_ns;
    std::deque<EarlierView> views;  ///< from places apart, the newest last

    void Remember(const PanopticFrame& frame);
  };

  Session& SessionOf(const std::string& name);

  std::list<Session> sessions_;  ///< those heard of last come first
};

}  // namespace dhpmap
