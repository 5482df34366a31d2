// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "mapping/base/status.h"

namespace dhpmap {

/// A message with a frame, as it came.
struct ArrivedMessage {
  std::string bytes;            ///< empty: not kept
  std::int64_t arrived_ns = 0;  ///< UTC
};

/// A request that edits, as it came.
struct ArrivedEdit {
  std::string method = {};  ///< "EditService/ApplyEdits"
  std::string bytes = {};   ///< of the message; both are empty where it is not kept
};

/// Writes down what comes to a map, in the order in which its writer takes it: from the same messages the same map can
/// be made again. Called on the map's writer thread alone. What it cannot write it tells elsewhere: mapping goes on.
class FrameRecorder {
 public:
  virtual ~FrameRecorder() = default;

  /// Is about to be fused, after `num_frames` others of the map.
  virtual void OnFrame(const std::string& session, std::int64_t sequence, ArrivedMessage message,
                       std::int64_t num_frames) = 0;
  /// The last frame was refused: nothing has changed.
  virtual void OnRefused(const Status& why) = 0;
  /// With the last frame a refinement on the side was taken over.
  virtual void OnRefined() = 0;
  /// Somebody has edited the map, which is at `revision` then.
  virtual void OnEdited(std::int64_t revision, const ArrivedEdit& edit) = 0;
  /// MapBuilder::Finish is done.
  virtual void OnFinished() = 0;
};

}  // namespace dhpmap
