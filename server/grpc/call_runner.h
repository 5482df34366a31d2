// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/server_context.h>
#include <grpcpp/support/server_callback.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"
#include "mapping/base/spread.h"
#include "mapping/paging/page_reader.h"
#include "server/app/maps/map_registry.h"
#include "server/app/states/pinned_snapshots.h"
#include "server/base/byte_budget.h"
#include "server/grpc/caller_budget.h"
#include "server/grpc/grpc_options.h"
#include "server/grpc/lanes.h"
#include "server/grpc/status_conversion.h"

namespace dhpmap {

class MapQuota;
class Relay;

/// Objects that all services share.
struct ServiceContext {
  MapRegistry& registry;
  Lanes& lanes;
  const GrpcOptions& options;
  const GrpcObserver& observer;
  PinnedSnapshots& held;
  std::atomic<int>& num_checks;  ///< checks that are being answered in pieces
  MapQuota& quota;
  const std::atomic<bool>* is_serving = nullptr;  ///< GrpcServer::is_serving; null: not serving
  Relay* relay = nullptr;                         ///< null: the server belongs to no fleet
};

/// Spreads work over the calling thread and idle threads of the bulk lane. Pages that they read from disk count for the
/// caller's request. Lives as long as the lane.
Spread OnBulkLane(const ServiceContext& context);

/// The bookkeeping of one call: measures its time, informs the observer, and logs an internal error once.
class CallRecord {
 public:
  /// `method`: "MapService/GetMap", a literal.
  CallRecord(const ServiceContext& context, std::string_view method) : context_(context), method_(method) {}
  /// Call it once, when the answer is known.
  void End(const Status& status) const;

 private:
  const ServiceContext& context_;
  std::string_view method_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// A call with one request. The request is kept, and counted, until the call ends: see CountedService.
struct CallMessages {
  std::string_view method;  ///< "MapService/GetMap", a literal
  const google::protobuf::Message* request;
  /// The response to fill. Null for a call that changes something: such a call is answered even if memory is short.
  const google::protobuf::Message* response = nullptr;
  /// The resource whose map the handler opens, if any: "maps/room/submaps/3".
  std::string_view opens = {};
};

/// The lane for a call that is quick once the map of the resource `opens` is loaded: quick, or loads if `request` has
/// to wait for the load.
Lane& QuickLane(const ServiceContext& context, std::string_view opens, const google::protobuf::Message& request);

/// Calls work() and turns any exception into a status (see StatusOfException): the one outer catch of every handler.
Status RunGuarded(const std::function<Status()>& work);

/// Logs INTERNAL, UNKNOWN and DATA_LOSS with their cause, which clients do not see. Ignores other codes.
void LogOurFault(std::string_view what, const Status& status);

/// The final status of a stream whose pinned state no longer fits into memory because the map has moved on.
Status StateHasNoRoom();

/// Answers from a state that is pinned while memory for it suffices. If it no longer does, or if `stop` is requested,
/// `work`'s token is set, and `work` ends with CANCELLED.
Status WhileThereIsRoom(const ServiceContext& context, std::shared_ptr<const MapSnapshot> state,
                        const std::stop_token& stop, const std::function<Status(const std::stop_token&)>& work);

/// The answer to a call for which its lane has no room.
Status TooBusy();

/// Answers a unary call. Callable from any thread; only the first call counts.
using Respond = std::function<void(const Status&)>;

/// Runs a unary handler on the quick lane, see QuickLane. The handler responds itself, at once or later from another
/// thread. An exception that it throws before that is answered as INTERNAL. A call that was cancelled or passed its
/// deadline while it waited is dropped. If too many calls wait, or the answer does not fit, the answer is
/// RESOURCE_EXHAUSTED. The token is set when the client no longer waits; the handler may ignore it.
grpc::ServerUnaryReactor* RunAsync(const ServiceContext& context, const CallMessages& call,
                                   std::function<void(Respond, std::stop_token)> handler);

/// The same on the given lane. Refused at once if an answer of `answer_bytes` does not fit.
grpc::ServerUnaryReactor* RunAsyncIn(Lane& lane, const ServiceContext& context, const CallMessages& call,
                                     std::size_t answer_bytes, std::function<void(Respond, std::stop_token)> handler);

/// Runs a unary handler as RunAsync does and responds with what it returns.
grpc::ServerUnaryReactor* Run(const ServiceContext& context, const CallMessages& call, std::function<Status()> handler);

/// The same on the bulk lane, for work of milliseconds or more. Refused at once if an answer of `answer_bytes` does not
/// fit. The token is set when the client no longer waits: the handler then ends soon, with any status.
grpc::ServerUnaryReactor* RunBulk(const ServiceContext& context, const CallMessages& call, std::size_t answer_bytes,
                                  std::function<Status(std::stop_token)> handler);

/// Memory that a stream holds between messages.
struct StreamKeeps {
  ByteShare& room;  ///< to be resized to what the stream holds, its state excepted
  /// Call it with the state that the stream reads, if any. RESOURCE_EXHAUSTED if the state does not fit.
  std::function<Status(PinnedSnapshots::State)> hold;
};

/// Streams messages to a client. The bulk lane makes one message at a time, as the client takes them. The stream is
/// refused if what it holds does not fit. Deletes itself when the call is over.
template <typename Response>
class ChunkStream final : public grpc::ServerWriteReactor<Response> {
 public:
  /// Fills the next message; false: there are no more.
  using Next = std::function<Result<bool>(Response&)>;
  /// Work before the first message, which may take long. The token is set when the client no longer waits.
  using Prepare = std::function<Result<Next>(std::stop_token, const StreamKeeps&)>;

