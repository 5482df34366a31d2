// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/call_runner.h"

#include <atomic>

#include "mapping/base/guarded.h"
#include "mapping/paging/page_reader.h"
#include "proto/types/resource_names.h"
#include "server/grpc/answered_anywhere.h"
#include "server/log/log.h"

namespace dhpmap {
namespace {

bool IsOurFault(StatusCode code) {
  return code == StatusCode::kInternal || code == StatusCode::kUnknown || code == StatusCode::kDataLoss;
}

}  // namespace

void LogOurFault(std::string_view what, const Status& status) {
  if (IsOurFault(status.code())) LogError(std::string(what) + " failed: " + status.ToString());
}

Spread OnBulkLane(const ServiceContext& context) {
  return [&bulk = context.lanes.bulk](std::size_t count, const std::function<void(std::size_t)>& body) {
    PageHold* const hold = PageReader::Current();
    bulk.Share(count, [hold, &body](std::size_t i) {
      const PageReader reading(hold);
      body(i);
    });
  };
}

void CallRecord::End(const Status& status) const {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  if (context_.observer.on_call) context_.observer.on_call(method_, status.code(), elapsed.count());
  LogOurFault(method_, status);
}

Status RunGuarded(const std::function<Status()>& work) {
  const PageReader request;
  return Guarded<Status>(work);
}

Status StateHasNoRoom() {
  return ResourceExhausted("the map has gone on while this was read, and there is no more room for the state it shows")
      .WithReason("TOO_MANY_BYTES");
}

Status WhileThereIsRoom(const ServiceContext& context, std::shared_ptr<const MapSnapshot> state,
                        const std::stop_token& stop, const std::function<Status(const std::stop_token&)>& work) {
  std::stop_source ended;
  const std::stop_callback on_stop(stop, [&ended] { ended.request_stop(); });
  const auto hold = context.held.TryPin(std::move(state), [&ended] { ended.request_stop(); });
  if (hold == nullptr) return TooManyBytes();
  Status status = work(ended.get_token());
  const bool is_let_go = status.code() == StatusCode::kCancelled && !stop.stop_requested();
  return is_let_go ? StateHasNoRoom() : status;
}

Lane& QuickLane(const ServiceContext& context, std::string_view opens, const google::protobuf::Message& request) {
  const std::string map(MapOfResource(opens));
  const bool is_eventual = !map.empty() && AnsweredAnywhere(request);
  const bool loads = is_eventual ? context.registry.MustLoadForEventual(map) : context.registry.MustLoad(map);
  return loads ? context.lanes.loads : context.lanes.quick;
}

Status TooBusy() {
  return ResourceExhausted("too many calls of this kind wait already: try again later").WithReason("TOO_BUSY");
}

namespace {

/// One unary call from its arrival to its answer. Owns itself: lives until gRPC is done with it and no handler can
/// still respond.
class UnaryReactor final : public grpc::ServerUnaryReactor {
 public:
  using Handler = std::function<void(Respond, std::stop_token)>;

  static grpc::ServerUnaryReactor* Start(const ServiceContext& context, const CallMessages& call, Lane& lane,
                                         std::size_t answer_bytes, Handler handler) {
    const auto self = std::make_shared<UnaryReactor>(context, call);
    self->self_ = self;
    if (!self->share_.Resize(answer_bytes)) {
      self->Respond(TooManyBytes());
      return self.get();
    }
    self->task_ = std::make_shared<LaneTask>([self, handler = std::move(handler)] {
      const Status status = RunGuarded([&] {
        handler([self](const Status& answer) { self->Respond(answer); }, self->stop_.get_token());
        return Status::Ok();
      });
      if (!status.ok()) self->Respond(status);
    });
    if (!lane.TryPost(self->task_)) {
      self->task_->GiveUp();
      self->Respond(TooBusy());
    }
    return self.get();
  }

  UnaryReactor(const ServiceContext& context, const CallMessages& call)
      : call_(call), record_(context, call.method), share_(&BudgetHere(*context.options.inflight)) {}

  void OnCancel() override {
    stop_.request_stop();
    if (task_ && task_->GiveUp()) Respond(Cancelled("the client went away, or its deadline has passed"));
  }
  void OnDone() override { const auto last = std::move(self_); }

 private:
  void Respond(const Status& status) {
    if (has_responded_.exchange(true)) return;
    Finish(AnswerOf(status));
  }

  /// Ends the call even if memory runs out.
  grpc::Status AnswerOf(const Status& status) noexcept {
    try {
      const Status answer = status.ok() && !HasRoomForAnswer() ? TooManyBytes() : status;
      TellSafely([&] { record_.End(answer); });
      return ToGrpc(answer);
    } catch (...) {
      return {grpc::StatusCode::RESOURCE_EXHAUSTED, "out of memory"};
    }
  }

  /// The answer is in memory twice, as a message and as bytes, until the client has taken it.
  bool HasRoomForAnswer() {
    if (call_.response == nullptr) return true;
    return share_.Resize(2 * call_.response->ByteSizeLong());
  }

  const CallMessages call_;
  CallRecord record_;
  ByteShare share_;                     // of the answer; the request is counted by CountedService
  std::shared_ptr<UnaryReactor> self_;  // until OnDone
  std::shared_ptr<LaneTask> task_;
  std::stop_source stop_;
  std::atomic<bool> has_responded_ = false;
};

}  // namespace

grpc::ServerUnaryReactor* RunAsync(const ServiceContext& context, const CallMessages& call,
                                   std::function<void(Respond, std::stop_token)> handler) {
  return UnaryReactor::Start(context, call, QuickLane(context, call.opens, *call.request), 0, std::move(handler));
}

grpc::ServerUnaryReactor* RunAsyncIn(Lane& lane, const ServiceContext& context, const CallMessages& call,
                                     std::size_t answer_bytes, std::function<void(Respond, std::stop_token)> handler) {
  return UnaryReactor::Start(context, call, lane, answer_bytes, std::move(handler));
}

grpc::ServerUnaryReactor* Run(const ServiceContext& context, const CallMessages& call,
                              std::function<Status()> handler) {
  return RunAsync(context, call, [handler = std::move(handler)](const Respond& respond, const std::stop_token&) {
    respond(handler());
  });
}

grpc::ServerUnaryReactor* RunBulk(const ServiceContext& context, const CallMessages& call, std::size_t answer_bytes,
                                  std::function<Status(std::stop_token)> handler) {
  return UnaryReactor::Start(
      context, call, context.lanes.bulk, answer_bytes,
      [&answers = context.lanes.answers, handler = std::move(handler)](Respond respond, std::stop_token stop) {
        Status status = RunGuarded([&] { return handler(std::move(stop)); });
        answers.Post([respond = std::move(respond), status = std::move(status)] { respond(status); });
      });
}

}  // namespace dhpmap
