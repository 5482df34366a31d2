// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/descriptor.h>
#include <grpcpp/impl/service_type.h>
#include <grpcpp/support/server_callback.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "server/grpc/call_runner.h"
#include "server/grpc/caller_budget.h"
#include "server/grpc/door_call.h"
#include "server/grpc/relay/relay.h"
#include "server/grpc/relay/routed_handler.h"
#include "server/grpc/request_message.h"

namespace dhpmap {

/// How the server receives the requests of one method.
struct RequestIntake {
  /// The method of `service` that takes messages of the type `request`.
  RequestIntake(const ServiceContext& of, const google::protobuf::ServiceDescriptor& service,
                const google::protobuf::Descriptor& of_request, const MessageLayout& request_layout);

  /// Parses `message` within the method's size limit and the free budget. Else RESOURCE_EXHAUSTED, reasons
  /// BODY_TOO_LARGE and TOO_MANY_BYTES. The observer receives either as a failed call.
  Status Parse(grpc::ByteBuffer& bytes, google::protobuf::Message& message, std::optional<ByteShare>& share) const;

  /// Identifies and admits the caller: see Enter of door_call.h. The observer receives a refusal as a failed call.
  Status Enter(grpc::CallbackServerContext& call) const;
  /// Enter, Parse, and whether the caller may access what the message names.
  Status Take(grpc::CallbackServerContext& call, grpc::ByteBuffer& bytes, google::protobuf::Message& message,
              std::optional<ByteShare>& share) const;
  /// Writes calls that may change something, and refused calls, to the audit log. Returns `decision`, or an error if an
  /// admitted call could not be logged; see auth::Gate::Audit.
  Status Audit(const Caller& caller, const Status& decision, const google::protobuf::Message* message) const;

  const ServiceContext& context;
  const MessageLayout& layout;
  const auth::CallNeeds* needs = nullptr;
  const google::protobuf::Descriptor* request;  ///< type of its messages
  std::string path;                             ///< "/dhpmap.v1.MapService/GetMap"
  std::string name;                             ///< "MapService/GetMap"
  int index = 0;                                ///< within its service
  std::size_t most_bytes = 0;                   ///< on the wire
  std::size_t most_message_bytes = 0;           ///< including the parsed message
};

/// Base of our services in place of their `CallbackService`, which parses requests on gRPC's own threads without any
/// limit: 64 MiB of bytes can become gigabytes as a message. Here a request arrives as bytes. It is parsed only if the
/// message fits into `limits.inflight_mib`, and counts there until its call ends.
template <typename Service>
class CountedService : public Service::CallbackService {
 protected:
  using Context = grpc::CallbackServerContext;

  explicit CountedService(const ServiceContext& context) : door_context_(context) {}

  /// These handlers receive messages. All handlers but those of TakeStream belong here.
  template <typename... Handlers>
  void Take(Handlers... handlers) {
    (TakeOne(handlers), ...);
  }

  /// A stream of messages that the handler's reactor parses, see ParseWithin.
  template <typename Request, typename Self, typename Response>
  void TakeStream(grpc::ServerReadReactor<grpc::ByteBuffer>* (Self::*handler)(Context*, Response*)) {
    const auto intake = IntakeOf<Request>();
    const auto open = [=, this](Context* call, Response* response) -> grpc::ServerReadReactor<grpc::ByteBuffer>* {
      const Status entered = intake->Enter(*call);
      if (!entered.ok()) return new Refusal<grpc::ServerReadReactor<grpc::ByteBuffer>>(entered);
      const CallerBudget here(CallerOf(*call).budget().get());
      return (static_cast<Self*>(this)->*handler)(call, response);
    };
    Mark<grpc::internal::CallbackClientStreamingHandler<grpc::ByteBuffer, Response>>(*intake, open, {});
  }
  template <typename Request, typename Self, typename Response>
  void TakeStream(grpc::ServerBidiReactor<grpc::ByteBuffer, Response>* (Self::*handler)(Context*)) {
    const auto intake = IntakeOf<Request>();
    const auto open = [=, this](Context* call) -> grpc::ServerBidiReactor<grpc::ByteBuffer, Response>* {
      const Status entered = intake->Enter(*call);
      if (!entered.ok()) return new Refusal<grpc::ServerBidiReactor<grpc::ByteBuffer, Response>>(entered);
      const CallerBudget here(CallerOf(*call).budget().get());
      return (static_cast<Self*>(this)->*handler)(call);
    };
    Mark<grpc::internal::CallbackBidiHandler<grpc::ByteBuffer, Response>>(*intake, open, {});
  }

