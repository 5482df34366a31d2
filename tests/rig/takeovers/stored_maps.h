// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/channel.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dhpmap::rig {

/// What a server has stored of a robot's map against what was acknowledged: frames 1 to `last_frame`, and edits 1, 2
/// and so on at these revisions (see PacedRobot). One more of each may be stored, whose answer was lost. Empty: all is
/// well.
std::vector<std::string> ComplaintsOfStored(const std::shared_ptr<grpc::Channel>& server, const std::string& map,
                                            std::int64_t last_frame, const std::vector<std::int64_t>& edit_revisions);

}  // namespace dhpmap::rig
