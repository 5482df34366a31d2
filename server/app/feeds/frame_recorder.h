// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "mapping/base/status.h"

namespace dhpmap {

/// A received message with a frame.
struct ArrivedMessage {
  std::string bytes;            ///< empty: not recorded
  std::int64_t arrived_ns = 0;  ///< UTC
};

/// A received edit request.
struct ArrivedEdit {
  std::string method = {};  ///< "EditService/ApplyEdits"
  std::string bytes = {};   ///< of the message; both are empty if it is not recorded
};

/// Records the input of a map in the order of its writer, so that a replay gives the same map. Called only on the map's
/// writer thread. Reports its errors elsewhere: mapping continues.
class FrameRecorder {
 public:
  virtual ~FrameRecorder() = default;

  /// The frame is about to be fused, after `num_frames` others of the map.
  virtual void OnFrame(const std::string& session, std::int64_t sequence, ArrivedMessage message,
                       std::int64_t num_frames) = 0;
  /// The last frame was refused; the map is unchanged.
  virtual void OnRefused(const Status& why) = 0;
  /// A background refinement was merged with the last frame.
  virtual void OnRefined() = 0;
  /// An edit produced `revision`.
  virtual void OnEdited(std::int64_t revision, const ArrivedEdit& edit) = 0;
  /// MapBuilder::Finish is done.
  virtual void OnFinished() = 0;
};

}  // namespace dhpmap
