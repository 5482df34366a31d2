// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/src/stream_source.h"

#include <grpcpp/completion_queue.h>
#include <grpcpp/support/async_stream.h>

#include <algorithm>
#include <utility>

#include "clients/cpp/calls/error.h"

namespace dhpmap::client {
namespace {

Status TooLate() { return Error(StatusCode::kDeadlineExceeded, "the answer took longer than the deadline"); }

/// Whether the pin has expired.
bool IsOldPin(const Status& status) {
  return status.code == StatusCode::kFailedPrecondition &&
         std::any_of(status.violations.begin(), status.violations.end(),
                     [](const FieldViolation& its) { return its.field == "pin"; });
}

}  // namespace

/// One call of the RPC. Each step has a deadline; after a failed step the stream is unusable.
class StreamSource::Stream {
 public:
  explicit Stream(Caller& caller) : caller_(caller) {
    caller.Introduce(context_);
    call_ = caller.stub<v1::QueryService::Stub>().AsyncStreamQueries(&context_, &queue_, this);
  }
  ~Stream() {
    context_.TryCancel();
    queue_.Shutdown();
    void* tag = nullptr;
    for (bool ok = false; queue_.Next(&tag, &ok);) {
    }
  }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  Result<v1::StreamQueriesResponse> Exchange(v1::StreamQueriesRequest& query, Clock::time_point end) {
    if (!std::exchange(is_open_, true)) {
      if (Status status = Step(end); !status.ok()) return status;
    }
    query.set_sequence(++sequence_);
    call_->Write(query, this);
    if (Status status = Step(end); !status.ok()) return status;
    v1::StreamQueriesResponse answer;
    call_->Read(&answer_, this);
    if (Status status = Step(end); !status.ok()) return status;
    if (answer_.sequence() != sequence_) return Error(StatusCode::kInternal, "the answer is to another query");
    answer.Swap(&answer_);
    return answer;
  }

 private:
  /// Waits for the pending operation.
  Status Step(Clock::time_point end) {
    void* tag = nullptr;
    bool ok = false;
    if (queue_.AsyncNext(&tag, &ok, GrpcTime(end)) != grpc::CompletionQueue::GOT_EVENT) return TooLate();
    if (ok) return {};
    call_->Finish(&finished_, this);
    if (queue_.AsyncNext(&tag, &ok, GrpcTime(end)) != grpc::CompletionQueue::GOT_EVENT) return TooLate();
    if (finished_.ok()) return Error(StatusCode::kUnavailable, "the server has ended the stream");
    return caller_.StatusOf(finished_);
  }

  const Caller& caller_;
  grpc::ClientContext context_;
  grpc::CompletionQueue queue_;
  std::unique_ptr<grpc::ClientAsyncReaderWriter<v1::StreamQueriesRequest, v1::StreamQueriesResponse>> call_;
  v1::StreamQueriesResponse answer_;  // outlives the pending operation
  grpc::Status finished_;
  std::int64_t sequence_ = 0;
  bool is_open_ = false;
};

StreamSource::StreamSource(std::shared_ptr<Caller> caller, std::string map, OldPin old_pin)
    : Source(std::move(map)), caller_(std::move(caller)), old_pin_(old_pin) {}

StreamSource::~StreamSource() = default;

Result<v1::StreamQueriesResponse> StreamSource::Answer(v1::StreamQueriesRequest query, double deadline_s) {
  const Clock::time_point end = Clock::now() + Seconds(caller_->DeadlineOr(deadline_s));
  const Turn turn(turns_, end);
  if (!turn.is_ours()) return TooLate();
  Result<v1::StreamQueriesResponse> answer = AnswerBy(query, end);
  if (!answer.ok() && old_pin_ == OldPin::kRenew && IsOldPin(answer.status())) {
    if (Status status = PinAgain(end); !status.ok()) return status;
    answer = AnswerBy(query, end);
  }
  return answer;
}

std::unique_ptr<Parts<v1::QueryDistanceGridResponse>> StreamSource::AnswerGrid(v1::QueryDistanceGridRequest query,
                                                                               double deadline_s) {
  query.set_read_revision(std::max<std::int64_t>(pinned_, 0));
  return caller_->Read(&v1::QueryService::Stub::QueryDistanceGrid, query, caller_->DeadlineOr(deadline_s));
}

Result<std::int64_t> StreamSource::Pin(std::int64_t revision) {
  const Clock::time_point end = Clock::now() + Seconds(caller_->DeadlineOr(0));
  v1::StreamQueriesRequest query;
  if (revision >= 0) query.mutable_pin()->set_map(map());
  query.mutable_pin()->set_read_revision(std::max<std::int64_t>(revision, 0));
  const Turn turn(turns_, end);
  if (!turn.is_ours()) return TooLate();
  pinned_ = 0;
  Result<v1::StreamQueriesResponse> answer = AnswerBy(query, end);
  if (!answer.ok()) return answer.status();
  pinned_ = answer->pin().revision();
  return pinned_.load();
}

Result<v1::StreamQueriesResponse> StreamSource::AnswerBy(v1::StreamQueriesRequest& query, Clock::time_point end) {
  for (Pauses pauses;;) {
    Result<v1::StreamQueriesResponse> answer = AnswerOnce(query, end);
    if (answer.ok() || !IsPassing(answer.status())) return answer;
    const Clock::duration pause = pauses.Next();
    if (Clock::now() + pause >= end) return answer;
    caller_->Pause(Clock::now() + pause);
  }
}

Result<v1::StreamQueriesResponse> StreamSource::AnswerOnce(v1::StreamQueriesRequest& query, Clock::time_point end) {
  if (stream_ == nullptr) {
    stream_ = std::make_unique<Stream>(*caller_);
    if (Status status = pinned_ > 0 ? PinAgain(end) : Status{}; !status.ok()) return status;
  }
  Result<v1::StreamQueriesResponse> answer = stream_->Exchange(query, end);
  if (!answer.ok()) {
    stream_.reset();
    return answer;
  }
  if (answer->has_error()) return client::StatusOf(answer->error());
  return answer;
}

Status StreamSource::PinAgain(Clock::time_point end) {
  v1::StreamQueriesRequest pin;
  pin.mutable_pin()->set_map(map());
  pin.mutable_pin()->set_read_revision(pinned_);
  const Result<v1::StreamQueriesResponse> answer = stream_->Exchange(pin, end);
  Status status = answer.ok() && answer->has_error() ? client::StatusOf(answer->error()) : answer.status();
  if (!status.ok()) stream_.reset();  // else the next query would use another state
  return status;
}

}  // namespace dhpmap::client
