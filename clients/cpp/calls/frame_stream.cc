// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/calls/frame_stream.h"

#include <algorithm>
#include <utility>

#include "clients/cpp/calls/error.h"
#include "proto/types/metadata_keys.h"

namespace dhpmap::client {
namespace {

constexpr std::size_t kMostUnacknowledged = 8;
constexpr std::size_t kMostNotes = 1000;
/// Lost connections in a row without a newly stored frame: a frame that crashes the server must not do so for ever.
constexpr int kMostLosses = 10;

/// Whether the server may accept the same frame a little later.
bool IsRefusedForNow(const Status& status) {
  return status.code == StatusCode::kUnavailable || status.reason == "STORE_BEHIND" ||
         status.reason == "TOO_MANY_BYTES";
}

/// The first message of a stream, with a frame.
v1::IntegrateFramesRequest WithFrame(v1::IntegrateFramesRequest greeting, const v1::IntegrateFramesRequest& frame) {
  greeting.MergeFrom(frame);
  return greeting;
}

}  // namespace

FrameStream::FrameStream(std::shared_ptr<Caller> caller, const std::string& map, const FeedOptions& options,
                         FrameListener listener)
    : caller_(std::move(caller)), options_(options), listener_(std::move(listener)) {
  greeting_.set_map(map);
  greeting_.set_session(options.session);
  greeting_.set_take_over(options.take_over);
  greeting_.set_refuse_implausible(options.refuse_implausible);
  commit_error_ = Error(StatusCode::kUnavailable, "frames are fused, but the server does not say that they are stored");
  holder_ = std::thread([this] { Hold(); });
}

FrameStream::~FrameStream() {
  {
    const MutexLock lock(mutex_);
    is_abandoned_ = true;
    if (context_ != nullptr) context_->TryCancel();
    changed_.NotifyAll();
  }
  holder_.join();
}

Status FrameStream::WaitUntilGreeted() {
  const MutexLock lock(mutex_);
  return Wait([this]() DHPMAP_REQUIRES(mutex_) { return is_greeted_ || !has_name(); }, "the session");
}

bool FrameStream::HasRoom(std::int64_t num_bytes) {
  return kept_.empty() || kept_bytes_ + num_bytes <= options_.memory_bytes;
}

Status FrameStream::Push(std::int64_t sequence, v1::Frame frame) {
  auto request = std::make_shared<Request>();
  request->set_sequence(sequence);
  *request->mutable_frame() = std::move(frame);
  const auto num_bytes = static_cast<std::int64_t>(request->ByteSizeLong());
  const MutexLock lock(mutex_);
  if (is_closing_) return Error(StatusCode::kFailedPrecondition, "this feed is closed: open another one");
  if (!HasRoom(num_bytes)) {
    is_flushing_ = true;
    changed_.NotifyAll();
  }
  const auto has_room = [&]() DHPMAP_REQUIRES(mutex_) {
    return unacknowledged_.size() < kMostUnacknowledged && HasRoom(num_bytes);
  };
  if (Status status = Wait(has_room, "room for a frame"); !status.ok()) return status;
  kept_.emplace(sequence, std::move(request));
  kept_bytes_ += num_bytes;
  unacknowledged_.insert(sequence);
  unsent_.push_back(sequence);
  ++state_.num_sent;
  changed_.NotifyAll();
  return {};
}

Status FrameStream::Close() {
  const MutexLock lock(mutex_);
  is_closing_ = true;
  changed_.NotifyAll();
  return Wait([this]() DHPMAP_REQUIRES(mutex_) { return is_over_; }, "the end of the stream");
}

FeedState FrameStream::state() const {
  const MutexLock lock(mutex_);
  return state_;
}

std::vector<FrameNote> FrameStream::TakeNotes() {
  const MutexLock lock(mutex_);
  std::vector<FrameNote> notes(std::make_move_iterator(notes_.begin()), std::make_move_iterator(notes_.end()));
  notes_.clear();
  return notes;
}

Status FrameStream::Wait(const std::function<bool()>& is_so, const char* what) {
  const Clock::time_point began_at = Clock::now();
  while (error_.ok() && !is_so()) {
    const Clock::time_point end = std::max(heard_at_, began_at) + Seconds(options_.deadline_s);
    if (Clock::now() >= end) {
      return Error(StatusCode::kDeadlineExceeded,
                   std::string("waited for ") + what + ", and the server said nothing for deadline_s");
    }
    changed_.WaitUntil(mutex_, end);
  }
  return error_;
}

void FrameStream::Hold() {
  Pauses pauses;
  std::optional<Clock::time_point> lost_at;
  std::optional<std::int64_t> stored_before;
  int num_losses = 0;
  while (true) {
    Clock::time_point heard_before;
    {
      const MutexLock lock(mutex_);
      heard_before = heard_at_;
    }
    const Status status = Exchange();
    const bool may_pass = MayPass(status) && (!listener_.goes_on || listener_.goes_on(status));
    Clock::time_point again;
    {
      const MutexLock lock(mutex_);
      if (heard_at_ != heard_before) {
        pauses = {};
        lost_at.reset();
        if (std::exchange(stored_before, state_.stored_sequence) != state_.stored_sequence) num_losses = 0;
        num_losses += status.code == StatusCode::kUnavailable && status.reason.empty() ? 1 : 0;
      }
      is_over_ = is_abandoned_ || (status.ok() && is_closing_ && unacknowledged_.empty());
      if (status.ok() && !is_over_) continue;  // all is stored, and further frames will come
      const Clock::time_point now = Clock::now();
      lost_at = lost_at.value_or(now);
      if (!is_over_ && (!may_pass || num_losses > kMostLosses || now - *lost_at > Seconds(options_.reconnect_s))) {
        error_ = status;
        is_over_ = true;
      }
      changed_.NotifyAll();
      if (is_over_) return;
      again = now + pauses.Next();
    }
    AwaitConnection(again);
  }
}

bool FrameStream::MayPass(const Status& status) const {
  if (!has_name()) return false;
  // Without a reason the error is gRPC's own: the frame exceeds the server's message limit, so a retry is useless.
  return status.code == StatusCode::kUnavailable ||
         (status.code == StatusCode::kResourceExhausted && !status.reason.empty());
}

void FrameStream::AwaitConnection(Clock::time_point again) {
  constexpr auto kLook = std::chrono::milliseconds(100), kLongest = std::chrono::milliseconds(2000);
  bool is_connected = false;
  while (Clock::now() < again || (!is_connected && Clock::now() < again + kLongest)) {
    {
      const MutexLock lock(mutex_);
      if (is_abandoned_) return;
    }
    const Clock::time_point look = Clock::now() + kLook;
    is_connected = caller_->AwaitConnection(look);
    if (is_connected) std::this_thread::sleep_until(std::min(look, again));
  }
}

Status FrameStream::Exchange() {
  grpc::ClientContext context;
  caller_->Introduce(context);
  int connection = 0;
  std::string map;
  {
    const MutexLock lock(mutex_);
    map = greeting_.map();
    if (is_abandoned_) return Error(StatusCode::kCancelled, "the feed is abandoned");
    connection = ++connection_;
    is_greeted_ = !has_name();
    context_ = &context;
  }
  context.AddMetadata(kRouteMapKey, map.substr(map.find('/') + 1));
  const auto server = caller_->NearestTo(map);
  const auto stream = server->of<v1::MappingService::Stub>().IntegrateFrames(&context);
  std::thread writer([&] { WriteAll(*stream, connection); });
  const Status heard = ReadAll(*stream);
  if (!heard.ok()) context.TryCancel();
  {
    const MutexLock lock(mutex_);
    ++connection_;  // wakes the waiting writer
    context_ = nullptr;
    changed_.NotifyAll();
  }
  writer.join();
  const grpc::Status finished = stream->Finish();
  caller_->Heard(map, context, finished);
  return heard.ok() ? EndOf(finished) : heard;
}

Status FrameStream::ReadAll(Stream& stream) {
  for (Response answer; stream.Read(&answer);) {
    if (listener_.on_answer) listener_.on_answer(answer);
    if (Status status = Hear(answer); !status.ok()) return status;
  }
  return {};
}

Status FrameStream::EndOf(const grpc::Status& finished) {
  if (!finished.ok()) return caller_->StatusOf(finished);
  const MutexLock lock(mutex_);
  const bool is_asked_for = is_closing_ || is_flushing_;
  is_flushing_ = false;
  if (!is_asked_for || !unacknowledged_.empty())
    return Error(StatusCode::kUnavailable, "the server has ended the stream");
  return kept_.empty() ? Status{} : commit_error_;
}

void FrameStream::WriteAll(Stream& stream, int connection) {
  Request greeting;
  {
    const MutexLock lock(mutex_);
    greeting = greeting_;
  }
  if (has_name() && !stream.Write(greeting)) return;
  bool says_whose = !has_name();  // without a greeting, the first frame names the map
  while (const auto request = NextToSend(connection)) {
    const bool is_taken = says_whose ? stream.Write(WithFrame(greeting, *request)) : stream.Write(*request);
    if (!is_taken) return;
    says_whose = false;
  }
  stream.WritesDone();
}

std::shared_ptr<const FrameStream::Request> FrameStream::NextToSend(int connection) {
  const MutexLock lock(mutex_);
  while (connection_ == connection) {
    if (is_greeted_ && !unsent_.empty()) {
      const std::int64_t sequence = unsent_.front();
      unsent_.pop_front();
      if (const auto its = kept_.find(sequence); its != kept_.end()) return its->second;
      continue;
    }
    if (is_greeted_ && (is_closing_ || is_flushing_)) return nullptr;
    changed_.Wait(mutex_);
  }
  return nullptr;
}

Status FrameStream::Hear(const Response& answer) {
  const MutexLock lock(mutex_);
  heard_at_ = Clock::now();
  if (answer.has_commit_error()) {
    commit_error_ = client::StatusOf(answer.commit_error());
    commit_error_.message = "frames are fused, but not stored: " + commit_error_.message;
  }
  if (answer.has_committed_sequence()) ForgetStored(answer.committed_sequence());
  Status status;
  if (!is_greeted_) {
    if (answer.has_error()) return client::StatusOf(answer.error());
    is_greeted_ = true;
    greeting_.set_take_over(false);  // a later stream may take over from this one and keep the session
    unsent_.clear();
    for (const auto& its : kept_) unsent_.push_back(its.first);
  } else if (answer.outcome() != Response::FRAME_OUTCOME_UNSPECIFIED) {
    status = Acknowledge(answer);
  }
  changed_.NotifyAll();
  return status;
}

Status FrameStream::Acknowledge(const Response& answer) {
  const std::int64_t sequence = answer.sequence();
  if (answer.outcome() == Response::REFUSED) {
    Status error = client::StatusOf(answer.error());
    if (has_name() && IsRefusedForNow(error)) return error;
    ++state_.num_refused;
    Note({sequence, true, error.reason, error.message});
    Forget(sequence);
  }
  if (answer.outcome() == Response::FUSED) ++state_.num_fused;
  if (has_name()) unacknowledged_.erase(sequence);
  else Forget(sequence);  // it cannot be sent again
  for (const v1::FrameWarning& its : answer.warnings()) {
    Note({sequence, false, v1::FrameWarning::Fault_Name(its.fault()), its.message()});
  }
  return {};
}

void FrameStream::ForgetStored(std::int64_t sequence) {
  state_.stored_sequence = sequence;
  while (!kept_.empty() && kept_.begin()->first <= sequence) Forget(kept_.begin()->first);
}

void FrameStream::Forget(std::int64_t sequence) {
  unacknowledged_.erase(sequence);
  const auto its = kept_.find(sequence);
  if (its == kept_.end()) return;
  kept_bytes_ -= static_cast<std::int64_t>(its->second->ByteSizeLong());
  kept_.erase(its);
}

void FrameStream::Note(FrameNote note) {
  notes_.push_back(std::move(note));
  if (notes_.size() > kMostNotes) notes_.pop_front();
}

}  // namespace dhpmap::client
