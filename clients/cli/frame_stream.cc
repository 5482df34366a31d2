// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/frame_stream.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "clients/cpp/calls/frame_stream.h"

namespace dhpmap {
namespace {

/// Limit of frames not known to be stored; beyond it the server is asked to store.
constexpr std::int64_t kKept_bytes = 256 << 20;
/// No practical limit for a frame: the user can interrupt.
constexpr double kPatience_s = 86'400;

/// The frames after the last stored one.
std::vector<std::size_t> Unstored(const std::vector<std::size_t>& indices, std::optional<std::int64_t> stored) {
  std::vector<std::size_t> left;
  std::copy_if(indices.begin(), indices.end(), std::back_inserter(left),
               [&](std::size_t index) { return !stored || static_cast<std::int64_t>(index) > *stored; });
  return left;
}

client::FeedOptions OptionsOf(const FrameSession& session) {
  client::FeedOptions options;
  options.session = session.name;
  options.take_over = session.take_over;
  options.refuse_implausible = session.refuse_implausible;
  options.reconnect_s = session.reconnect_s;
  options.deadline_s = kPatience_s;
  options.memory_bytes = kKept_bytes;
  return options;
}

}  // namespace

client::Status StreamFrames(const std::shared_ptr<client::Caller>& caller, const FrameSession& session,
                            const std::vector<std::size_t>& indices, const FrameHooks& hooks) {
  bool was_there = false, is_there = false;  // on the stream's thread
  const auto on_answer = [&](const v1::IntegrateFramesResponse& answer) {
    was_there = is_there = true;
    const bool is_of_frame = answer.outcome() != v1::IntegrateFramesResponse::FRAME_OUTCOME_UNSPECIFIED;
    (is_of_frame ? hooks.on_ack : hooks.on_progress)(answer);
  };
  const auto goes_on = [&](const client::Status& why) {
    if (!std::exchange(is_there, false)) return was_there && !hooks.is_interrupted();
    return hooks.reconnect(why);
  };
  client::FrameStream stream(caller, session.map, OptionsOf(session), {.on_answer = on_answer, .goes_on = goes_on});
  if (client::Status status = stream.WaitUntilGreeted(); !status.ok()) return status;
  const std::vector<std::size_t> left = Unstored(indices, stream.state().stored_sequence);
  if (!session.name.empty()) hooks.on_stored_before(indices.size() - left.size());
  const auto queue = hooks.read(left);
  while (!hooks.is_interrupted()) {
    std::optional<QueuedFrame> frame = queue->Next();
    if (!frame) break;
    client::Status status = stream.Push(static_cast<std::int64_t>(frame->index), std::move(frame->message));
    if (!status.ok()) return status;
  }
  return stream.Close();
}

}  // namespace dhpmap
