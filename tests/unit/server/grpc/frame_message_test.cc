// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/frame_message.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "server/grpc/buffer_outline.h"

namespace dhpmap {
namespace {

/// In slices of so many bytes, as from a connection.
grpc::ByteBuffer FrameBytesOf(const std::string& text, std::size_t slice_bytes = 7) {
  std::vector<grpc::Slice> slices;
  for (std::size_t at = 0; at < text.size(); at += slice_bytes) slices.emplace_back(text.substr(at, slice_bytes));
  return {slices.data(), slices.size()};
}

v1::IntegrateFramesRequest FrameRequestOf(int num_segments) {
  v1::IntegrateFramesRequest request;
  request.set_map("maps/room");
  request.set_sequence(7);
  request.set_session("robot");
  v1::Frame& frame = *request.mutable_frame();
  frame.set_stamp_ns(5);
  frame.mutable_depth_camera()->mutable_depth()->set_data(std::string(1000, 'd'));
  for (int i = 1; i <= num_segments; ++i) frame.add_segments()->set_id(static_cast<std::uint32_t>(i));
  return request;
}

Result<MessageOutline> FrameOutlineOf(const grpc::ByteBuffer& bytes) {
  return OutlineOf(LayoutOf<v1::IntegrateFramesRequest>(), bytes);
}

TEST(FrameMessage, IsParsedWhateverItsSlices) {
  const std::string sent = FrameRequestOf(3).SerializeAsString();
  for (const std::size_t slice_bytes : {1u, 7u, 4096u}) {
    const grpc::ByteBuffer bytes = FrameBytesOf(sent, slice_bytes);
    EXPECT_EQ(TextOf(bytes), sent);
    const auto message = ParseFrameMessage(bytes);
    ASSERT_TRUE(message.ok()) << message.status().ToString();
    EXPECT_EQ(message->SerializeAsString(), sent);
    EXPECT_EQ(TextOf(bytes), sent) << "the bytes stay";
  }
}

TEST(FrameMessage, HasAHeadWithoutTheFrame) {
  v1::IntegrateFramesRequest request = FrameRequestOf(3);
  const auto head = ParseFrameHead(FrameBytesOf(request.SerializeAsString()));
  const auto outline = FrameOutlineOf(FrameBytesOf(request.SerializeAsString()));
  ASSERT_TRUE(head.ok() && outline.ok());
  request.clear_frame();
  EXPECT_TRUE(head->has_frame);
  EXPECT_EQ(head->message.SerializeAsString(), request.SerializeAsString());
  const auto without = FrameOutlineOf(FrameBytesOf(request.SerializeAsString()));
  ASSERT_TRUE(without.ok());
  EXPECT_FALSE(ParseFrameHead(FrameBytesOf(request.SerializeAsString()))->has_frame);
  EXPECT_EQ(without->num_fields, 2u) << "the map and the session; a number takes nothing";
}

TEST(FrameMessage, HasAtMostAsManySegmentsAsCountedFields) {
  for (const int num_segments : {0, 1, 10'000}) {
    const v1::IntegrateFramesRequest request = FrameRequestOf(num_segments);
    const auto outline = FrameOutlineOf(FrameBytesOf(request.SerializeAsString(), 4096));
    ASSERT_TRUE(outline.ok());
    EXPECT_GE(outline->num_fields, static_cast<std::size_t>(num_segments));
    EXPECT_LE(outline->num_fields, static_cast<std::size_t>(num_segments) + 10);
    EXPECT_GE(outline->message_bytes, static_cast<std::size_t>(num_segments) * sizeof(v1::Segment));
  }
}

TEST(FrameMessage, TwoFramesAreMergedLikeProtobufDoes) {
  v1::IntegrateFramesRequest first, second;
  first.mutable_frame()->add_segments()->set_id(1);
  second.mutable_frame()->add_segments()->set_id(2);
  const grpc::ByteBuffer bytes = FrameBytesOf(first.SerializeAsString() + second.SerializeAsString());
  const auto message = ParseFrameMessage(bytes);
  const auto outline = FrameOutlineOf(bytes);
  ASSERT_TRUE(message.ok() && outline.ok());
  EXPECT_EQ(message->frame().segments_size(), 2);
  EXPECT_GE(outline->num_fields, 4u);
}

TEST(FrameMessage, OfNoBytesIsEmpty) {
  const grpc::ByteBuffer none = FrameBytesOf("");
  const auto message = ParseFrameMessage(none);
  ASSERT_TRUE(message.ok());
  EXPECT_EQ(message->ByteSizeLong(), 0u);
  ASSERT_TRUE(FrameOutlineOf(none).ok());
  EXPECT_FALSE(ParseFrameHead(none)->has_frame);
}

/// `text` as a field with a length.
std::string TextField(int number, const std::string& text) {
  std::string field(1, static_cast<char>(number << 3 | 2));
  for (std::size_t length = text.size(); true; length >>= 7) {
    const bool is_last = length < 0x80;
    field += static_cast<char>((length & 0x7f) | (is_last ? 0 : 0x80));
    if (is_last) return field + text;
  }
}

/// Small on the wire and large in memory, by what is known and by what is not, at the top and further down.
TEST(FrameMessage, NeverTakesMoreMemoryThanItsOutline) {
  constexpr int kMany = 20'000;
  const auto many = [](const std::string& what) {
    std::string all;
    for (int i = 0; i < kMany; ++i) all += what;
    return all;
  };
  const std::string unknown_texts = many(std::string("\x7a\x00", 2)), unknown_groups = many("\x7b\x7c");
  const std::string unknown_numbers = many(std::string("\x78\x00", 2)), rows = many(std::string("\x32\x00", 2));
  const std::string packed = TextField(2, std::string(kMany, '\1')), unpacked = many("\x10\x01");
  for (const std::string& inside : {unknown_texts, unknown_groups, unknown_numbers, packed, unpacked}) {
    const std::string lidar = TextField(3, TextField(5, inside)),
                      camera = TextField(3, TextField(5, TextField(4, inside)));
    const std::string row = TextField(3, TextField(6, inside)),
                      image = TextField(3, TextField(4, TextField(2, inside)));
    for (const std::string& text : {lidar, camera, row, image, TextField(3, inside), TextField(3, rows)}) {
      const grpc::ByteBuffer bytes = FrameBytesOf(text, 4096);
      const auto outline = FrameOutlineOf(bytes);
      const auto message = ParseFrameMessage(bytes);
      ASSERT_TRUE(outline.ok() && message.ok()) << ::testing::PrintToString(text.substr(0, 20));
      EXPECT_GE(outline->message_bytes, message->SpaceUsedLong()) << ::testing::PrintToString(text.substr(0, 20));
    }
  }
}

TEST(FrameMessage, ThatIsNestedTooDeeplyIsMalformed) {
  for (const int depth : {50, 99, 100, 101, 1000, 1'000'000}) {
    const std::string text =
        std::string(static_cast<std::size_t>(depth), '\x7b') + std::string(static_cast<std::size_t>(depth), '\x7c');
    const grpc::ByteBuffer bytes = FrameBytesOf(text, 4096);
    EXPECT_EQ(FrameOutlineOf(bytes).ok(), ParseFrameMessage(bytes).ok()) << depth;
    EXPECT_EQ(FrameOutlineOf(bytes).ok(), depth <= 100) << depth;
  }
  EXPECT_FALSE(FrameOutlineOf(FrameBytesOf("\x7b\x7b\x7c\x74")).ok()) << "ends another group than it began";
}

TEST(FrameMessage, WithTooMuchBesideItsFrameIsRefusedUnread) {
  constexpr std::size_t kFits = (64u << 10) - 4, kTooLong = 64u << 10;
  const std::string frame = TextField(3, "");
  for (const int number : {4, 15}) {  // the session, and an unknown field
    EXPECT_TRUE(ParseFrameHead(FrameBytesOf(frame + TextField(number, std::string(kFits, 's')))).ok());
    const auto refused = ParseFrameHead(FrameBytesOf(TextField(number, std::string(kTooLong, 's')) + frame));
    EXPECT_FALSE(refused.ok());
    EXPECT_EQ(refused.status().reason(), Reason("MALFORMED_PROTOBUF"));
  }
  std::string many_frames;
  for (int i = 0; i < 100'000; ++i) many_frames += frame;
  EXPECT_FALSE(ParseFrameHead(FrameBytesOf(many_frames, 4096)).ok());
}

/// The outline accepts what the parser accepts; it does not check strings.
TEST(FrameMessage, ThatIsTruncatedIsMalformed) {
  const std::string sent = FrameRequestOf(2).SerializeAsString();
  for (std::size_t length = 0; length < sent.size(); ++length) {
    const grpc::ByteBuffer bytes = FrameBytesOf(sent.substr(0, length));
    const bool is_message = ParseFrameMessage(bytes).ok();
    const auto outline = FrameOutlineOf(bytes);
    EXPECT_TRUE(outline.ok() || !is_message) << length;
    EXPECT_EQ(ParseFrameHead(bytes).ok(), outline.ok()) << length;
    if (!outline.ok()) {
      EXPECT_EQ(outline.status().reason(), Reason("MALFORMED_PROTOBUF")) << length;
    }
  }
}

TEST(FrameMessage, ThatIsInvalidIsMalformed) {
  const std::string no_tag("\0", 1), group_without_end("\x0b\x08\x01", 3), end_alone("\x0c", 1);
  const std::string cut_frame("\x1a\x05\x08", 3), no_utf8("\x0a\x01\xff", 3), huge("\x1a\xff\xff\xff\xff\x0f", 6);
  for (const std::string& text : {no_tag, group_without_end, end_alone, cut_frame, no_utf8, huge}) {
    const auto message = ParseFrameMessage(FrameBytesOf(text));
    ASSERT_FALSE(message.ok()) << ::testing::PrintToString(text);
    EXPECT_EQ(message.status().code(), StatusCode::kInvalidArgument);
    EXPECT_EQ(message.status().reason(), Reason("MALFORMED_PROTOBUF"));
  }
  for (const std::string& text : {no_tag, group_without_end, end_alone, cut_frame, huge}) {
    EXPECT_FALSE(FrameOutlineOf(FrameBytesOf(text)).ok()) << ::testing::PrintToString(text);
    EXPECT_FALSE(ParseFrameHead(FrameBytesOf(text)).ok()) << ::testing::PrintToString(text);
  }
}

}  // namespace
}  // namespace dhpmap
