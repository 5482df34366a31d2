// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/frame_message.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/wire_format_lite.h>
#include <grpcpp/support/proto_buffer_reader.h>

#include <cstdint>
#include <vector>

namespace dhpmap {
namespace {

using google::protobuf::io::CodedInputStream;
using google::protobuf::io::CodedOutputStream;
using google::protobuf::io::StringOutputStream;
using WireFormat = google::protobuf::internal::WireFormatLite;

constexpr std::uint32_t kFrameTag =
    WireFormat::MakeTag(v1::IntegrateFramesRequest::kFrameFieldNumber, WireFormat::WIRETYPE_LENGTH_DELIMITED);

Status MalformedFrameMessage() {
  return InvalidArgument("what was sent is no IntegrateFramesRequest, or has more than 64 KiB beside its frame")
      .WithReason("MALFORMED_PROTOBUF");
}

}  // namespace

Result<v1::IntegrateFramesRequest> ParseFrameMessage(const grpc::ByteBuffer& bytes) {
  grpc::ByteBuffer shared = bytes;
  grpc::ProtoBufferReader reader(&shared);
  v1::IntegrateFramesRequest message;
  if (!message.ParseFromZeroCopyStream(&reader)) return MalformedFrameMessage();
  return message;
}

Result<FrameHead> ParseFrameHead(const grpc::ByteBuffer& bytes) {
  constexpr int kMostHead_bytes = 64 << 10;
  constexpr int kMostFrames = 1000;  // protobuf keeps the last of them
  grpc::ByteBuffer shared = bytes;
  grpc::ProtoBufferReader reader(&shared);
  CodedInputStream input(&reader);
  std::string text;
  int num_frames = 0;
  {
    StringOutputStream stream(&text);
    CodedOutputStream output(&stream);
    int left_bytes = kMostHead_bytes, begin = 0;
    while (const std::uint32_t tag = input.ReadTag()) {
      if (tag == kFrameTag) {
        if (++num_frames > kMostFrames || !WireFormat::SkipField(&input, tag)) return MalformedFrameMessage();
      } else {
        const auto limit = input.PushLimit(left_bytes);  // else a huge field would be copied before it is refused
        if (!WireFormat::SkipField(&input, tag, &output)) return MalformedFrameMessage();
        input.PopLimit(limit);
        left_bytes -= input.CurrentPosition() - begin;
        if (left_bytes < 0) return MalformedFrameMessage();
      }
      begin = input.CurrentPosition();
    }
  }
  FrameHead head{.message = {}, .has_frame = num_frames > 0};
  if (!input.ConsumedEntireMessage() || !head.message.ParseFromString(text)) return MalformedFrameMessage();
  return head;
}

std::string TextOf(const grpc::ByteBuffer& bytes) {
  std::string text;
  std::vector<grpc::Slice> slices;
  if (!bytes.Dump(&slices).ok()) return text;
  text.reserve(bytes.Length());
  for (const grpc::Slice& slice : slices) text.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
  return text;
}

}  // namespace dhpmap