  static ChunkStream* Start(const ServiceContext& context, grpc::CallbackServerContext* call_context,
                            const CallMessages& call, Prepare prepare) {
    auto* stream = new ChunkStream(context, call_context, call.method);
    if (!stream->share_.Resize(kKept_bytes)) {
      stream->End(TooManyBytes());
      return stream;
    }
    const auto begin = std::make_shared<LaneTask>([stream, prepare = std::move(prepare)] {
      const Status status = RunGuarded([&] {
        const PageReader reading(stream->pages_);
        const StreamKeeps keeps{stream->share_,
                                [stream](const PinnedSnapshots::State& state) { return stream->HoldState(state); }};
        DHPMAP_ASSIGN_OR_RETURN(stream->next_, prepare(stream->stop_.get_token(), keeps));
        return Status::Ok();
      });
      if (status.ok()) stream->WriteNext();
      else stream->context_.lanes.answers.Post([stream, status] { stream->End(status); });
    });
    stream->SetTask(begin);
    if (!context.lanes.bulk.TryPostLast(begin)) {
      begin->GiveUp();
      stream->End(TooBusy());
    }
    return stream;
  }

  void OnWriteDone(bool ok) override {
    SetWriting(false);
    if (!ok || has_no_room_) return End(WhyBroken());
    const auto task = std::make_shared<LaneTask>([this] { WriteNext(); });
    SetTask(task);
    context_.lanes.bulk.Post(task);  // one task per stream, so the number of open streams bounds it
    if (stop_.stop_requested() && task->GiveUp()) End(WhyBroken());
  }
  /// Drops a task that still waits for a thread, so that its state is freed now.
  void OnCancel() override {
    stop_.request_stop();
    if (const auto task = Task(); task && task->GiveUp()) End(WhyBroken());
  }
  void OnDone() override {
    (void)is_made_.load(std::memory_order_acquire);
    delete this;
  }

 private:
  /// Room for a message, its bytes, and the position in the map.
  static constexpr std::size_t kKept_bytes = 1u << 20;
  using Clock = std::chrono::steady_clock;

  ChunkStream(const ServiceContext& context, grpc::CallbackServerContext* call_context, std::string_view method)
      : context_(context),
        call_context_(call_context),
        record_(context, method),
        share_(&BudgetHere(*context.options.inflight)) {}

  Status HoldState(const PinnedSnapshots::State& state) {
    hold_ = context_.held.TryPin(state, [this] { LetGo(); });
    return hold_ != nullptr ? Status::Ok() : TooManyBytes();
  }
  /// Ends the stream after the message that is being made or written, or at once if there is none.
  void LetGo() {
    has_no_room_ = true;
    const auto task = Task();
    if (task && task->GiveUp()) return context_.lanes.answers.Post([this] { End(WhyBroken()); });
    if (IsLastLeftUntaken()) call_context_->TryCancel();
  }
  /// Whether the client has not taken the last message within the time allowed.
  bool IsLastLeftUntaken() DHPMAP_EXCLUDES(mutex_) {
    const auto now = Clock::now();
    const MutexLock lock(mutex_);
    if (!asked_at_) asked_at_ = now;
    const std::chrono::duration<double> to_take_last(context_.options.to_take_last_s);
    return writing_since_ && now - std::max(*writing_since_, *asked_at_) >= to_take_last;
  }
  void SetTask(std::shared_ptr<LaneTask> task) DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    task_ = std::move(task);
  }
  [[nodiscard]] std::shared_ptr<LaneTask> Task() const DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    return task_;
  }
  void SetWriting(bool is_writing) DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    writing_since_ = is_writing ? std::optional(Clock::now()) : std::nullopt;
  }
  [[nodiscard]] Status WhyBroken() const { return has_no_room_ ? StateHasNoRoom() : Cancelled("the client went away"); }

  void WriteNext() {
    (void)is_made_.load(std::memory_order_acquire);
    bool has_next = false;
    response_.Clear();
    const Status status = RunGuarded([&] {
      const PageReader reading(pages_);
      if (stop_.stop_requested() || has_no_room_) return WhyBroken();
      DHPMAP_ASSIGN_OR_RETURN(has_next, next_(response_));
      return Status::Ok();
    });
    is_made_.store(true, std::memory_order_release);
    context_.lanes.answers.Post([this, status, has_next] {
      if (!status.ok() || !has_next) return End(status);
      SetWriting(true);
      this->StartWrite(&response_);
    });
  }

  void End(const Status& status) {
    record_.End(status);
    this->Finish(ToGrpc(status));
  }

  const ServiceContext& context_;
  grpc::CallbackServerContext* const call_context_;
  CallRecord record_;
  ByteShare share_;
  std::atomic<bool> has_no_room_ = false;  // for the pinned state
  // For ThreadSanitizer, which does not see gRPC's own locks: orders each message before the next one, made on another
  // thread, and all messages before the end. Without it each suppressed race costs a lookup: minutes in total.
  std::atomic<bool> is_made_ = false;
  std::unique_ptr<PinnedSnapshots::Pin> hold_;
  PageHold pages_;  ///< pages of the state that this stream has read
  mutable Mutex mutex_;
  std::shared_ptr<LaneTask> task_ DHPMAP_GUARDED_BY(mutex_);             ///< the newest
  std::optional<Clock::time_point> asked_at_ DHPMAP_GUARDED_BY(mutex_);  ///< when the stream was first asked to end
  std::optional<Clock::time_point> writing_since_ DHPMAP_GUARDED_BY(mutex_);
  std::stop_source stop_;
  Next next_;
  Response response_;
};

}  // namespace dhpmap
