// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/relayed_call.h"

#include <utility>

#include "server/auth/rights.h"
#include "server/grpc/door_call.h"
#include "server/grpc/relay/client_is_gone.h"
#include "server/grpc/relay/make_upstream.h"

namespace dhpmap {
namespace {

using Way = Route::Way;

}  // namespace

RelayedCall* RelayedCall::Start(Relay& relay, std::shared_ptr<const RelayedMethod> method,
                                grpc::CallbackServerContext* call, Route route, std::optional<grpc::ByteBuffer> first) {
  const auto self =
      std::make_shared<RelayedCall>(relay, std::move(method), call, route.is_passed_on, !first.has_value());
  self->self_ = self;
  const Status begun = RunGuarded([&] { return self->Begin(std::move(route), std::move(first)); });
  if (!begun.ok()) self->End(begun);
  return self.get();
}

RelayedCall::RelayedCall(Relay& relay, std::shared_ptr<const RelayedMethod> method, grpc::CallbackServerContext* call,
                         bool is_passed_on, bool comes_in_messages)
    : relay_(relay),
      method_(std::move(method)),
      call_(call),
      is_passed_on_(is_passed_on),
      comes_in_messages_(comes_in_messages),
      requests_(comes_in_messages) {}

Status RelayedCall::Begin(Route route, std::optional<grpc::ByteBuffer> first) {
  if (route.way == Way::kRefuse && route.map.empty()) return route.refusal;
  DHPMAP_ASSIGN_OR_RETURN(principal_, WhoCalls(relay_.gate(), *call_));
  budget_ = relay_.gate().BudgetOf(*principal_, relay_.context().options.inflight);
  answer_share_.emplace(budget_.get());
  {
    const MutexLock lock(mutex_);
    requests_.CountIn(*budget_);
    if (first) {
      DHPMAP_RETURN_IF_ERROR(requests_.SetRequest(*std::move(first)));
    }
  }
  if (comes_in_messages_) Read();
  else Go(std::move(route));
  return Status::Ok();
}

void RelayedCall::Go(Route route) {
  // A caller who may not ask for the map gets the handler's refusal, which does not depend on the owner.
  const bool may_ask = auth::CheckMap(*principal_, route.map).ok();
  if (!may_ask || route.map.empty()) route = {.map = std::move(route.map)};
  if (route.way == Way::kRefuse) return End(route.refusal);
  if (route.way != Way::kAsk) return Open(route);
  {
    const MutexLock lock(mutex_);
    map_ = std::move(route.map);
  }
  Ask();
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
      if (route.way == Way::kRefuse) return route.refusal;
      self->Open(route);
      return Status::Ok();
    });
    if (!asked.ok()) self->End(asked);
  });
  if (relay_.context().lanes.loads.TryPost(task)) return;
  task->GiveUp();
  End(TooBusy());
}

Status RelayedCall::EnterOnce() {
  {
    const MutexLock lock(mutex_);
    if (std::exchange(has_entered_, true)) return Status::Ok();
  }
  return EnterAs(relay_.gate(), principal_, method_->needs, relay_.context().options.inflight, *call_);
}

void RelayedCall::Open(const Route& route) {
  const Status entered = route.way == Way::kOn ? EnterOnce() : Status::Ok();
  if (!entered.ok()) return End(entered);
  const auto upstream = MakeUpstream(relay_, *call_, principal_, route, shared_from_this());
  if (!upstream.ok()) return End(upstream.status());
  const Status set = SetUpstream(*upstream, route);
  if (!set.ok()) return End(set);
  (*upstream)->Start(method_->path);
  Pump();
}

Status RelayedCall::SetUpstream(const std::shared_ptr<UpstreamCall>& upstream, const Route& route) {
  const MutexLock lock(mutex_);
  if (is_cancelled_) return ClientIsGone();
  DHPMAP_RETURN_IF_ERROR(failure_);
  upstream_ = upstream;
  ++num_upstreams_;
  requests_.Restart();
  map_ = route.map;
  owner_address_ = route.way == Way::kOn ? route.owner->address : std::string();
  return Status::Ok();
}

}  // namespace dhpmap
