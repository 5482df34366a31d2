// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/status.h>

#include <cstddef>
#include <functional>
#include <optional>

#include "mapping/base/status.h"
#include "proto/types/message_outline.h"
#include "server/base/byte_budget.h"

namespace dhpmap {

/// Parses the bytes into a message and frees them in any case. Calls `resize` first with the memory of both, and
/// afterwards with the memory of the message alone. TOO_MANY_BYTES if `resize` refuses; BODY_TOO_LARGE if the memory
/// exceeds the whole budget. A small message counts by its bytes alone, although lists of messages take several times
/// that. INVALID_ARGUMENT, reason MALFORMED_PROTOBUF, if the bytes are no message. The message is empty unless the
/// result is OK.
Status ParseWithin(const ByteBudget& budget, const MessageLayout& layout, grpc::ByteBuffer& bytes,
                   google::protobuf::Message& message, const std::function<bool(std::size_t)>& resize);

/// A request as gRPC hands it over and keeps it until the call is over: bytes, until the message fits into the budget.
/// Its members are mutable because gRPC passes it as const.
template <typename Message>
struct RawRequest {
  mutable std::optional<ByteShare> share;  ///< its memory; released last
  mutable grpc::ByteBuffer bytes;
  mutable Message message;
};

}  // namespace dhpmap

namespace grpc {

/// Keeps the bytes unparsed.
template <typename Message>
class SerializationTraits<dhpmap::RawRequest<Message>, void> {
 public:
  static Status Deserialize(ByteBuffer* bytes, dhpmap::RawRequest<Message>* request) {
    request->bytes.Swap(bytes);
    return Status::OK;
  }
};

}  // namespace grpc
