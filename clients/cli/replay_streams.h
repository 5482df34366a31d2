// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "clients/cpp/calls/caller.h"

namespace dhpmap {

/// Sends frames of several sessions so that the map takes them in the order of the calls: several frames of one session
/// may be in flight, but never frames of two sessions. Thread-compatible.
class ReplayStreams {
 public:
  using OnAnswer = std::function<void(const v1::IntegrateFramesResponse&)>;

  /// `on_answer`: called for each frame, in order.
  ReplayStreams(std::shared_ptr<client::Caller> caller, std::string map, OnAnswer on_answer);
  ~ReplayStreams();

  /// OK, or the error that ended a stream.
  client::Status Send(const std::string& session, std::int64_t sequence, v1::IntegrateFramesRequest request);
  /// Waits until everything sent is answered.
  client::Status Drain();
  /// Drains, then ends all streams, so that everything is stored.
  client::Status Close();

 private:
  struct Stream {
    grpc::ClientContext context;
    std::unique_ptr<grpc::ClientReaderWriterInterface<v1::IntegrateFramesRequest, v1::IntegrateFramesResponse>> calls;
    int num_unanswered = 0;
    std::int64_t last_used = 0;
  };

  client::Status Hear(Stream& stream);
  client::Status MakeRoomFor(const std::string& session);
  client::Status CloseOne(const std::string& session);

  const std::shared_ptr<client::Caller> caller_;
  const std::string map_;
  const OnAnswer on_answer_;
  std::map<std::string, std::unique_ptr<Stream>> streams_;  ///< by session
  Stream* last_ = nullptr;                                  ///< the only one that may have unanswered frames
  std::int64_t num_sent_ = 0;
};

}  // namespace dhpmap
