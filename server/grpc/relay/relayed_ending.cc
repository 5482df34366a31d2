// SPDX-License-Identifier: BSD-3-Clause
// How a relayed call ends: cancelled, cut off, answered by the owner, or passed to the next owner.
#include <utility>

#include "proto/types/status_conversion.h"
#include "server/grpc/relay/passed_metadata.h"
#include "server/grpc/relay/relayed_call.h"

namespace dhpmap {
namespace {

constexpr int kMostUpstreams = 2;  // the database is asked once more, not again and again

bool SaysNotOwner(const grpc::Status& status) {
  return status.error_code() == grpc::UNAVAILABLE && ReadErrorDetails(status.error_details()).reason == "NOT_OWNER";
}

}  // namespace

void RelayedCall::OnCancel() {
  const MutexLock lock(mutex_);
  is_cancelled_ = true;
  if (upstream_ != nullptr) upstream_->Cancel();
}

void RelayedCall::CutOff(const Status& why) {
  const MutexLock lock(mutex_);
  if (failure_.ok()) failure_ = why;
  if (upstream_ != nullptr) upstream_->Cancel();
}

bool RelayedCall::GoesElsewhere(const grpc::Status& status) {
  {
    const MutexLock lock(mutex_);
    const bool may_go = !is_cancelled_ && failure_.ok() && num_upstreams_ < kMostUpstreams;
    if (!may_go || owner_address_.empty() || !requests_.CanRestart() || !SaysNotOwner(status)) return false;
    relay_.fleet().Forget(map_);
    upstream_.reset();
  }
  Ask();
  return true;
}

void RelayedCall::OnEnd(const grpc::Status& status) {
  if (GoesElsewhere(status)) return;
  const std::shared_ptr<UpstreamCall> upstream = Upstream();
  PassHeadOnce(*upstream);
  PassAnswerEnd(upstream->context(), *call_);
  End(OutcomeOf(status));
}

grpc::Status RelayedCall::OutcomeOf(const grpc::Status& status) {
  std::string owner_address;
  Status failure;
  {
    const MutexLock lock(mutex_);
    owner_address = owner_address_;
    failure = failure_;
  }
  const bool is_to_peer = !owner_address.empty();
  if (is_to_peer && failure.ok()) relay_.NoteEnd(owner_address, status);
  const grpc::Status outcome = !failure.ok() ? ToGrpc(failure) : is_to_peer ? AsOwnerEnded(status) : status;
  const auto& on_relayed = relay_.context().observer.on_relayed;
  if (is_to_peer && on_relayed) on_relayed(method_->path, static_cast<StatusCode>(outcome.error_code()));
  return outcome;
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
