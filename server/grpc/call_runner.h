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

/// What all services share.
struct ServiceContext {
  MapRegistry& registry;
  Lanes& lanes;
  const GrpcOptions& options;
  const GrpcObserver& observer;
  PinnedSnapshots& held;
  std::atomic<int>& num_checks;  ///< that are being answered in pieces
  MapQuota& quota;
  const std::atomic<bool>* is_serving = nullptr;  ///< GrpcServer::is_serving; null: it is not
  Relay* relay = nullptr;                         ///< null: there is no fleet
};

/// Over the calling thread and those of the bulk lane that have nothing else to do. What they read from the disk counts
/// for the caller's request. Lives as long as the lane.
Spread OnBulkLane(const ServiceContext& context);

/// The bookkeeping of one call: takes its time, tells the observer, and logs an error that is our fault, once.
class CallRecord {
 public:
  /// `method`: "MapService/GetMap", a literal.
  CallRecord(const ServiceContext& context, std::string_view method) : context_(context), method_(method) {}
  /// To be called once, when the answer is known.
  void End(const Status& status) const;

 private:
  const ServiceContext& context_;
  std::string_view method_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// A call with one request, which is kept, and counted, until it is over: see CountedService.
struct CallMessages {
  std::string_view method;  ///< "MapService/GetMap", a literal
  const google::protobuf::Message* request;
  /// To be filled, if there is one and the call changes nothing; a call that changed something is answered, whatever
  /// room there is.
  const google::protobuf::Message* response = nullptr;
  /// The resource whose map the handler opens, if it does: "maps/room/submaps/3".
  std::string_view opens = {};
};

/// The lane for what is quick once the map of the resource `opens` is there for `request`: quick, unless that is to be
/// loaded first.
Lane& QuickLane(const ServiceContext& context, std::string_view opens, const google::protobuf::Message& request);

/// Calls work() and turns whatever it throws into a status (see StatusOfException): the one outer
/// catch of every handler.
Status RunGuarded(const std::function<Status()>& work);

/// Logs INTERNAL, UNKNOWN and DATA_LOSS with their cause, which clients are not told; nothing else.
void LogOurFault(std::string_view what, const Status& status);

/// What a stream ends with whose map has gone on for so long that there is no room for the state it shows.
Status StateHasNoRoom();

/// Answers from a state that is held for it as long as there is room for what only it still needs; `work` is told when
/// there is none any longer, or when `stop` is requested, and then ends with CANCELLED.
Status WhileThereIsRoom(const ServiceContext& context, std::shared_ptr<const MapSnapshot> state,
                        const std::stop_token& stop, const std::function<Status(const std::stop_token&)>& work);

/// What a call is answered for which there is no room in its lane.
Status TooBusy();

/// Answers a unary call. From any thread; the first call counts.
using Respond = std::function<void(const Status&)>;

/// Runs a unary handler on the quick lane, see QuickLane; it responds itself, at once or later from another thread.
/// What it throws before that is answered as INTERNAL. A call whose client is gone, or past its deadline, before its
/// turn has come is let go at once; if too many wait, or there is no room for the answer, it is
/// answered RESOURCE_EXHAUSTED. The token tells when nobody waits for the answer any longer; a handler may go on all
/// the same.
grpc::ServerUnaryReactor* RunAsync(const ServiceContext& context, const CallMessages& call,
                                   std::function<void(Respond, std::stop_token)> handler);

/// The same on a lane of the caller's choice, and refused at once if there is no room for an answer of `answer_bytes`.
grpc::ServerUnaryReactor* RunAsyncIn(Lane& lane, const ServiceContext& context, const CallMessages& call,
                                     std::size_t answer_bytes, std::function<void(Respond, std::stop_token)> handler);

/// Runs a unary handler as RunAsync does and responds with what it returns.
grpc::ServerUnaryReactor* Run(const ServiceContext& context, const CallMessages& call, std::function<Status()> handler);

/// The same on the bulk lane, for what takes milliseconds or more, and refused at once if there is no room for an
/// answer of `answer_bytes`. The token tells when nobody waits for the answer any longer: then the handler ends soon,
/// with whatever status.
grpc::ServerUnaryReactor* RunBulk(const ServiceContext& context, const CallMessages& call, std::size_t answer_bytes,
                                  std::function<Status(std::stop_token)> handler);

/// What a stream keeps from message to message.
struct StreamKeeps {
  ByteShare& room;  ///< to grow by what that is, but for a state
  /// To be called with the state that it goes through, if it does. RESOURCE_EXHAUSTED if there is no room for one.
  std::function<Status(PinnedSnapshots::State)> hold;
};

/// Streams messages to a client, made on the bulk lane one at a time while the client takes them; refused if there is
/// no room for what a stream keeps. Deletes itself when the call is over.
template <typename Response>
class ChunkStream final : public grpc::ServerWriteReactor<Response> {
 public:
  /// Fills the next message; false: there is none.
  using Next = std::function<Result<bool>(Response&)>;
  /// What comes before the first message, which may take long; the token tells when nobody waits for it any longer.
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
    context_.lanes.bulk.Post(task);  // one a stream, so bounded by the streams that have begun
    if (stop_.stop_requested() && task->GiveUp()) End(WhyBroken());
  }
  /// What waits for a thread is given up, so that its state goes at once and not when its turn has come.
  void OnCancel() override {
    stop_.request_stop();
    if (const auto task = Task(); task && task->GiveUp()) End(WhyBroken());
  }
  void OnDone() override {
    (void)is_made_.load(std::memory_order_acquire);
    delete this;
  }

 private:
  /// A message, its bytes on the way out, and where in the map it has got to.
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
  /// Once what is being made or written is, or at once if nothing is.
  void LetGo() {
    has_no_room_ = true;
    const auto task = Task();
    if (task && task->GiveUp()) return context_.lanes.answers.Post([this] { End(WhyBroken()); });
    if (IsLastLeftUntaken()) call_context_->TryCancel();
  }
  /// Since we were asked to let go, for longer than there is time.
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
  std::atomic<bool> has_no_room_ = false;  // for the state any longer
  // So that ThreadSanitizer, which sees none of gRPC's own locks, sees that one message was made before the next, on
  // another thread, and all before the end. Else it looks each access up in all races that it leaves out: minutes.
  std::atomic<bool> is_made_ = false;
  std::unique_ptr<PinnedSnapshots::Pin> hold_;
  PageHold pages_;  ///< that the state has because this has read them
  mutable Mutex mutex_;
  std::shared_ptr<LaneTask> task_ DHPMAP_GUARDED_BY(mutex_);             ///< the newest
  std::optional<Clock::time_point> asked_at_ DHPMAP_GUARDED_BY(mutex_);  ///< first, to let go
  std::optional<Clock::time_point> writing_since_ DHPMAP_GUARDED_BY(mutex_);
  std::stop_source stop_;
  Next next_;
  Response response_;
};

}  // namespace dhpmap
