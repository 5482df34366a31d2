// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <string>

#include "dhpmap/v1/mapping_service.pb.h"
#include "mapping/base/result.h"

namespace dhpmap {

// An IntegrateFramesRequest as bytes, so that whoever parses it knows before what it will take (MessageLayout), and is
// none of gRPC's own threads. What is no such message is INVALID_ARGUMENT, reason MALFORMED_PROTOBUF.

/// The whole message.
Result<v1::IntegrateFramesRequest> ParseFrameMessage(const grpc::ByteBuffer& bytes);

/// A message without its frame.
struct FrameHead {
  v1::IntegrateFramesRequest message;
  bool has_frame = false;
};
/// In next to no time and memory, whatever the message is: INVALID_ARGUMENT if all but its frame is more than 64 KiB.
Result<FrameHead> ParseFrameHead(const grpc::ByteBuffer& bytes);

/// The bytes in one piece.
std::string TextOf(const grpc::ByteBuffer& bytes);

}  // namespace dhpmap
