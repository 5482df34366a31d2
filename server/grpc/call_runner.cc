// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/call_runner.h"

#include <atomic>
#include <exception>

#include "server/log/log.h"

namespace dhpmap {
namespace {

bool IsOurFault(StatusCode code) {
  return code == StatusCode::kInternal || code == StatusCode::kUnknown || code == StatusCode::kDataLoss;
}

}  // namespace

void CallRecord::End(const Status& status) const {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  if (context_.observer.on_call) context_.observer.on_call(method_, status.code(), elapsed.count());
  if (IsOurFault(status.code())) LogError(std::string(method_) + " failed: " + status.ToString());
}

Status RunGuarded(const std::function<Status()>& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    return Internal(std::string("unexpected failure: ") + error.what());
  } catch (...) {
    return Internal("unexpected failure");
  }
}

grpc::ServerUnaryReactor* RunAsync(const ServiceContext& context, grpc::CallbackServerContext* call,
                                   std::string_view method, std::function<void(Respond)> handler) {
  struct State {
    CallRecord record;
    grpc::ServerUnaryReactor* reactor;
    std::atomic<bool> has_responded = false;
  };
  auto state = std::make_shared<State>(CallRecord(context, method), call->DefaultReactor());
  const Respond respond = [state](const Status& status) {
    if (state->has_responded.exchange(true)) return;
    state->record.End(status);
    state->reactor->Finish(ToGrpc(status));
  };
  context.pool.Post([respond, handler = std::move(handler)] {
    const Status status = RunGuarded([&] {
      handler(respond);
      return Status::Ok();
    });
    if (!status.ok()) respond(status);
  });
  return state->reactor;
}

grpc::ServerUnaryReactor* Run(const ServiceContext& context, grpc::CallbackServerContext* call, std::string_view method,
                              std::function<Status()> handler) {
  return RunAsync(context, call, method,
                  [handler = std::move(handler)](const Respond& respond) { respond(handler()); });
}

}  // namespace dhpmap
