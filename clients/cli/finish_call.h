// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/support/status.h>

#include <functional>
#include <memory>
#include <string>

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
grpc::Status CallFinish(const std::shared_ptr<grpc::Channel>& channel, const std::string& map,
                        const FinishListener& listener, v1::FinishMappingResponse& response);

/// The same, told on stderr, in one line of a terminal or else a line for each stage, and cancelled by the first
/// Ctrl-C, which it tells, too; the second one ends the program. CANCELLED for nothing else.
grpc::Status FinishAndTell(const std::shared_ptr<grpc::Channel>& channel, const std::string& map,
                           v1::FinishMappingResponse& response);

}  // namespace dhpmap
