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
  bool is_reproducible = false;                                ///< see RecordStart
  std::function<std::int64_t()> now_ns;                        ///< UTC; empty = the system's clock
  std::function<void(const std::string& message)> on_stopped;  ///< says why nothing more is recorded; may be empty
};

/// Begins a file in `dir` for what comes to `map` from now on. Null, with `on_stopped` told why, if that is not
/// possible. When the folder is full, or cannot be written to, recording stops for good with one more message. `dir`
/// outlives it.
std::unique_ptr<FrameRecorder> RecordMap(const MapInfo& map, RecordDir& dir, RecorderOptions options);

}  // namespace dhpmap
