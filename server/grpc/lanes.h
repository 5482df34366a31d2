// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "server/base/lane.h"

namespace dhpmap {

/// One lane for each kind of call, so that none holds up gRPC's own threads, of which there are two.
struct Lanes {
  Lane quick;  ///< answers in microseconds, or asynchronously
  Lane loads;  ///< the same, of maps that are not open: whoever asks for those waits for the disk
  /// Hands to gRPC what the bulk lane has made. A thread that is nice must not call it: it would hold gRPC's locks
  /// while it waits for a core, and the threads that gRPC starts as it needs them would be as nice for ever.
  Lane answers;
  Lane bulk;  ///< meshes, voxels, many points: takes long, and cares less
  /// Collisions and trajectories that take long, piece by piece; as nice as the bulk lane, which goes on beside it.
  Lane checks;
  Lane frames;  ///< what robots stream, before and after it is decoded
  /// Parsing and decoding that: on nice threads, so that what is quick does not wait for a message that takes long.
  Lane decoding;
  Lane watch;  ///< reading what was changed, and telling it; of one thread, so that the store is read once for all
};

}  // namespace dhpmap
