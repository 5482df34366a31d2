// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/frame_stream.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <semaphore>
#include <thread>
#include <utility>

namespace dhpmap {
namespace {

constexpr int kMaxUnacknowledged = 8;

using Stream = grpc::ClientReaderWriterInterface<v1::IntegrateFramesRequest, v1::IntegrateFramesResponse>;

/// Sends the queue's frames, the first of them in `first`, and hears all answers. The stream's status.
grpc::Status Exchange(Stream& stream, v1::IntegrateFramesRequest first, FrameQueue& queue, const OnAnswer& on_answer) {
  std::counting_semaphore<> room(kMaxUnacknowledged);
  std::atomic<bool> is_over = false;
  std::thread writer([&] {
    v1::IntegrateFramesRequest request = std::move(first);
    while (std::optional<QueuedFrame> frame = queue.Next()) {
      room.acquire();
      request.set_sequence(static_cast<std::int64_t>(frame->index));
      *request.mutable_frame() = std::move(frame->message);
      if (is_over || !stream.Write(request)) break;
      request.Clear();  // what the first message says is said once
    }
    stream.WritesDone();
  });
  v1::IntegrateFramesResponse answer;
  while (stream.Read(&answer)) {
    on_answer(answer);
    room.release();
  }
  is_over = true;  // the server has ended the stream: wake the writer, whatever it waits for
  queue.Stop();
  room.release();
  writer.join();
  return stream.Finish();
}

/// Those beyond what is stored.
std::vector<std::size_t> Unstored(const std::vector<std::size_t>& indices,
                                  const v1::IntegrateFramesResponse& greeting) {
  std::vector<std::size_t> left;
  std::copy_if(indices.begin(), indices.end(), std::back_inserter(left), [&](std::size_t index) {
    return !greeting.has_committed_sequence() || static_cast<std::int64_t>(index) > greeting.committed_sequence();
  });
  return left;
}

/// What the first message of a stream says.
void SetOpening(const FrameSession& session, v1::IntegrateFramesRequest& first) {
  first.set_map(session.map);
  first.set_session(session.name);
  first.set_take_over(session.take_over);
  first.set_refuse_implausible(session.refuse_implausible);
}

/// One connection of a session.
grpc::Status StreamOnce(v1::MappingService::Stub& stub, const FrameSession& session,
                        const std::vector<std::size_t>& indices, const SessionHooks& hooks, bool& is_first) {
  grpc::ClientContext context;
  const std::unique_ptr<Stream> stream = stub.IntegrateFrames(&context);
  v1::IntegrateFramesRequest greeting;
  SetOpening(session, greeting);
  greeting.set_take_over(session.take_over && is_first);  // what took over from us since may keep it
  v1::IntegrateFramesResponse answer;
  if (!stream->Write(greeting) || !stream->Read(&answer)) return stream->Finish();
  if (answer.has_error()) {
    return {static_cast<grpc::StatusCode>(answer.error().code()),
            "the server knows no sessions: " + answer.error().message()};
  }
  const std::vector<std::size_t> left = Unstored(indices, answer);
  if (std::exchange(is_first, false)) hooks.on_stored_before(indices.size() - left.size());
  hooks.on_progress(answer);
  const auto queue = hooks.read(left);
  return Exchange(*stream, {}, *queue, [&](const v1::IntegrateFramesResponse& heard) {
    if (heard.outcome() == v1::IntegrateFramesResponse::FRAME_OUTCOME_UNSPECIFIED) hooks.on_progress(heard);
    else hooks.on_ack(heard);
  });
}

}  // namespace

grpc::Status StreamFrames(v1::MappingService::Stub& stub, const FrameSession& session, FrameQueue& queue,
                          const OnAnswer& on_ack) {
  grpc::ClientContext context;
  const std::unique_ptr<Stream> stream = stub.IntegrateFrames(&context);
  v1::IntegrateFramesRequest first;
  SetOpening(session, first);
  return Exchange(*stream, std::move(first), queue, on_ack);
}

grpc::Status StreamSession(v1::MappingService::Stub& stub, const FrameSession& session,
                           const std::vector<std::size_t>& indices, const SessionHooks& hooks) {
  for (bool is_first = true;;) {
    grpc::Status status = StreamOnce(stub, session, indices, hooks, is_first);
    if (status.error_code() != grpc::StatusCode::UNAVAILABLE || is_first || !hooks.reconnect(status)) return status;
  }
}

}  // namespace dhpmap
