// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <optional>
#include <string>

#include "tests/integration/test_server.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {

/// Fields of a stream's first message.
struct Opening {
  std::string session = {};
  bool take_over = false;
  bool refuse_implausible = false;
};

/// A stream of frames of TestScene, message by message. The destructor cancels it if it still runs.
class Feeder {
 public:
  using Ack = v1::IntegrateFramesResponse;

  Feeder(v1::MappingService::Stub& mapping, const std::string& map_id, const Opening& opening = {})
      : stream_(mapping.IntegrateFrames(&context_)) {
    first_.set_map("maps/" + map_id);
    first_.set_session(opening.session);
    first_.set_take_over(opening.take_over);
    first_.set_refuse_implausible(opening.refuse_implausible);
  }
  Feeder(TestServer& server, const std::string& map_id, const Opening& opening = {})
      : Feeder(*server.mapping, map_id, opening) {}
  ~Feeder() {
    if (is_open_) context_.TryCancel(), (void)Finish();
  }

  /// Sends the first message, without a frame; returns its answer.
  std::optional<Ack> Greet() {
    stream_->Write(std::exchange(first_, {}));
    return Read();
  }
  /// False if the stream has ended.
  bool Send(std::int64_t sequence, int frame, bool is_last = false) {
    return Send(sequence, TestFrame(frame), is_last);
  }
  bool Send(std::int64_t sequence, v1::Frame frame, bool is_last = false) {
    v1::IntegrateFramesRequest request = std::exchange(first_, {});
    request.set_sequence(sequence);
    *request.mutable_frame() = std::move(frame);
    return stream_->Write(request, is_last ? grpc::WriteOptions().set_last_message() : grpc::WriteOptions());
  }
  /// Nothing if the stream has ended.
  std::optional<Ack> Read() {
    Ack ack;
    if (!stream_->Read(&ack)) return std::nullopt;
    return ack;
  }
  /// Sends frame `sequence` as `sequence` and waits for its answer.
  std::optional<Ack> Feed(int sequence) {
    if (!Send(sequence, sequence)) return std::nullopt;
    return Read();
  }
  void HalfClose() { stream_->WritesDone(); }
  void Cancel() { context_.TryCancel(); }
  /// Reads the remaining answers, keeps the last one, and waits for the end.
  grpc::Status Finish() {
    while (auto ack = Read()) last_ = *ack;
    is_open_ = false;
    return stream_->Finish();
  }
  [[nodiscard]] const std::optional<Ack>& last() const { return last_; }

 private:
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::IntegrateFramesRequest, v1::IntegrateFramesResponse>> stream_;
  v1::IntegrateFramesRequest first_;
  std::optional<Ack> last_;
  bool is_open_ = true;
};

}  // namespace dhpmap::testing
