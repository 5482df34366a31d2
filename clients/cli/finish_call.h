// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "clients/cpp/calls/caller.h"
#include "dhpmap/v1/mapping_service.pb.h"
#include "dhpmap/v1/watch_service.pb.h"

namespace dhpmap {

/// Who follows a call of FinishMapping.
struct FinishListener {
  /// Hears how far it is, on a thread of its own, and never after the call; may be empty.
  std::function<void(const v1::FinishProgress&)> on_progress;
  /// Asked some ten times a second; once it is true the call is cancelled. May be empty.
  std::function<bool()> is_interrupted;
};

/// FinishMapping of "maps/kitchen". CANCELLED if it was interrupted: the map is as it was, unless it was being stored
/// already. What is told of it comes from WatchMap; where that is refused, nothing is told.
client::Result<v1::FinishMappingResponse> CallFinish(client::Caller& caller, const std::string& map,
                                                     const FinishListener& listener);

/// The same, told on stderr, in one line of a terminal or else a line for each stage, and cancelled by the first
/// Ctrl-C, which it tells, too; the second one ends the program. CANCELLED for nothing else.
client::Result<v1::FinishMappingResponse> FinishAndTell(client::Caller& caller, const std::string& map);

}  // namespace dhpmap
