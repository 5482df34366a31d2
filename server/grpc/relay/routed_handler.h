// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/impl/rpc_service_method.h>
#include <grpcpp/support/byte_buffer.h>

#include <functional>
#include <memory>
#include <optional>

#include "server/grpc/relay/relay.h"

namespace dhpmap {

/// What comes before a method's own handler in a fleet: a call that is about another server's map, or of which that is
/// not known, becomes a RelayedCall, in bytes; any other is the handler's as ever.
class RoutedHandler final : public grpc::internal::MethodHandler {
 public:
  using Parameter = HandlerParameter;
  /// How the handler keeps a call's one request, see OneRequest.
  struct Request {
    /// Its bytes, which stay.
    std::function<const grpc::ByteBuffer*(const Parameter&)> look;
    /// Its bytes, and frees what the handler has made for the call: it will not run.
    std::function<grpc::ByteBuffer(const Parameter&)> take;
  };

  /// `request` is empty if the client streams.
  RoutedHandler(std::unique_ptr<MethodHandler> handler, Request request, Relay& relay,
                std::shared_ptr<const RelayedMethod> method);

  void RunHandler(const Parameter& parameter) override;
  void* Deserialize(grpc_call* call, grpc_byte_buffer* bytes, grpc::Status* status, void** handler_data) override;

 private:
  const std::unique_ptr<MethodHandler> handler_;
  const Request request_;
  Relay& relay_;
  const std::shared_ptr<const RelayedMethod> method_;
};

}  // namespace dhpmap
