// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "server/base/lane.h"

namespace dhpmap {

/// One lane for each kind of call, so that no call blocks gRPC's own two threads.
struct Lanes {
  Lane quick;  ///< answers in microseconds, or asynchronously
  Lane loads;  ///< the same for maps that are not open: such calls wait for the disk
  /// Hands to gRPC what the bulk lane has made. A low-priority thread must not do this: it would hold gRPC's locks
  /// while it waits for a core, and new threads of gRPC would inherit its priority.
  Lane answers;
  Lane bulk;  ///< meshes, voxels, many points: long work at low priority
  /// Long checks of collisions and trajectories, in pieces. As low in priority as the bulk lane, and parallel to it.
  Lane checks;
  Lane frames;  ///< robots' frames, before and after decoding
  /// Parses and decodes frames at low priority, so that a large message does not delay quick calls.
  Lane decoding;
  Lane watch;  ///< reads changes and sends them; one thread, so that the store is read once for all watchers
};

}  // namespace dhpmap
