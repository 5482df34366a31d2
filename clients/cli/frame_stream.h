// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "clients/cli/frame_queue.h"
#include "dhpmap/v1/mapping_service.grpc.pb.h"

namespace dhpmap {

/// Sends the queue's frames to the map (maps/{map}) and calls `on_ack` for each acknowledgement, in order, on the
/// calling thread; an acknowledgement's sequence is the frame's index. At most a few frames are on their way at once.
/// The stream's status once everything sent is committed, or why it broke.
grpc::Status StreamFrames(v1::MappingService::Stub& stub, const std::string& map, FrameQueue& queue,
                          const std::function<void(const v1::IntegrateFramesResponse&)>& on_ack);

}  // namespace dhpmap
