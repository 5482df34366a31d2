// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "clients/cpp/calls/owner_routes.h"
#include "clients/cpp/calls/parts.h"
#include "clients/cpp/calls/pauses.h"
#include "dhpmap/options.h"
#include "dhpmap/result.h"

namespace dhpmap::client {

/// Whether a call that reached no server is sent again. kNo for calls without a request_id, which might be made twice.
enum class Again { kYes, kNo };

/// A connection through which all methods are called. Adds the caller's credentials, deadlines, retries and errors.
/// Thread-safe.
class Caller {
 public:
  /// Does not contact the server. If the first call fails to reach it, its error names the address.
  static Result<std::shared_ptr<Caller>> Open(const std::string& address, const ConnectOptions& options);
  /// Uses an existing channel. Pass Again::kNo for a channel within the process: one cannot wait for it.
  static std::shared_ptr<Caller> Over(const std::shared_ptr<grpc::Channel>& channel,
                                      const ConnectOptions& options = {});
  /// Unavailable if no server answers within options.connect_s.
  static Result<std::shared_ptr<Caller>> Connect(const std::string& address, const ConnectOptions& options);

  /// The answer to one request, such as Call(&v1::MapService::Stub::GetMap, request). The deadline covers all attempts;
  /// 0: that of the connection.
  template <typename Stub, typename Request, typename Response>
  Result<Response> Call(grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                        const Request& request, double deadline_s = 0, Again again = Again::kYes) {
    Response response;
    const Status status = Attempt(
        [&](Stubs& stubs, grpc::ClientContext* context) {
          return (stubs.template of<Stub>().*method)(context, request, &response);
        },
        MapOfRequest(request), deadline_s, again);
    if (!status.ok()) return status;
    return response;
  }

  /// The answer to one request, in parts. The deadline covers all parts; 0: none. Never retried.
  template <typename Stub, typename Request, typename Response>
  std::unique_ptr<Parts<Response>> Read(
      std::unique_ptr<grpc::ClientReader<Response>> (Stub::*method)(grpc::ClientContext*, const Request&),
      const Request& request, double deadline_s = 0) {
    return std::make_unique<Parts<Response>>(
        address_,
        [&](grpc::ClientContext& context) {
          Introduce(context);
          if (deadline_s > 0) context.set_deadline(GrpcTime(Clock::now() + Seconds(deadline_s)));
        },
        [&](grpc::ClientContext* context) { return (stub<Stub>().*method)(context, request); });
  }

  template <typename Stub>
  Stub& stub() {
    return first_->of<Stub>();
  }
  /// For a stream about maps/...: the server that owns the map, if it is known and connects soon, else the first
  /// server. Pass the stream's metadata to Heard.
  std::shared_ptr<Stubs> NearestTo(const std::string& map) const;
  void Heard(const std::string& map, const grpc::ClientContext& context, const grpc::Status& status) const;
  /// Adds the caller's credentials to a call.
  void Introduce(grpc::ClientContext& context) const;
  /// Waits until there is a connection or until `end`. Returns whether there is one. gRPC looks after an idle channel
  /// only every five seconds, so a caller that lost its connection waits here instead of sleeping.
  [[nodiscard]] bool AwaitConnection(Clock::time_point end) const;
  /// Waits until `end` while a lost connection is restored.
  void Pause(Clock::time_point end) const;
  /// The result of a stream that has ended.
  [[nodiscard]] Status StatusOf(const grpc::Status& status) const;
  [[nodiscard]] double DeadlineOr(double deadline_s) const { return deadline_s > 0 ? deadline_s : options_.deadline_s; }
  [[nodiscard]] const std::string& author() const { return options_.author; }

 private:
  static Result<std::shared_ptr<Caller>> Make(const std::string& address, const ConnectOptions& options,
                                              const std::string& told_address);
  Caller(std::string told_address, ConnectOptions options, std::string token,
         const std::shared_ptr<grpc::Channel>& channel, OwnerRoutes::Dial dial);
  Status Attempt(const std::function<grpc::Status(Stubs&, grpc::ClientContext*)>& call, const std::string& map,
                 double deadline_s, Again again) const;

  const std::string address_;  // for error messages; empty: not named
  const ConnectOptions options_;
  const std::string token_;
  const std::shared_ptr<grpc::Channel> channel_;
  const std::shared_ptr<Stubs> first_;  // of the server that was given
  mutable OwnerRoutes routes_;
};

/// A UUID by which the server recognises a repeated edit.
std::string NewRequestId();

}  // namespace dhpmap::client
