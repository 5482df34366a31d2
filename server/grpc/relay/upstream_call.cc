// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/upstream_call.h"

#include <grpcpp/generic/generic_stub.h>

#include <utility>

namespace dhpmap {

void UpstreamCall::Start(const std::string& path) {
  self_ = shared_from_this();
  grpc::GenericStub(channel_).PrepareBidiStreamingCall(&context_, path, {}, this);
  {
    const MutexLock lock(mutex_);
    is_open_ = true;
  }
  AddHold();
  ReadNext();  // at once: within the process an answer is lost that comes with its status before anybody reads
  StartCall();
}

bool UpstreamCall::Send(grpc::ByteBuffer& message, bool is_last) {
  const MutexLock lock(mutex_);
  if (!is_open_) return false;
  outgoing_.Swap(&message);
  if (is_last) StartWriteLast(&outgoing_, grpc::WriteOptions());
  else StartWrite(&outgoing_);
  return true;
}

void UpstreamCall::SendEnd() {
  const MutexLock lock(mutex_);
  if (is_open_) StartWritesDone();
}

void UpstreamCall::OnReadInitialMetadataDone(bool) {
  {
    const MutexLock lock(mutex_);
    has_head_ = true;
    if (!std::exchange(is_answer_kept_, false)) return;
  }
  Tell();
}

void UpstreamCall::OnReadDone(bool ok) {
  if (ok) {
    {
      const MutexLock lock(mutex_);
      is_answer_kept_ = !has_head_;
      if (is_answer_kept_) return;
    }
    return Tell();
  }
  const MutexLock lock(mutex_);
  is_open_ = false;
  RemoveHold();
}

void UpstreamCall::Tell() {
  grpc::ByteBuffer answer;
  answer.Swap(&incoming_);
  listener_->OnAnswer(std::move(answer));
}

void UpstreamCall::OnWriteDone(bool ok) {
  outgoing_.Clear();
  if (ok) listener_->OnSent();
}

void UpstreamCall::OnDone(const grpc::Status& status) {
  const auto last = std::move(self_);
  const auto listener = std::move(listener_);
  listener->OnEnd(status);
}

}  // namespace dhpmap
