// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/relayed_call.h"

#include <utility>

#include "proto/types/metadata_keys.h"
#include "proto/types/status_conversion.h"
#include "server/auth/fleet_key.h"
#include "server/auth/rights.h"
#include "server/auth/tickets.h"
#include "server/base/request_limits.h"
#include "server/grpc/door_call.h"
#include "server/grpc/relay/passed_metadata.h"

namespace dhpmap {
namespace {

using Way = Route::Way;

constexpr int kMostUpstreams = 2;  // the database is asked anew once

Status ClientIsGone() { return Cancelled("the client went away"); }

bool SaysNotOwner(const grpc::Status& status) {
  return status.error_code() == grpc::UNAVAILABLE && ReadErrorDetails(status.error_details()).reason == "NOT_OWNER";
}

}  // namespace

RelayedCall* RelayedCall::Start(Relay& relay, std::shared_ptr<const RelayedMethod> method,
                                grpc::CallbackServerContext* call, Route route, std::optional<grpc::ByteBuffer> first) {
  const auto self =
      std::make_shared<RelayedCall>(relay, std::move(method), call, route.is_passed_on, !first.has_value());
  self->self_ = self;
  const Status begun = RunGuarded([&] {
    self->Begin(std::move(route), std::move(first));
    return Status::Ok();
  });
  if (!begun.ok()) self->End(begun);
  return self.get();
}

RelayedCall::RelayedCall(Relay& relay, std::shared_ptr<const RelayedMethod> method, grpc::CallbackServerContext* call,
                         bool is_passed_on, bool comes_in_messages)
    : relay_(relay),
      method_(std::move(method)),
      call_(call),
      is_passed_on_(is_passed_on),
      comes_in_messages_(comes_in_messages) {}

void RelayedCall::Begin(Route route, std::optional<grpc::ByteBuffer> first) {
  if (route.way == Way::kRefuse && route.map.empty()) return End(route.refusal);
  auto principal = WhoCalls(relay_.gate(), *call_);
  if (!principal.ok()) return End(principal.status());
  principal_ = *std::move(principal);
  budget_ = relay_.gate().BudgetOf(*principal_, relay_.context().options.inflight);
  request_share_.emplace(budget_.get());
  answer_share_.emplace(budget_.get());
  if (!first) return Read();
  if (!request_share_->Resize(first->Length())) return End(TooManyBytes());
  {
    const MutexLock lock(mutex_);
    first_ = std::move(first);
    has_client_ended_ = true;
  }
  Go(std::move(route));
}

void RelayedCall::Go(Route route) {
  // Who may not ask for the map learns from the handler that it may not, and nothing from the way of the call.
  const bool may_ask = auth::CheckMap(*principal_, route.map).ok();
  if (!route.map.empty() && may_ask && route.way == Way::kAsk) {
    {
      const MutexLock lock(mutex_);
      map_ = route.map;
    }
    return Ask();
  }
  if (route.way == Way::kRefuse && may_ask) return End(route.refusal);
  if (!may_ask || route.map.empty()) route.way = Way::kHere;
  Open(route);
}

void RelayedCall::Ask() {
  const auto task = std::make_shared<LaneTask>([self = shared_from_this()] {
    const Status asked = RunGuarded([&] {
      std::string map;
      {
        const MutexLock lock(self->mutex_);
        map = self->map_;
      }
      const Route route = self->relay_.AskFor(std::move(map), self->is_passed_on_);
      if (route.way == Way::kRefuse) self->End(route.refusal);
      else self->Open(route);
      return Status::Ok();
    });
    if (!asked.ok()) self->End(asked);
  });
  if (relay_.context().lanes.loads.TryPost(task)) return;
  task->GiveUp();
  End(TooBusy());
}

Result<std::shared_ptr<UpstreamCall>> RelayedCall::MakeUpstream(const Route& route) {
  auth::Gate& gate = relay_.gate();
  if (route.way == Way::kHere) {
    auto upstream = std::make_shared<UpstreamCall>(shared_from_this(), relay_.Here());
    PassRequestHead(*call_, upstream->context());
    const auto ticket = gate.tickets().Issue(principal_);
    upstream->context().AddMetadata(auth::kTicketKey, ticket->text());
    upstream->context().AddMetadata(kRelayedKey, kPassedHere);
    upstream->Keep(ticket);
    return upstream;
  }
  DHPMAP_ASSIGN_OR_RETURN(auto channel, relay_.ChannelTo(route.owner->address));
  auto upstream = std::make_shared<UpstreamCall>(shared_from_this(), std::move(channel));
  grpc::ClientContext& context = upstream->context();
  PassRequestHead(*call_, context);
  context.AddMetadata(kRelayedKey, kPassedOn);
  context.AddMetadata(kRouteMapKey, route.map);
  if (const auth::FleetKey* key = gate.fleet_key()) context.AddMetadata(auth::kFleetKeyKey, key->text());
  if (gate.has_keys()) context.AddMetadata(auth::kPrincipalKey, auth::TextOf(*principal_));
  return upstream;
}

void RelayedCall::Open(const Route& route) {
  const bool is_to_peer = route.way == Way::kOn;
  // At the owner it counts, too; within the process it is the same call, which counts once.
  if (is_to_peer) {
    const bool is_entered = [&] {
      const MutexLock lock(mutex_);
      return std::exchange(is_entered_, true);
    }();
    const Status entered =
        is_entered ? Status::Ok()
                   : EnterAs(relay_.gate(), principal_, method_->needs, relay_.context().options.inflight, *call_);
    if (!entered.ok()) return End(entered);
  }
  auto made = MakeUpstream(route);
  if (!made.ok()) return End(made.status());
  const std::shared_ptr<UpstreamCall> upstream = *made;
  Status failure;
  {
    const MutexLock lock(mutex_);
    failure = is_cancelled_ ? ClientIsGone() : failure_;
    if (failure.ok()) {
      upstream_ = upstream;
      is_to_peer_ = is_to_peer;
      num_sent_ = 0;
      has_sent_end_ = is_sending_ = false;
      ++num_upstreams_;
      map_ = route.map;
    }
  }
  if (!failure.ok()) return End(failure);
  upstream->Start(method_->path);
  Pump();
}

std::shared_ptr<UpstreamCall> RelayedCall::Upstream() const {
  const MutexLock lock(mutex_);
  return upstream_;
}

void RelayedCall::Pump() {
  const MutexLock lock(mutex_);
  if (is_sending_ || is_over_ || upstream_ == nullptr) return;
  if (num_sent_ == 0 && first_) {
    grpc::ByteBuffer message = *first_;  // shares its bytes
    has_sent_end_ = !comes_in_messages_;
    is_sending_ = upstream_->Send(message, /*is_last=*/has_sent_end_);
    num_sent_ = 1;
  } else if (pending_) {
    is_sending_ = upstream_->Send(*pending_, /*is_last=*/false);
    if (!is_sending_) return;  // it is ending
    pending_.reset();
    ++num_sent_;
  } else if (has_client_ended_) {
    if (!std::exchange(has_sent_end_, true)) upstream_->SendEnd();
  } else if (!is_reading_) {
    is_reading_ = true;
    StartRead(&incoming_);
  }
}

void RelayedCall::Read() {
  const MutexLock lock(mutex_);
  is_reading_ = true;
  StartRead(&incoming_);
}

void RelayedCall::OnReadDone(bool ok) {
  bool is_first = false, is_cancelled = false;
  {
    const MutexLock lock(mutex_);
    is_reading_ = false;
    if (is_over_) return;
    is_first = upstream_ == nullptr && !first_;
    is_cancelled = is_cancelled_;
    if (!ok) has_client_ended_ = true;
  }
  if (!ok && is_first) return is_cancelled ? End(ClientIsGone()) : Open({});  // the handler tells what is missing
  if (!ok) return Pump();
  const Status taken = TakeIn(incoming_.Length());
  if (!taken.ok()) return is_first ? End(taken) : CutOff(taken);
  grpc::ByteBuffer message;
  message.Swap(&incoming_);
  RouteFields::Found found;
  if (is_first) found = method_->fields.In(message);
  {
    const MutexLock lock(mutex_);
    (is_first ? first_ : pending_) = std::move(message);
  }
  if (!is_first) return Pump();
  const bool stays = found.map.empty() || found.is_eventual;
  Go(stays ? Route{} : relay_.RouteTo(std::move(found.map), is_passed_on_));
}

Status RelayedCall::TakeIn(std::size_t num_bytes) {
  if (num_bytes > method_->most_bytes) return RequestTooLarge(num_bytes, method_->most_bytes);
  const MutexLock lock(mutex_);
  const std::size_t kept_bytes = first_ ? first_->Length() : 0;
  return request_share_->Resize(kept_bytes + num_bytes) ? Status::Ok() : TooManyBytes();
}

void RelayedCall::CutOff(const Status& why) {
  const MutexLock lock(mutex_);
  failure_ = why;
  if (upstream_ != nullptr) upstream_->Cancel();
}

void RelayedCall::OnSent() {
  {
    const MutexLock lock(mutex_);
    is_sending_ = false;
  }
  if (comes_in_messages_) Pump();
}

void RelayedCall::OnAnswer(grpc::ByteBuffer answer) {
  const std::shared_ptr<UpstreamCall> upstream = Upstream();
  if (!std::exchange(has_told_head_, true)) PassAnswerHead(upstream->context(), *call_);
  {
    const MutexLock lock(mutex_);
    first_.reset();  // it was taken
  }
  if (!answer_share_->Resize(answer.Length())) {
    CutOff(TooManyBytes());
    return upstream->ReadNext();
  }
  answer_.Swap(&answer);
  StartWrite(&answer_);
}

void RelayedCall::OnWriteDone(bool ok) {
  const std::shared_ptr<UpstreamCall> upstream = Upstream();
  answer_.Clear();
  answer_share_->Release();
  if (!ok) upstream->Cancel();
  upstream->ReadNext();
}

void RelayedCall::OnCancel() {
  const MutexLock lock(mutex_);
  is_cancelled_ = true;
  if (upstream_ != nullptr) upstream_->Cancel();
}

bool RelayedCall::GoesElsewhere(const grpc::Status& status) {
  {
    const MutexLock lock(mutex_);
    const bool has_all = first_ && num_sent_ <= 1;
    if (!has_all || !is_to_peer_ || is_cancelled_ || num_upstreams_ >= kMostUpstreams || !SaysNotOwner(status)) {
      return false;
    }
    relay_.fleet().Forget(map_);
    upstream_.reset();
  }
  Ask();
  return true;
}

void RelayedCall::OnEnd(const grpc::Status& status) {
  if (GoesElsewhere(status)) return;
  const std::shared_ptr<UpstreamCall> upstream = Upstream();
  if (!std::exchange(has_told_head_, true)) PassAnswerHead(upstream->context(), *call_);
  PassAnswerEnd(upstream->context(), *call_);
  bool is_to_peer = false;
  Status failure;
  {
    const MutexLock lock(mutex_);
    is_to_peer = is_to_peer_;
    failure = failure_;
  }
  const grpc::Status outcome = !failure.ok() ? ToGrpc(failure) : is_to_peer ? AsOwnerEnded(status) : status;
  const auto& observer = relay_.context().observer;
  if (is_to_peer && observer.on_relayed)
    observer.on_relayed(method_->path, static_cast<StatusCode>(outcome.error_code()));
  End(outcome);
}

void RelayedCall::End(const grpc::Status& status) {
  {
    const MutexLock lock(mutex_);
    if (std::exchange(is_over_, true)) return;
    upstream_.reset();
  }
  Finish(status);
}

void RelayedCall::End(const Status& status) { End(ToGrpc(status)); }

}  // namespace dhpmap
