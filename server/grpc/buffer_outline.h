// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/proto_buffer_reader.h>

#include "proto/types/message_outline.h"

namespace dhpmap {

/// MessageLayout::OutlineOf for a gRPC buffer, without copying its bytes.
inline Result<MessageOutline> OutlineOf(const MessageLayout& layout, const grpc::ByteBuffer& bytes) {
  if (!bytes.Valid()) return layout.Malformed();
  grpc::ByteBuffer shared = bytes;  // ByteBufferReader takes no const buffer
  grpc::ProtoBufferReader reader(&shared);
  return layout.OutlineOf(reader);
}

}  // namespace dhpmap
