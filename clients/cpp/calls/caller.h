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

/// A call that met no server is sent again, unless it would be done twice: it carries no request_id.
enum class Again { kYes, kNo };

/// A connection, and the only caller of methods: who calls, deadlines, repetitions, errors. Thread-safe.
class Caller {
 public:
  /// Without a look at the server, which the first call meets or not: who asks says where that was.
  static Result<std::shared_ptr<Caller>> Open(const std::string& address, const ConnectOptions& options);
  /// Over a channel that is there. One that stays within the process cannot be waited for: Again::kNo.
  static std::shared_ptr<Caller> Over(const std::shared_ptr<grpc::Channel>& channel,
                                      const ConnectOptions& options = {});
  /// Unavailable if no server answers within options.connect_s.
  static Result<std::shared_ptr<Caller>> Connect(const std::string& address, const ConnectOptions& options);

  /// The answer to one request, such as Call(&v1::MapService::Stub::GetMap, request). All attempts together end by the
  /// deadline; 0: that of the connection.
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

  /// The answer to one request, part by part, the last by the deadline; 0: without one. Not sent again.
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
  /// Of the server that owns maps/..., if that is known and connected or is soon, else of the first one. For a stream
  /// about the map, whose metadata are to be told to Heard.
  std::shared_ptr<Stubs> NearestTo(const std::string& map) const;
  void Heard(const std::string& map, const grpc::ClientContext& context, const grpc::Status& status) const;
  /// What each call says of who calls.
  void Introduce(grpc::ClientContext& context) const;
  /// Until there is a connection, or `end` has come; whether there is one. gRPC looks after a channel that nobody waits
  /// for every five seconds only: so who has lost a connection waits here, not asleep.
  [[nodiscard]] bool AwaitConnection(Clock::time_point end) const;
  /// Until `end`, while a lost connection comes back.
  void Pause(Clock::time_point end) const;
  /// What a stream that has ended came to.
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

  const std::string address_;  // as it is told; empty: it is not
  const ConnectOptions options_;
  const std::string token_;
  const std::shared_ptr<grpc::Channel> channel_;
  const std::shared_ptr<Stubs> first_;  // of the server that was given
  mutable OwnerRoutes routes_;
};

/// A UUID, by which the server knows an edit that is sent again.
std::string NewRequestId();

}  // namespace dhpmap::client
