// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>

#include "mapping/pipeline/map_builder.h"
#include "server/app/session/batches.h"
#include "server/app/session/committer.h"
#include "server/app/session/due_time.h"
#include "server/app/session/map_recording.h"
#include "server/app/session/publisher.h"
#include "server/app/session/writer_queue.h"

namespace dhpmap {

/// What jobs on an open map's writer thread work with. Each part says which of it is for other threads; the queue is.
/// The MapSession owns the parts, which outlive all who are given this.
struct MapWriter {
  WriterQueue& queue;
  MapBuilder& builder;
  Committer& committer;
  Publisher& publisher;
  Batches& batches;
  MapRecording& recording;
  UtcClock now_ns;
  std::stop_token give_up;  ///< requested: frames and refinements are given up, and leave the map as it was

  [[nodiscard]] Map& map() const { return builder.map(); }
};

}  // namespace dhpmap
