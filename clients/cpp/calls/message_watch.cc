// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/calls/message_watch.h"

#include <grpcpp/completion_queue.h>
#include <grpcpp/support/async_stream.h>

#include <algorithm>
#include <utility>

#include "clients/cpp/calls/error.h"

namespace dhpmap::client {
namespace {

constexpr double kDefaultProgress_s = 15;  // longest silence that the server promises
constexpr double kProgresses = 3;          // the connection counts as lost after this many silences
constexpr double kLook_s = 0.1;            // how soon Close is noticed while there is no connection

double SilenceOf(const v1::WatchMapRequest& request) {
  const double progress_s = request.progress_interval_s();
  return kProgresses * (progress_s > 0 ? progress_s : kDefaultProgress_s);
}

/// Whether the stream may be opened again. A server that shuts down may cancel its streams.
bool IsLost(const Status& status) {
  return status.code == StatusCode::kUnavailable || status.code == StatusCode::kCancelled;
}

}  // namespace

/// One connection. Reads one message ahead.
class MessageWatch::Connection {
 public:
  Connection(Caller& caller, const v1::WatchMapRequest& request) {
    caller.Introduce(context_);
    reader_ = caller.stub<v1::WatchService::Stub>().AsyncWatchMap(&context_, request, &queue_, this);
  }
  ~Connection() {
    Cancel();
    queue_.Shutdown();
    void* tag = nullptr;
    for (bool ok = false; queue_.Next(&tag, &ok);) {
    }
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  enum class Event { kMessage, kEnd, kTimeout };
  Event Wait(Clock::time_point end) {
    while (true) {
      void* tag = nullptr;
      bool ok = false;
      if (queue_.AsyncNext(&tag, &ok, GrpcTime(end)) != grpc::CompletionQueue::GOT_EVENT) return Event::kTimeout;
      if (!ok) return Event::kEnd;
      if (std::exchange(is_open_, true)) return Event::kMessage;
      ReadOn();
    }
  }
  void ReadOn() { reader_->Read(&message_, this); }
  [[nodiscard]] const v1::WatchMapResponse& message() const { return message_; }
  /// Call after kEnd: the stream has ended, so this does not wait.
  grpc::Status Finish() {
    grpc::Status status;
    reader_->Finish(&status, this);
    void* tag = nullptr;
    bool ok = false;
    queue_.Next(&tag, &ok);
    return status;
  }
  void Cancel() { context_.TryCancel(); }

 private:
  grpc::ClientContext context_;
  grpc::CompletionQueue queue_;
  std::unique_ptr<grpc::ClientAsyncReader<v1::WatchMapResponse>> reader_;
  v1::WatchMapResponse message_;
  bool is_open_ = false;
};

MessageWatch::MessageWatch(std::shared_ptr<Caller> caller, v1::WatchMapRequest request, double reconnect_s,
                           GoesOn goes_on)
    : caller_(std::move(caller)),
      request_(std::move(request)),
      reconnect_s_(reconnect_s),
      silence_s_(SilenceOf(request_)),
      goes_on_(std::move(goes_on)) {}

MessageWatch::~MessageWatch() = default;

Result<std::optional<v1::WatchMapResponse>> MessageWatch::Next(Clock::time_point end) {
  for (bool has_message = false;;) {
    const Result<bool> goes_on = Step(end, has_message);
    if (!goes_on.ok()) {
      Close();
      return goes_on.status();
    }
    if (!*goes_on) return std::optional<v1::WatchMapResponse>();
    if (!has_message) continue;
    std::optional<v1::WatchMapResponse> message = connection_->message();
    connection_->ReadOn();
    return message;
  }
}

Result<bool> MessageWatch::Step(Clock::time_point end, bool& has_message) {
  {
    const MutexLock lock(mutex_);
    if (is_closed_) return false;
    if (connection_ == nullptr) connection_ = std::make_unique<Connection>(*caller_, request_);
  }
  switch (connection_->Wait(std::min(end, Clock::now() + Seconds(silence_s_)))) {
    case Connection::Event::kMessage:
      has_message = true;
      lost_at_.reset();
      pauses_ = {};
      if (const std::string& position = connection_->message().position(); !position.empty()) {
        request_.set_resume_after(position);
      }
      return true;
    case Connection::Event::kTimeout:
      if (Clock::now() >= end) return false;
      return Recover(Error(StatusCode::kUnavailable, "the server has been silent for too long"), end);
    case Connection::Event::kEnd: break;
  }
  const grpc::Status finished = connection_->Finish();
  if (finished.ok()) return Recover(Error(StatusCode::kUnavailable, "the server has ended the watch"), end);
  return Recover(caller_->StatusOf(finished), end);
}

Result<bool> MessageWatch::Recover(const Status& why, Clock::time_point end) {
  const Clock::time_point now = Clock::now();
  if (!lost_at_) lost_at_ = now;
  {
    const MutexLock lock(mutex_);
    connection_.reset();
    if (is_closed_) return false;
  }
  if (!IsLost(why) || now - *lost_at_ > Seconds(reconnect_s_) || (goes_on_ && !goes_on_(why))) return why;
  const Clock::time_point again = std::min(end, now + pauses_.Next());
  while (!IsClosed() && Clock::now() < again) caller_->Pause(std::min(again, Clock::now() + Seconds(kLook_s)));
  return !IsClosed() && Clock::now() < end;
}

bool MessageWatch::IsClosed() {
  const MutexLock lock(mutex_);
  return is_closed_;
}

void MessageWatch::Close() {
  const MutexLock lock(mutex_);
  is_closed_ = true;
  if (connection_ != nullptr) connection_->Cancel();
}

}  // namespace dhpmap::client
