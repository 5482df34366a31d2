// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/server_context.h>
#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/server_callback.h>

#include <memory>
#include <optional>
#include <string>

#include "mapping/base/mutex.h"
#include "server/base/byte_budget.h"
#include "server/grpc/relay/relay.h"
#include "server/grpc/relay/request_flow.h"
#include "server/grpc/relay/upstream_call.h"

namespace dhpmap {

/// A call whose bytes go to the owner of its map, and the answers back: one message at a time in each direction, so a
/// slow reader slows the owner. Deadline, cancellation, metadata, status and details pass through. If this server turns
/// out to be the owner, the call goes to its own handler through the process.
///
/// Life time: `self_` keeps it until gRPC calls OnDone, the upstream call (its UpstreamListener) until OnEnd, and a
/// question to the database until that is answered. Threads: gRPC's threads call the reactions, one thread of the lane
/// `loads` asks the database. `mutex_` guards what several of them touch. An answer belongs to one thread at a time,
/// because the next one is read only after it was written.
///
/// Sources: relayed_call.cc begins a call and finds its way, relayed_messages.cc passes messages, relayed_ending.cc
/// ends the call.
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
  // Beginning.
  Status Begin(Route route, std::optional<grpc::ByteBuffer> first);
  /// The first message has arrived, or the client ended without one.
  void Go(Route route);
  /// Asks the database for the owner of `map_`, then opens the call.
  void Ask();
  void Open(const Route& route);
  /// A call to another server counts for the caller here, too; within the process it counts once, at its handler.
  Status EnterOnce() DHPMAP_EXCLUDES(mutex_);
  /// Not OK: the call has to end with that.
  Status SetUpstream(const std::shared_ptr<UpstreamCall>& upstream, const Route& route) DHPMAP_EXCLUDES(mutex_);

  // Messages.
  Status TakeMessage(bool is_first) DHPMAP_EXCLUDES(mutex_);
  void OnLastRead() DHPMAP_EXCLUDES(mutex_);
  void Read() DHPMAP_EXCLUDES(mutex_);
  /// Does the next step of `requests_`.
  void Pump() DHPMAP_EXCLUDES(mutex_);
  void PassHeadOnce(UpstreamCall& upstream);
  [[nodiscard]] std::shared_ptr<UpstreamCall> Upstream() const DHPMAP_EXCLUDES(mutex_);

  // Ending.
  /// Cancels the upstream call; its end ends this call with `why`.
  void CutOff(const Status& why) DHPMAP_EXCLUDES(mutex_);
  /// The owner had changed: the call goes to the next one, if nothing is lost by that.
  bool GoesElsewhere(const grpc::Status& status) DHPMAP_EXCLUDES(mutex_);
  grpc::Status OutcomeOf(const grpc::Status& status) DHPMAP_EXCLUDES(mutex_);
  void End(const grpc::Status& status) DHPMAP_EXCLUDES(mutex_);
  void End(const Status& status);

  Relay& relay_;
  const std::shared_ptr<const RelayedMethod> method_;
  grpc::CallbackServerContext* const call_;
  const bool is_passed_on_, comes_in_messages_;
  std::shared_ptr<RelayedCall> self_;
  auth::PrincipalPtr principal_;        // written in Begin only
  std::shared_ptr<ByteBudget> budget_;  // likewise; the shares below are of it
  // gRPC alone touches a buffer between the start and the end of its operation.
  std::optional<ByteShare> answer_share_;
  grpc::ByteBuffer incoming_, answer_;
  bool has_passed_head_ = false;

  mutable Mutex mutex_;
  RequestFlow requests_ DHPMAP_GUARDED_BY(mutex_);
  std::shared_ptr<UpstreamCall> upstream_ DHPMAP_GUARDED_BY(mutex_);
  int num_upstreams_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::string map_ DHPMAP_GUARDED_BY(mutex_);
  std::string owner_address_ DHPMAP_GUARDED_BY(mutex_);  ///< of the present upstream; empty: this server
  Status failure_ DHPMAP_GUARDED_BY(mutex_);             ///< why the call was cut off here
  bool has_entered_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_cancelled_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_over_ DHPMAP_GUARDED_BY(mutex_) = false;
};

}  // namespace dhpmap
