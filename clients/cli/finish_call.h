// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "clients/cpp/calls/caller.h"
#include "dhpmap/v1/mapping_service.pb.h"
#include "dhpmap/v1/watch_service.pb.h"

namespace dhpmap {

/// Callbacks of a FinishMapping call.
struct FinishListener {
  /// Receives progress on a separate thread, never after the call; may be empty.
  std::function<void(const v1::FinishProgress&)> on_progress;
  /// Polled about ten times a second; the call is cancelled once it returns true. May be empty.
  std::function<bool()> is_interrupted;
};

/// Calls FinishMapping of "maps/kitchen". CANCELLED if it was interrupted: the map is unchanged, unless storing had
/// begun. Progress comes from WatchMap; if that is refused, there is none.
client::Result<v1::FinishMappingResponse> CallFinish(client::Caller& caller, const std::string& map,
                                                     const FinishListener& listener);

/// The same with progress on stderr: one line on a terminal, else a line per stage. The first Ctrl-C cancels the call
/// and says so; the second one ends the program. CANCELLED only after Ctrl-C.
client::Result<v1::FinishMappingResponse> FinishAndTell(client::Caller& caller, const std::string& map);

}  // namespace dhpmap
