// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/request_flow.h"

#include <utility>

namespace dhpmap {

Status RequestFlow::SetRequest(grpc::ByteBuffer request) {
  if (!share_->Resize(request.Length())) return TooManyBytes();
  first_ = std::move(request);
  has_client_ended_ = true;
  return Status::Ok();
}

Status RequestFlow::OnRead(grpc::ByteBuffer message) {
  const bool is_first = num_sent_ == 0 && !first_;
  is_reading_ = false;
  const std::size_t kept_bytes = first_ ? first_->Length() : 0;
  if (!share_->Resize(kept_bytes + message.Length())) return TooManyBytes();
  (is_first ? first_ : pending_) = std::move(message);
  return Status::Ok();
}

void RequestFlow::OnClientEnd() {
  is_reading_ = false;
  has_client_ended_ = true;
}

RequestFlow::Step RequestFlow::Next() {
  if (is_sending_) return Step::kNone;
  if (num_sent_ == 0 && first_) {
    message_ = *first_;  // shares its bytes
    num_sent_ = 1;
    is_sending_ = true;
    has_sent_end_ = !is_stream_;
    return is_stream_ ? Step::kSend : Step::kSendLast;
  }
  if (pending_) {
    message_ = *std::exchange(pending_, std::nullopt);
    ++num_sent_;
    is_sending_ = true;
    return Step::kSend;
  }
  if (has_client_ended_) return std::exchange(has_sent_end_, true) ? Step::kNone : Step::kSendEnd;
  return std::exchange(is_reading_, true) ? Step::kNone : Step::kRead;
}

void RequestFlow::OnNotTaken() {
  // `is_sending_` stays: nothing more goes to this upstream call.
  if (num_sent_ <= 1) return;
  pending_ = std::move(message_);
  message_.Clear();
  --num_sent_;
}

void RequestFlow::Restart() {
  num_sent_ = 0;
  is_sending_ = has_sent_end_ = false;
}

}  // namespace dhpmap
