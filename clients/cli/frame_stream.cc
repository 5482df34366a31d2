// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/frame_stream.h"

#include <atomic>
#include <semaphore>

namespace dhpmap {
namespace {

constexpr int kMaxUnacknowledged = 8;

using Stream = grpc::ClientReaderWriterInterface<v1::IntegrateFramesRequest, v1::IntegrateFramesResponse>;

}  // namespace

grpc::Status StreamFrames(v1::MappingService::Stub& stub, const std::string& map, FrameQueue& queue,
                          const std::function<void(const v1::IntegrateFramesResponse&)>& on_ack) {
  grpc::ClientContext context;
  const std::unique_ptr<Stream> stream = stub.IntegrateFrames(&context);
  std::counting_semaphore<> room(kMaxUnacknowledged);
  std::atomic<bool> is_over = false;
  std::thread writer([&] {
    v1::IntegrateFramesRequest request;
    request.set_map(map);
    while (std::optional<QueuedFrame> frame = queue.Next()) {
      room.acquire();
      request.set_sequence(static_cast<std::int64_t>(frame->index));
      *request.mutable_frame() = std::move(frame->message);
      if (is_over || !stream->Write(request)) break;
      request.clear_map();  // said once
    }
    stream->WritesDone();
  });
  v1::IntegrateFramesResponse ack;
  while (stream->Read(&ack)) {
    on_ack(ack);
    room.release();
  }
  is_over = true;  // the server has ended the stream: wake the writer, whatever it waits for
  queue.Stop();
  room.release();
  writer.join();
  return stream->Finish();
}

}  // namespace dhpmap
