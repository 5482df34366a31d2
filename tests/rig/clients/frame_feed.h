// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "mapping/base/result.h"
#include "tests/rig/load/latencies.h"

namespace dhpmap::rig {

/// All frames of a data set as messages, so that reading files is not measured.
Result<std::vector<v1::Frame>> ReadFrames(const std::string& directory);

/// Sends the frames to maps/{map_id} again and again, `rate_hz` a second at most (0: as fast as the server takes them),
/// until stopped. `gaps` gets the time between one acknowledgement and the next; a frame that is refused counts as a
/// failure.
grpc::Status FeedUntil(v1::MappingService::Stub& stub, const std::string& map_id, const std::vector<v1::Frame>& frames,
                       double rate_hz, const std::stop_token& stop, Latencies& gaps);

/// What became of frames that were fed once.
struct FeedOutcome {
  grpc::Status status;
  int num_fused = 0, num_others = 0;  ///< others: refused, or called duplicates
  double fuse_s = 0;                  ///< the server's own time of fusing, summed
  double elapsed_s = 0;               ///< from the first frame sent until all are stored
  [[nodiscard]] double rate_hz() const { return elapsed_s > 0 ? num_fused / elapsed_s : 0; }
};
/// Sends these frames to maps/{map_id} in order, once, as fast as the server takes them, in a session of that name.
FeedOutcome FeedOnce(v1::MappingService::Stub& stub, const std::string& map_id, const std::string& session,
                     const std::vector<const v1::Frame*>& frames);

/// Makes an empty map for the data set, as `dhpmap map` does.
Status CreateMapFor(const std::string& directory, const std::string& map_id,
                    const std::shared_ptr<grpc::Channel>& channel);

}  // namespace dhpmap::rig
