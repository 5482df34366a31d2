// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/request_message.h"

#include <grpcpp/support/proto_buffer_reader.h>

#include <memory>

#include "mapping/base/guarded.h"
#include "server/base/request_limits.h"
#include "server/grpc/buffer_outline.h"

namespace dhpmap {
namespace {

/// Frees the message's memory, which Clear() would keep for reuse.
void Empty(google::protobuf::Message& message) {
  const std::unique_ptr<google::protobuf::Message> empty(message.New());
  message.GetReflection()->Swap(&message, empty.get());
}

Status Parse(const ByteBudget& budget, const MessageLayout& layout, grpc::ByteBuffer& bytes,
             google::protobuf::Message& message, const std::function<bool(std::size_t)>& resize) {
  const std::size_t wire_bytes = bytes.Length();
  DHPMAP_ASSIGN_OR_RETURN(const MessageOutline outline, OutlineOf(layout, bytes));
  const bool is_small = IsSmallRequest(wire_bytes, outline.message_bytes, budget);
  const std::size_t both_bytes = wire_bytes + outline.message_bytes;
  DHPMAP_RETURN_IF_ERROR(CheckEverFits(both_bytes, budget));
  if (!resize(is_small ? wire_bytes : both_bytes)) return TooManyBytes();
  {
    grpc::ProtoBufferReader reader(&bytes);
    if (!message.ParseFromZeroCopyStream(&reader)) return layout.Malformed();
  }
  (void)resize(is_small ? wire_bytes : outline.message_bytes);
  return Status::Ok();
}

}  // namespace

Status ParseWithin(const ByteBudget& budget, const MessageLayout& layout, grpc::ByteBuffer& bytes,
                   google::protobuf::Message& message, const std::function<bool(std::size_t)>& resize) {
  Status status = Guarded<Status>([&] { return Parse(budget, layout, bytes, message, resize); });
  if (!status.ok()) TellSafely([&message] { Empty(message); });
  bytes.Clear();
  return status;
}

}  // namespace dhpmap
