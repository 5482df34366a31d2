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

/// Where frames go, and how.
struct FrameSession {
  std::string map;                  ///< maps/{map}
  std::string name;                 ///< of the session, by which the server remembers how far it has got; empty: none
  bool take_over = false;           ///< in place of the streams that feed the map now
  bool refuse_implausible = false;  ///< instead of fusing them with a warning
  double reconnect_s = 30;          ///< of one that has a name: so long a lost connection is waited for
};

/// Who follows a stream: on the thread of the stream, but on_stored_before.
struct FrameHooks {
  /// The frames still to be sent, by ascending index; asked for once, on the calling thread.
  std::function<std::unique_ptr<FrameQueue>(const std::vector<std::size_t>& indices)> read;
  /// So many of the frames were stored before this session began; said once, of sessions that have a name.
  std::function<void(std::size_t num_frames)> on_stored_before;
  OnAnswer on_ack;       ///< of a frame, in order; its sequence is the frame's index
  OnAnswer on_progress;  ///< an answer for no frame
  /// The connection is lost, told once a connection; false: there is no wish for another one.
  std::function<bool(const client::Status& why)> reconnect;
  std::function<bool()> is_interrupted;  ///< once true, no more frames are sent
};

/// Sends those of the frames `indices` that the server has not stored; at most a few are on their way at once. A
/// session that has a name outlasts connections. OK once everything sent is stored, or why not.
client::Status StreamFrames(const std::shared_ptr<client::Caller>& caller, const FrameSession& session,
                            const std::vector<std::size_t>& indices, const FrameHooks& hooks);

}  // namespace dhpmap
