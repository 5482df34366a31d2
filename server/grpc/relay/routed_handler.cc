// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/routed_handler.h"

#include <grpcpp/impl/codegen/server_callback_handlers.h>

#include <utility>

#include "proto/types/metadata_keys.h"
#include "server/grpc/relay/relayed_call.h"

namespace dhpmap {

RoutedHandler::RoutedHandler(std::unique_ptr<MethodHandler> handler, Request request, Relay& relay,
                             std::shared_ptr<const RelayedMethod> method)
    : handler_(std::move(handler)), request_(std::move(request)), relay_(relay), method_(std::move(method)) {}

void RoutedHandler::RunHandler(const Parameter& parameter) {
  auto* call = static_cast<grpc::CallbackServerContext*>(parameter.server_context);
  if (!parameter.status.ok()) return handler_->RunHandler(parameter);
  Route route = relay_.RouteOf(*method_, *call, request_.look ? request_.look(parameter) : nullptr);
  if (route.way == Route::Way::kHere) {
    if (const auto owner = route.owner) call->AddInitialMetadata(kOwnerKey, OwnerText(*owner));
    return handler_->RunHandler(parameter);
  }
  std::optional<grpc::ByteBuffer> request;
  if (request_.take) request = request_.take(parameter);
  const auto begin = [&](grpc::CallbackServerContext* context) {
    return RelayedCall::Start(relay_, method_, context, std::move(route), std::move(request));
  };
  // Any shape of call is two streams of messages. The handler is done once it has begun the call.
  grpc::internal::CallbackBidiHandler<grpc::ByteBuffer, grpc::ByteBuffer>(begin).RunHandler(parameter);
}

void* RoutedHandler::Deserialize(grpc_call* call, grpc_byte_buffer* bytes, grpc::Status* status, void** handler_data) {
  return handler_->Deserialize(call, bytes, status, handler_data);
}

}  // namespace dhpmap
