// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "mapping/map/map.h"
#include "server/app/feeds/frame_recorder.h"
#include "server/record/record_dir.h"

namespace dhpmap {

struct RecorderOptions {
  bool is_reproducible = false;          ///< see RecordStart
  std::function<std::int64_t()> now_ns;  ///< UTC; empty: the system's clock
  std::function<void(const std::string& message)>
      on_stopped;  ///< called with the reason when recording stops; may be empty
};

/// Starts a file in `dir` with all further input of `map`. Null, after calling `on_stopped`, if that fails. Recording
/// stops permanently, with a final message, when the folder is full or not writable. `dir` must outlive the recorder.
std::unique_ptr<FrameRecorder> RecordMap(const MapInfo& map, RecordDir& dir, RecorderOptions options);

}  // namespace dhpmap
