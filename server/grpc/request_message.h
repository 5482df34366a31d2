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

/// Makes a message of the bytes, which are gone then, whatever comes of it. `resize` is asked beforehand for what both
/// take, and told afterwards what the message does: TOO_MANY_BYTES if it says no, BODY_TOO_LARGE if that is more than
/// there ever is. What is small is counted by its bytes alone: lists of messages take several times that.
/// INVALID_ARGUMENT, reason MALFORMED_PROTOBUF, if it is none. Unless it is OK the message holds nothing.
Status ParseWithin(const ByteBudget& budget, const MessageLayout& layout, grpc::ByteBuffer& bytes,
                   google::protobuf::Message& message, const std::function<bool(std::size_t)>& resize);

/// A request as gRPC hands it over, which keeps it until the call is over: bytes, until there is room for the message.
/// Its members are mutable since gRPC says const.
template <typename Message>
struct RawRequest {
  mutable std::optional<ByteShare> share;  ///< what it takes; given back last
  mutable grpc::ByteBuffer bytes;
  mutable Message message;
};

}  // namespace dhpmap

namespace grpc {

/// Parses nothing.
template <typename Message>
class SerializationTraits<dhpmap::RawRequest<Message>, void> {
 public:
  static Status Deserialize(ByteBuffer* bytes, dhpmap::RawRequest<Message>* request) {
    request->bytes.Swap(bytes);
    return Status::OK;
  }
};

}  // namespace grpc