 private:
  /// Ends a call that has no valid message.
  template <typename Reactor>
  class Refusal final : public Reactor {
   public:
    explicit Refusal(const Status& status) { this->Finish(ToGrpc(status)); }
    void OnDone() override { delete this; }
  };

  template <typename Self, typename Request, typename Response>
  void TakeOne(grpc::ServerUnaryReactor* (Self::*handler)(Context*, const Request*, Response*)) {
    const auto intake = IntakeOf<Request>();
    const auto begin = [=, this](Context* call, const RawRequest<Request>* request,
                                 Response* response) -> grpc::ServerUnaryReactor* {
      const Status taken = intake->Take(*call, request->bytes, request->message, request->share);
      if (!taken.ok()) return new Refusal<grpc::ServerUnaryReactor>(taken);
      const CallerBudget here(CallerOf(*call).budget().get());
      return (static_cast<Self*>(this)->*handler)(call, &request->message, response);
    };
    using Kept = grpc::MessageHolder<RawRequest<Request>, Response>;
    const RoutedHandler::Request kept = {
        [](const RoutedHandler::Parameter& call) { return &static_cast<Kept*>(call.internal_data)->request()->bytes; },
        [](const RoutedHandler::Parameter& call) {
          auto* holder = static_cast<Kept*>(call.internal_data);
          grpc::ByteBuffer bytes;
          bytes.Swap(&holder->request()->bytes);
          holder->Release();
          return bytes;
        }};
    Mark<grpc::internal::CallbackUnaryHandler<RawRequest<Request>, Response>>(*intake, begin, kept);
  }
  template <typename Self, typename Request, typename Response>
  void TakeOne(grpc::ServerWriteReactor<Response>* (Self::*handler)(Context*, const Request*)) {
    const auto intake = IntakeOf<Request>();
    const auto begin = [=, this](Context* call,
                                 const RawRequest<Request>* request) -> grpc::ServerWriteReactor<Response>* {
      const Status taken = intake->Take(*call, request->bytes, request->message, request->share);
      if (!taken.ok()) return new Refusal<grpc::ServerWriteReactor<Response>>(taken);
      const CallerBudget here(CallerOf(*call).budget().get());
      return (static_cast<Self*>(this)->*handler)(call, &request->message);
    };
    using Kept = RawRequest<Request>;
    const RoutedHandler::Request kept = {
        [](const RoutedHandler::Parameter& call) { return &static_cast<Kept*>(call.request)->bytes; },
        [](const RoutedHandler::Parameter& call) {
          auto* request = static_cast<Kept*>(call.request);
          grpc::ByteBuffer bytes;
          bytes.Swap(&request->bytes);
          request->~Kept();  // the call owns the memory
          return bytes;
        }};
    Mark<grpc::internal::CallbackServerStreamingHandler<RawRequest<Request>, Response>>(*intake, begin, kept);
  }

  template <typename Request>
  std::shared_ptr<const RequestIntake> IntakeOf() const {
    const auto* service = Request::descriptor()->file()->pool()->FindServiceByName(Service::service_full_name());
    return std::make_shared<const RequestIntake>(door_context_, *service, *Request::descriptor(), LayoutOf<Request>());
  }
  /// `kept`: how the handler keeps the request, if it has one.
  template <typename Handler, typename Begin>
  void Mark(const RequestIntake& intake, const Begin& begin, const RoutedHandler::Request& kept) {
    std::unique_ptr<grpc::internal::MethodHandler> handler = std::make_unique<Handler>(begin);
    if (Relay* relay = door_context_.relay) {
      auto method = Relay::MethodOf(intake.needs, *intake.request, intake.path, intake.most_bytes);
      if (method != nullptr) {
        handler = std::make_unique<RoutedHandler>(std::move(handler), kept, *relay, std::move(method));
      }
    }
    this->MarkMethodRawCallback(intake.index, handler.release());  // it owns the handler from now on
  }

  const ServiceContext& door_context_;
};

}  // namespace dhpmap
