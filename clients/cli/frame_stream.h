// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "clients/cli/frame_queue.h"
#include "dhpmap/v1/mapping_service.grpc.pb.h"

namespace dhpmap {

using OnAnswer = std::function<void(const v1::IntegrateFramesResponse&)>;

/// Where frames go, and how.
struct FrameSession {
  std::string map;                  ///< maps/{map}
  std::string name;                 ///< of the session, by which the server remembers how far it has got; empty: none
  bool take_over = false;           ///< in place of the streams that feed the map now
  bool refuse_implausible = false;  ///< instead of fusing them with a warning
};

/// Sends the queue's frames and calls `on_ack` for each acknowledgement, in order, on the calling thread; an
/// acknowledgement's sequence is the frame's index. At most a few frames are on their way at once. The stream's status
/// once everything sent is committed, or why it broke. The session has no name.
grpc::Status StreamFrames(v1::MappingService::Stub& stub, const FrameSession& session, FrameQueue& queue,
                          const OnAnswer& on_ack);

/// What StreamSession asks of its caller.
struct SessionHooks {
  /// The frames still to be sent, by ascending index; asked for once a connection.
  std::function<std::unique_ptr<FrameQueue>(const std::vector<std::size_t>& indices)> read;
  /// So many of the frames were stored before this session began; said once.
  std::function<void(std::size_t num_frames)> on_stored_before;
  OnAnswer on_ack;       ///< as above
  OnAnswer on_progress;  ///< an answer for no frame
  /// The connection is lost. Waits for a new one; false if there is none, or no wish for one.
  std::function<bool(const grpc::Status& why)> reconnect;
};

/// The same in a session that has a name, which outlasts connections: sends those of the frames `indices` that the
/// server has not stored, and after a lost connection goes on with those that it has not stored by then.
grpc::Status StreamSession(v1::MappingService::Stub& stub, const FrameSession& session,
                           const std::vector<std::size_t>& indices, const SessionHooks& hooks);

}  // namespace dhpmap
