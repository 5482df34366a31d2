// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "mapping/base/guarded.h"
#include "mapping/map/map.h"
#include "server/app/feeds/frame_recorder.h"

namespace dhpmap {

/// Called before the first frame is fused; empty, or a null result: nothing is recorded.
using MakeRecorder = std::function<std::unique_ptr<FrameRecorder>(const MapInfo& map)>;

/// The recorder of a map, created with its first frame. Writer thread only, except is_wanted.
class MapRecording {
 public:
  explicit MapRecording(MakeRecorder make) : make_(std::move(make)) {}

  /// Whether to keep messages until they are recorded. Thread-safe.
  [[nodiscard]] bool is_wanted() const { return make_ != nullptr; }

  void Begin(const MapInfo& map) {
    if (!recorder_) recorder_ = make_ ? make_(map) : nullptr;
  }
  [[nodiscard]] bool is_recorded() const { return recorder_ && *recorder_; }

  /// Runs `tell` on the recorder, if there is one; drops its exceptions.
  template <typename Tell>
  void Note(Tell&& tell) {
    if (is_recorded()) TellSafely([&] { std::forward<Tell>(tell)(**recorder_); });
  }

 private:
  const MakeRecorder make_;
  std::optional<std::unique_ptr<FrameRecorder>> recorder_;
};

}  // namespace dhpmap
