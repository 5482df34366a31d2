// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "clients/cli/frame_queue.h"
#include "clients/cpp/calls/caller.h"
#include "dhpmap/v1/mapping_service.pb.h"

namespace dhpmap {

using OnAnswer = std::function<void(const v1::IntegrateFramesResponse&)>;

/// Destination and options of a frame stream.
struct FrameSession {
  std::string map;                  ///< maps/{map}
  std::string name;                 ///< of the feed session, whose progress the server stores; empty: none
  bool take_over = false;           ///< replace the streams that feed the map now
  bool refuse_implausible = false;  ///< instead of fusing them with a warning
  double reconnect_s = 30;          ///< how long to wait for a lost connection, if the session has a name
};

/// Callbacks of a stream, on the stream's thread, except on_stored_before.
struct FrameHooks {
  /// Returns the frames to send, by ascending index; called once, on the calling thread.
  std::function<std::unique_ptr<FrameQueue>(const std::vector<std::size_t>& indices)> read;
  /// Reports the number of frames that were stored before; called once, for sessions with a name.
  std::function<void(std::size_t num_frames)> on_stored_before;
  OnAnswer on_ack;       ///< the answer to a frame, in order; its sequence is the frame's index
  OnAnswer on_progress;  ///< an answer without a frame
  /// Called once for each lost connection; false: do not reconnect.
  std::function<bool(const client::Status& why)> reconnect;
  std::function<bool()> is_interrupted;  ///< once true, no more frames are sent
};

/// Sends those of the frames `indices` that the server has not stored, with at most a few in flight. A session with a
/// name survives lost connections. OK once everything sent is stored, else the error.
client::Status StreamFrames(const std::shared_ptr<client::Caller>& caller, const FrameSession& session,
                            const std::vector<std::size_t>& indices, const FrameHooks& hooks);

}  // namespace dhpmap
