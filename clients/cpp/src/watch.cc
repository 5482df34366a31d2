// SPDX-License-Identifier: BSD-3-Clause
#include "dhpmap/watch.h"

#include <grpcpp/completion_queue.h>
#include <grpcpp/support/async_stream.h>

#include <algorithm>
#include <utility>

#include "clients/cpp/src/convert/changes.h"
#include "clients/cpp/src/convert/geometry.h"
#include "clients/cpp/src/error.h"
#include "clients/cpp/src/watch_impl.h"

namespace dhpmap::client {
namespace {

constexpr double kProgress_s = 5;  // the server says something at least so often
constexpr double kSilence_s = 3 * kProgress_s;
constexpr double kForever_s = 3e7;
constexpr double kLook_s = 0.1;  // how soon Close is noticed while there is no connection

}  // namespace

/// One connection. Reads ahead by one message.
class Watch::Impl::Call {
 public:
  Call(Caller& caller, const v1::WatchMapRequest& request) {
    caller.Introduce(context_);
    reader_ = caller.stub<v1::WatchService::Stub>().AsyncWatchMap(&context_, request, &queue_, this);
  }
  ~Call() {
    Cancel();
    queue_.Shutdown();
    void* tag = nullptr;
    for (bool ok = false; queue_.Next(&tag, &ok);) {
    }
  }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

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
  /// After kEnd. A stream that has ended tells its status without waiting for anybody.
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

Watch::Impl::Impl(std::shared_ptr<Caller> caller, const std::string& map, const WatchOptions& options)
    : caller_(std::move(caller)), reconnect_s_(options.reconnect_s) {
  request_.set_map(map);
  request_.set_progress_interval_s(kProgress_s);
  request_.set_resume_after(options.resume_after);
  if (options.after_revision) request_.set_start_revision(*options.after_revision + 1);
  v1::WatchFilter& filter = *request_.mutable_filter();
  for (const std::int64_t id : options.objects) filter.add_instance_ids(id);
  for (const std::string& name : options.classes) filter.add_class_names(name);
  if (options.region) *filter.mutable_region() = ToProto(*options.region);
}

Watch::Impl::~Impl() = default;

Result<std::optional<Change>> Watch::Impl::Next(double idle_s) {
  const Clock::time_point end = Clock::now() + Seconds(idle_s < 0 ? kForever_s : idle_s);
  while (told_.empty()) {
    const Result<bool> goes_on = Step(end);
    if (!goes_on.ok()) {
      Close();
      return goes_on.status();
    }
    if (!*goes_on) return std::optional<Change>();
  }
  std::optional<Change> change = std::move(told_.front());
  told_.pop_front();
  return change;
}

Result<bool> Watch::Impl::Step(Clock::time_point end) {
  {
    const MutexLock lock(mutex_);
    if (is_closed_) return false;
    if (call_ == nullptr) call_ = std::make_unique<Call>(*caller_, request_);
  }
  switch (call_->Wait(std::min(end, Clock::now() + Seconds(kSilence_s)))) {
    case Call::Event::kMessage:
      Take(call_->message());
      call_->ReadOn();
      return true;
    case Call::Event::kTimeout:
      if (Clock::now() >= end) return false;
      return Recover(Error(StatusCode::kUnavailable, "the server has been silent for too long"), end);
    case Call::Event::kEnd: break;
  }
  const grpc::Status finished = call_->Finish();
  if (finished.ok()) return Recover(Error(StatusCode::kUnavailable, "the server has ended the watch"), end);
  return Recover(caller_->StatusOf(finished), end);
}

void Watch::Impl::Take(const v1::WatchMapResponse& message) {
  lost_at_.reset();
  pauses_ = {};
  const bool is_last = !message.position().empty();
  for (const v1::SubmapEvent& event : message.change().submaps()) {
    unfinished_.push_back(ChangeOf(event, message.change().last_revision()));
  }
  if (message.has_progress()) revision_ = std::max(revision_, message.progress().revision());
  if (!is_last) return;
  request_.set_resume_after(message.position());
  if (message.has_change()) revision_ = message.change().last_revision();
  for (Change& change : unfinished_) {
    change.position = message.position();
    told_.push_back(std::move(change));
  }
  unfinished_.clear();
}

Result<bool> Watch::Impl::Recover(const Status& why, Clock::time_point end) {
  unfinished_.clear();  // comes again
  const Clock::time_point now = Clock::now();
  if (!lost_at_) lost_at_ = now;
  {
    const MutexLock lock(mutex_);
    call_.reset();
    if (is_closed_) return false;
  }
  if (why.code != StatusCode::kUnavailable || now - *lost_at_ > Seconds(reconnect_s_)) return why;
  const Clock::time_point again = std::min(end, now + pauses_.Next());
  while (!IsClosed() && Clock::now() < again) caller_->Pause(std::min(again, Clock::now() + Seconds(kLook_s)));
  return !IsClosed() && Clock::now() < end;
}

bool Watch::Impl::IsClosed() {
  const MutexLock lock(mutex_);
  return is_closed_;
}

void Watch::Impl::Close() {
  const MutexLock lock(mutex_);
  is_closed_ = true;
  if (call_ != nullptr) call_->Cancel();
}

Watch::Watch(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Watch::Watch(Watch&&) noexcept = default;
Watch& Watch::operator=(Watch&&) noexcept = default;
Watch::~Watch() = default;
Result<std::optional<Change>> Watch::Next(double idle_s) { return impl_->Next(idle_s); }
std::int64_t Watch::revision() const { return impl_->revision(); }
void Watch::Close() { impl_->Close(); }

}  // namespace dhpmap::client
