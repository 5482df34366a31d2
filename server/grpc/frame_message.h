// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <string>

#include "dhpmap/v1/mapping_service.pb.h"
#include "mapping/base/result.h"

namespace dhpmap {

// Reads an IntegrateFramesRequest from its bytes, outside gRPC's own threads and after MessageLayout has computed its
// memory. Bytes that are no such message give INVALID_ARGUMENT, reason MALFORMED_PROTOBUF.

/// The whole message.
Result<v1::IntegrateFramesRequest> ParseFrameMessage(const grpc::ByteBuffer& bytes);

/// A message without its frame.
struct FrameHead {
  v1::IntegrateFramesRequest message;
  bool has_frame = false;
};
/// Quick and with little memory for every input: INVALID_ARGUMENT if all but the frame exceeds 64 KiB.
Result<FrameHead> ParseFrameHead(const grpc::ByteBuffer& bytes);

/// The bytes as one string.
std::string TextOf(const grpc::ByteBuffer& bytes);

}  // namespace dhpmap
