// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/proto_buffer_reader.h>

#include "proto/types/message_outline.h"

namespace dhpmap {

/// As MessageLayout::OutlineOf, of bytes as gRPC hands them over, which are not copied.
inline Result<MessageOutline> OutlineOf(const MessageLayout& layout, const grpc::ByteBuffer& bytes) {
  if (!bytes.Valid()) return layout.Malformed();
  grpc::ByteBuffer shared = bytes;  // the reader is no friend of const
  grpc::ProtoBufferReader reader(&shared);
  return layout.OutlineOf(reader);
}

}  // namespace dhpmap
