// SPDX-License-Identifier: BSD-3-Clause
// The bytes of IntegrateFrames before they are parsed: what is said of a message in advance is true of it.
#include <algorithm>

#include "server/grpc/buffer_outline.h"
#include "server/grpc/frame_message.h"
#include "tests/fuzz/fuzz_target.h"

namespace dhpmap {
namespace {

/// In slices of growing size, as they may come from a connection.
grpc::ByteBuffer InSlices(const std::string& text) {
  std::vector<grpc::Slice> slices;
  for (std::size_t at = 0, length = 1; at < text.size(); at += length, ++length) {
    slices.emplace_back(text.data() + at, std::min(length, text.size() - at));
  }
  return {slices.data(), slices.size()};
}

v1::IntegrateFramesRequest RequestSeed() {
  v1::IntegrateFramesRequest request;
  request.set_map("maps/a");
  request.set_sequence(3);
  request.set_session("robot");
  request.set_take_over(true);
  for (const std::uint32_t id : {1u, 2u}) request.mutable_frame()->add_segments()->set_id(id);
  for (int i = 0; i < 16; ++i) request.mutable_frame()->add_map_from_sensor_matrix(i);
  return request;
}

}  // namespace

std::vector<std::string> fuzz::Seeds() {
  v1::IntegrateFramesRequest lidar = RequestSeed(), camera = RequestSeed(), greeting = RequestSeed();
  for (const float value : {1.0f, 0.2f, 0.1f}) lidar.mutable_frame()->mutable_lidar()->add_packed_points_m(value);
  for (const std::uint32_t id : {1u, 200u, 70'000u}) lidar.mutable_frame()->mutable_lidar()->add_segment_ids(id);
  camera.mutable_frame()->mutable_depth_camera()->mutable_depth()->set_data("depth");
  camera.mutable_frame()->mutable_depth_camera()->mutable_camera()->set_width_px(3);
  greeting.clear_frame();
  // An unknown group in a group in a frame, and unknown fields of all kinds beside it.
  const std::string unknown("\x1a\x04\x7b\x7b\x7c\x7c\x78\x01\x7a\x01z\x79\1\2\3\4\5\6\7\1\x7d\1\2\3\4", 25);
  return {lidar.SerializeAsString(), camera.SerializeAsString(), greeting.SerializeAsString(),
          lidar.SerializeAsString() + camera.SerializeAsString(), greeting.SerializeAsString() + unknown};
}

}  // namespace dhpmap

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dhpmap;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const grpc::ByteBuffer bytes = InSlices(text);
  const auto outline = OutlineOf(LayoutOf<v1::IntegrateFramesRequest>(), bytes);
  const auto head = ParseFrameHead(bytes);
  auto message = ParseFrameMessage(bytes);
  fuzz::Require(TextOf(bytes) == text);
  if (head.ok()) fuzz::Require(head->message.SpaceUsedLong() < (8u << 20) && !head->message.has_frame());
  if (!message.ok()) return 0;
  fuzz::Require(outline.ok());
  fuzz::Require(outline->message_bytes >= message->SpaceUsedLong());
  fuzz::Require(outline->num_fields >= static_cast<std::size_t>(message->frame().segments_size()));
  if (!head.ok()) return 0;  // too long
  fuzz::Require(head->has_frame == message->has_frame());
  message->clear_frame();
  fuzz::Require(head->message.SerializeAsString() == message->SerializeAsString());
  return 0;
}
