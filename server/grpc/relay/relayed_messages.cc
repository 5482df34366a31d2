// SPDX-License-Identifier: BSD-3-Clause
// The messages of a relayed call, from the client to the owner and back.
#include <utility>

#include "server/base/request_limits.h"
#include "server/grpc/relay/client_is_gone.h"
#include "server/grpc/relay/passed_metadata.h"
#include "server/grpc/relay/relayed_call.h"

namespace dhpmap {

void RelayedCall::Read() {
  const MutexLock lock(mutex_);
  requests_.OnReadBegun();
  StartRead(&incoming_);
}

void RelayedCall::OnReadDone(bool ok) {
  bool is_first = false;
  {
    const MutexLock lock(mutex_);
    if (is_over_) return;
    is_first = num_upstreams_ == 0 && !requests_.has_first();
  }
  if (!ok) return OnLastRead();
  const Status taken = RunGuarded([&] { return TakeMessage(is_first); });
  if (taken.ok()) return;
  if (is_first) End(taken);
  else CutOff(taken);
}

void RelayedCall::OnLastRead() {
  bool has_upstream = false, is_cancelled = false;
  {
    const MutexLock lock(mutex_);
    requests_.OnClientEnd();
    has_upstream = num_upstreams_ > 0;
    is_cancelled = is_cancelled_;
  }
  if (has_upstream) Pump();
  else if (is_cancelled) End(ClientIsGone());
  else Open({});  // the handler says what is missing
}

Status RelayedCall::TakeMessage(bool is_first) {
  const std::size_t num_bytes = incoming_.Length();
  if (num_bytes > method_->most_bytes) return RequestTooLarge(num_bytes, method_->most_bytes);
  grpc::ByteBuffer message;
  message.Swap(&incoming_);
  RouteFields::Found found;
  if (is_first) found = method_->fields.In(message);
  {
    const MutexLock lock(mutex_);
    DHPMAP_RETURN_IF_ERROR(requests_.OnRead(std::move(message)));
  }
  const bool stays = found.map.empty() || found.is_eventual;
  if (!is_first) Pump();
  else Go(stays ? Route{} : relay_.RouteTo(std::move(found.map), is_passed_on_));
  return Status::Ok();
}

void RelayedCall::Pump() {
  using Step = RequestFlow::Step;
  const MutexLock lock(mutex_);
  if (is_over_ || upstream_ == nullptr) return;
  switch (const Step step = requests_.Next()) {
    case Step::kNone: return;
    case Step::kRead: return StartRead(&incoming_);
    case Step::kSend:
    case Step::kSendLast:
      if (!upstream_->Send(requests_.message(), step == Step::kSendLast)) requests_.OnNotTaken();
      return;
    case Step::kSendEnd: return upstream_->SendEnd();
  }
}

void RelayedCall::OnSent() {
  {
    const MutexLock lock(mutex_);
    requests_.OnSent();
  }
  Pump();
}

std::shared_ptr<UpstreamCall> RelayedCall::Upstream() const {
  const MutexLock lock(mutex_);
  return upstream_;
}

void RelayedCall::PassHeadOnce(UpstreamCall& upstream) {
  if (!std::exchange(has_passed_head_, true)) PassAnswerHead(upstream.context(), *call_);
}

void RelayedCall::OnAnswer(grpc::ByteBuffer answer) {
  const std::shared_ptr<UpstreamCall> upstream = Upstream();
  PassHeadOnce(*upstream);
  {
    const MutexLock lock(mutex_);
    requests_.OnAnswer();
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

}  // namespace dhpmap
