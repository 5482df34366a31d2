// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>

#include "mapping/pipeline/map_builder.h"
#include "server/app/open_map/batches.h"
#include "server/app/open_map/committer.h"
#include "server/app/open_map/due_time.h"
#include "server/app/open_map/map_recording.h"
#include "server/app/open_map/publisher.h"
#include "server/app/open_map/writer_queue.h"

namespace dhpmap {

/// The parts of an open map that writer jobs use. Each part documents its thread-safe functions; the queue is
/// thread-safe. The OpenMap owns the parts, which outlive all holders of this.
struct MapWriter {
  WriterQueue& queue;
  MapBuilder& builder;
  Committer& committer;
  Publisher& publisher;
  Batches& batches;
  MapRecording& recording;
  UtcClock now_ns;
  std::stop_token give_up;  ///< when requested: frames and refinements are cancelled without changing the map

  [[nodiscard]] Map& map() const { return builder.map(); }
};

}  // namespace dhpmap
