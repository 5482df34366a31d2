// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/server_context.h>
#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/server_callback.h>

#include <memory>
#include <optional>

#include "mapping/base/mutex.h"
#include "server/base/byte_budget.h"
#include "server/grpc/relay/relay.h"
#include "server/grpc/relay/upstream_call.h"

namespace dhpmap {

/// A call whose bytes go to the owner of its map, and the answers back: of each direction one message at a time, so
/// that a slow reader slows the owner. Its owner turns out to be this server where that was not known at first: then it
/// goes through the process. Deadline, cancellation, metadata, status and details pass through. Keeps itself until gRPC
/// is done with it.
class RelayedCall final : public grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>,
                          public UpstreamListener,
                          public std::enable_shared_from_this<RelayedCall> {
 public:
  /// `first`: the request; nothing: it comes in messages.
  static RelayedCall* Start(Relay& relay, std::shared_ptr<const RelayedMethod> method,
                            grpc::CallbackServerContext* call, Route route, std::optional<grpc::ByteBuffer> first);
  RelayedCall(Relay& relay, std::shared_ptr<const RelayedMethod> method, grpc::CallbackServerContext* call,
              bool is_passed_on, bool comes_in_messages);

  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override { const auto last = std::move(self_); }

  void OnSent() override;
  void OnAnswer(grpc::ByteBuffer answer) override;
  void OnEnd(const grpc::Status& status) override;

 private:
  void Begin(Route route, std::optional<grpc::ByteBuffer> first);
  /// The first message is there.
  void Go(Route route);
  void Ask();
  void Open(const Route& route);
  Result<std::shared_ptr<UpstreamCall>> MakeUpstream(const Route& route);
  /// Sends what has been read, or the client's end, or reads more.
  void Pump() DHPMAP_EXCLUDES(mutex_);
  void Read() DHPMAP_EXCLUDES(mutex_);
  Status TakeIn(std::size_t num_bytes) DHPMAP_EXCLUDES(mutex_);
  /// The upstream's end ends the call with that.
  void CutOff(const Status& why) DHPMAP_EXCLUDES(mutex_);
  /// The owner was another already: the database is asked once more, if nothing is lost by it.
  bool GoesElsewhere(const grpc::Status& status) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::shared_ptr<UpstreamCall> Upstream() const DHPMAP_EXCLUDES(mutex_);
  void End(const grpc::Status& status) DHPMAP_EXCLUDES(mutex_);
  void End(const Status& status);

  Relay& relay_;
  const std::shared_ptr<const RelayedMethod> method_;
  grpc::CallbackServerContext* const call_;
  const bool is_passed_on_, comes_in_messages_;
  std::shared_ptr<RelayedCall> self_;
  // Known from the beginning on.
  auth::PrincipalPtr principal_;
  std::shared_ptr<ByteBudget> budget_;
  std::optional<ByteShare> request_share_, answer_share_;
  // Of the messages' own directions: touched between an operation's start and its end by gRPC alone.
  grpc::ByteBuffer incoming_, answer_;
  bool has_told_head_ = false;

  mutable Mutex mutex_;
  std::shared_ptr<UpstreamCall> upstream_ DHPMAP_GUARDED_BY(mutex_);
  std::string map_ DHPMAP_GUARDED_BY(mutex_);
  std::optional<grpc::ByteBuffer> first_ DHPMAP_GUARDED_BY(mutex_);    ///< until an answer shows that it was taken
  std::optional<grpc::ByteBuffer> pending_ DHPMAP_GUARDED_BY(mutex_);  ///< read, not yet sent
  Status failure_ DHPMAP_GUARDED_BY(mutex_);                           ///< why the call was cut off here
  bool is_to_peer_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_entered_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_sending_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_reading_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool has_client_ended_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool has_sent_end_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_cancelled_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_over_ DHPMAP_GUARDED_BY(mutex_) = false;
  int num_sent_ DHPMAP_GUARDED_BY(mutex_) = 0;  ///< messages, to the present upstream
  int num_upstreams_ DHPMAP_GUARDED_BY(mutex_) = 0;
};

}  // namespace dhpmap
