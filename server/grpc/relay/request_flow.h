// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <cstddef>
#include <optional>

#include "mapping/base/status.h"
#include "server/base/byte_budget.h"

namespace dhpmap {

/// The messages of one relayed call on their way from the client to its upstream call. The next message is read only
/// after the last one was sent, so a slow owner slows the client, and at most two messages are in memory: the first
/// one, which a second owner may need, and one that is being sent. Lives as long as its RelayedCall. Thread-compatible:
/// the call's mutex guards it.
class RequestFlow {
 public:
  /// What is to be done now. The operation counts as begun.
  enum class Step { kNone, kRead, kSend, kSendLast, kSendEnd };

  /// `is_stream`: the client sends messages; else one request, see SetRequest.
  explicit RequestFlow(bool is_stream) : is_stream_(is_stream) {}

  /// Before the first message. `budget` outlives this.
  void CountIn(ByteBudget& budget) { share_.emplace(&budget); }
  /// The one request of a call that is no stream. RESOURCE_EXHAUSTED, reason TOO_MANY_BYTES.
  Status SetRequest(grpc::ByteBuffer request);

  void OnReadBegun() { is_reading_ = true; }
  /// A message was read. RESOURCE_EXHAUSTED, reason TOO_MANY_BYTES: it is dropped.
  Status OnRead(grpc::ByteBuffer message);
  /// The client has half-closed or is gone.
  void OnClientEnd();
  /// The last message was sent, so that the next one may be read.
  void OnSent() { is_sending_ = false; }
  /// The owner has answered: it has the first message.
  void OnAnswer() {
    if (num_sent_ > 0) first_.reset();
  }

  Step Next();
  /// The message of kSend and kSendLast.
  grpc::ByteBuffer& message() { return message_; }
  /// The upstream call is ending and has not taken `message`.
  void OnNotTaken();

  [[nodiscard]] bool has_first() const { return first_.has_value(); }
  /// Whether another upstream call can still get everything that this one got.
  [[nodiscard]] bool CanRestart() const { return first_.has_value() && num_sent_ <= 1; }
  /// A new upstream call gets the messages from the first one on.
  void Restart();

 private:
  const bool is_stream_;
  std::optional<ByteShare> share_;
  std::optional<grpc::ByteBuffer> first_;    ///< until an answer comes
  std::optional<grpc::ByteBuffer> pending_;  ///< read, not yet sent
  grpc::ByteBuffer message_;
  bool is_reading_ = false, is_sending_ = false;
  bool has_client_ended_ = false, has_sent_end_ = false;
  int num_sent_ = 0;  ///< messages, to the present upstream call
};

}  // namespace dhpmap
