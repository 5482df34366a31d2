// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/server_context.h>
#include <grpcpp/support/server_callback.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "mapping/base/result.h"
#include "server/app/map_registry.h"
#include "server/grpc/grpc_server.h"
#include "server/grpc/handler_pool.h"
#include "server/grpc/status_conversion.h"

namespace dhpmap {

/// What all services share.
struct ServiceContext {
  MapRegistry& registry;
  HandlerPool& pool;
  const GrpcOptions& options;
  const GrpcObserver& observer;
};

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

/// Calls work() and turns whatever it throws into INTERNAL: the one outer catch of every handler.
Status RunGuarded(const std::function<Status()>& work);

/// Answers a unary call. From any thread; the first call counts.
using Respond = std::function<void(const Status&)>;

/// Runs a unary handler on the pool; it responds itself, at once or later from another thread. What it throws before
/// that is answered as INTERNAL.
grpc::ServerUnaryReactor* RunAsync(const ServiceContext& context, grpc::CallbackServerContext* call,
                                   std::string_view method, std::function<void(Respond)> handler);

/// Runs a unary handler on the pool and responds with what it returns.
grpc::ServerUnaryReactor* Run(const ServiceContext& context, grpc::CallbackServerContext* call, std::string_view method,
                              std::function<Status()> handler);

/// Streams messages to a client. Deletes itself when the call is over.
template <typename Response>
class ChunkStream final : public grpc::ServerWriteReactor<Response> {
 public:
  /// Fills the next message; false: there is none. Must be quick: runs on gRPC's threads.
  using Next = std::function<bool(Response&)>;

  /// `prepare` runs on the pool and may take long.
  static ChunkStream* Start(const ServiceContext& context, std::string_view method,
                            std::function<Result<Next>()> prepare) {
    auto* stream = new ChunkStream(context, method);
    context.pool.Post([stream, prepare = std::move(prepare)] {
      const Status status = RunGuarded([&] {
        DHPMAP_ASSIGN_OR_RETURN(stream->next_, prepare());
        return Status::Ok();
      });
      if (status.ok()) stream->WriteNext();
      else stream->End(status);
    });
    return stream;
  }

  void OnWriteDone(bool ok) override {
    if (ok) WriteNext();
    else End(Cancelled("the client went away"));
  }
  void OnDone() override { delete this; }

 private:
  ChunkStream(const ServiceContext& context, std::string_view method) : record_(context, method) {}

  void WriteNext() {
    bool has_next = false;
    response_.Clear();
    const Status status = RunGuarded([&] {
      has_next = next_(response_);
      return Status::Ok();
    });
    if (status.ok() && has_next) this->StartWrite(&response_);
    else End(status);
  }

  void End(const Status& status) {
    record_.End(status);
    this->Finish(ToGrpc(status));
  }

  CallRecord record_;
  Next next_;
  Response response_;
};

}  // namespace dhpmap
