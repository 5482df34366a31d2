// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "dhpmap/v1/edit_service.grpc.pb.h"
#include "dhpmap/v1/map_service.grpc.pb.h"
#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "dhpmap/v1/query_service.grpc.pb.h"
#include "dhpmap/v1/submap_service.grpc.pb.h"
#include "dhpmap/v1/watch_service.grpc.pb.h"
#include "tests/support/assert_ok.h"
#include "tests/support/eventually.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {

using EditStub = v1::EditService::Stub;
using MapStub = v1::MapService::Stub;
using MappingStub = v1::MappingService::Stub;
using QueryStub = v1::QueryService::Stub;
using SubmapStub = v1::SubmapService::Stub;
using WatchStub = v1::WatchService::Stub;

/// What a call has come to: gRPC's status as it came, and what was answered, nothing unless that is OK.
template <typename Response>
class [[nodiscard]] Answer {
 public:
  Answer(grpc::Status status, Response response) : status_(std::move(status)), response_(std::move(response)) {}

  [[nodiscard]] const grpc::Status& status() const { return status_; }
  [[nodiscard]] bool ok() const { return status_.ok(); }
  [[nodiscard]] grpc::StatusCode code() const { return status_.error_code(); }
  /// See ReasonOf.
  [[nodiscard]] std::string reason() const { return ReasonOf(status_); }

  const Response& operator*() const { return response_; }
  const Response* operator->() const { return &response_; }
  /// The test fails if there is none.
  Response value() && {
    EXPECT_OK(status_);
    return std::move(response_);
  }
  /// Whatever was answered; the status is kept for the caller.
  Response KeepStatus(grpc::Status& kept) && {
    kept = std::move(status_);
    return std::move(response_);
  }

 private:
  grpc::Status status_;
  Response response_;
};

/// A request about a resource, such as "maps/room", and nothing else.
template <typename Request>
Request About(std::string_view resource) {
  Request request;
  const std::string name(resource);
  if constexpr (requires { request.set_parent(name); }) request.set_parent(name);
  else if constexpr (requires { request.set_map(name); }) request.set_map(name);
  else request.set_name(name);
  return request;
}

/// Calls a server's methods, each `&SubmapStub::ListSubmaps` or the like. A call ends when only what hangs would still
/// go on. Thread-safe.
class Client {
 public:
  static constexpr std::chrono::minutes kLongest{10};

  explicit Client(std::shared_ptr<grpc::Channel> channel) : channel_(std::move(channel)) {}

  [[nodiscard]] const std::shared_ptr<grpc::Channel>& channel() const { return channel_; }

  template <typename Stub, typename Request, typename Response>
  using Unary = grpc::Status (Stub::*)(grpc::ClientContext*, const Request&, Response*);
  template <typename Stub, typename Request, typename Response>
  using Streaming = std::unique_ptr<grpc::ClientReader<Response>> (Stub::*)(grpc::ClientContext*, const Request&);

  template <typename Stub, typename Request, typename Response>
  Answer<Response> Call(Unary<Stub, Request, Response> method,
                        const std::type_identity_t<Request>& request = Request()) const {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + kLongest);
    Response response;
    Stub stub(channel_);
    grpc::Status status = (stub.*method)(&context, request, &response);
    return {std::move(status), std::move(response)};
  }
  /// All messages of a stream.
  template <typename Stub, typename Request, typename Response>
  Answer<std::vector<Response>> Call(Streaming<Stub, Request, Response> method,
                                     const std::type_identity_t<Request>& request = Request()) const {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + kLongest);
    std::vector<Response> messages;
    Stub stub(channel_);
    const auto reader = (stub.*method)(&context, request);
    for (Response message; reader->Read(&message);) messages.push_back(std::move(message));
    grpc::Status status = reader->Finish();
    return {std::move(status), std::move(messages)};
  }
  /// About a resource, and nothing else.
  template <typename Stub, typename Request, typename Response>
  Answer<Response> Call(Unary<Stub, Request, Response> method, std::string_view resource) const {
    return Call(method, About<Request>(resource));
  }
  template <typename Stub, typename Request, typename Response>
  Answer<std::vector<Response>> Call(Streaming<Stub, Request, Response> method, std::string_view resource) const {
    return Call(method, About<Request>(resource));
  }

 private:
  std::shared_ptr<grpc::Channel> channel_;
};

}  // namespace dhpmap::testing
