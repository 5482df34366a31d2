// SPDX-License-Identifier: BSD-3-Clause
#include "proto/types/message_outline.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <google/protobuf/wire_format_lite.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "dhpmap/v1/edit_service.pb.h"
#include "dhpmap/v1/map_service.pb.h"
#include "dhpmap/v1/mapping_service.pb.h"
#include "dhpmap/v1/query_service.pb.h"
#include "dhpmap/v1/submap_service.pb.h"
#include "dhpmap/v1/watch_service.pb.h"
#include "server/grpc/request_message.h"

namespace dhpmap {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

grpc::ByteBuffer BytesOfText(const std::string& text) {
  const grpc::Slice slice(text);
  return {&slice, 1};
}

std::string Varint(std::size_t value) {
  std::string bytes;
  for (; value >= 0x80; value >>= 7) bytes += static_cast<char>((value & 0x7f) | 0x80);
  return bytes + static_cast<char>(value);
}
std::string LengthField(int number, const std::string& text) {
  return Varint(static_cast<std::size_t>(number) << 3 | 2) + Varint(text.size()) + text;
}
std::string Repeat(const std::string& what, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += what;
  return all;
}

constexpr int kTimes = 500;

/// Many fields of each kind of the type, all small on the wire.
std::vector<std::string> TinyFields(const Descriptor& type) {
  std::vector<std::string> all{Repeat(std::string("\xf8\x7d\x00", 3), kTimes),
                               Repeat(std::string("\xfa\x7d\x00", 3), kTimes), Repeat("\xfb\x7d\xfc\x7d", kTimes),
                               std::string("\xf8\x7d\x00", 3)};
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    const auto wire_type = google::protobuf::internal::WireFormatLite::WireTypeForFieldType(
        static_cast<google::protobuf::internal::WireFormatLite::FieldType>(field.type()));
    const std::string tag = Varint(static_cast<std::size_t>(field.number()) << 3 | wire_type);
    const std::string value = wire_type == 1 ? std::string(8, '\1') : wire_type == 5 ? std::string(4, '\1') : "\1";
    if (wire_type == 2) {
      all.push_back(Repeat(LengthField(field.number(), ""), kTimes));
      if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
        for (const std::size_t length : {15, 16, 30, 31, 99})
          all.push_back(
              Repeat(LengthField(field.number(), std::string(length, 'x')), field.is_repeated() ? kTimes : 1));
      }
    } else {
      all.push_back(Repeat(tag + value, kTimes));
      if (field.is_repeated()) all.push_back(LengthField(field.number(), Repeat(value, kTimes)));
    }
  }
  return all;
}

/// Those of all messages in one of this type, each within what holds it, so many times.
std::vector<std::string> TinyMessages(const Descriptor& type, int depth, int times) {
  std::vector<std::string> all = TinyFields(type);
  for (int i = 0; depth > 0 && i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    if (field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) continue;
    for (const std::string& inside : TinyMessages(*field.message_type(), depth - 1, times)) {
      all.push_back(Repeat(LengthField(field.number(), inside), times));
    }
  }
  return all;
}

template <typename Request>
void ExpectNeverMoreThanOutlined() {
  const auto expect = [](const std::string& text) {
    Request message;
    const auto outline = LayoutOf<Request>().OutlineOf(text);
    ASSERT_TRUE(message.ParseFromString(text) && outline.ok()) << Request::descriptor()->name();
    ASSERT_GE(outline->message_bytes, message.SpaceUsedLong())
        << Request::descriptor()->name() << " " << ::testing::PrintToString(text.substr(0, 40)) << " of "
        << text.size();
  };
  for (const std::string& text : TinyMessages(*Request::descriptor(), 3, 1)) expect(text);
  for (const std::string& text : TinyMessages(*Request::descriptor(), 2, 3)) expect(text);
}

TEST(MessageOutline, IsNeverBelowTheMemoryOfALargeRequest) {
  ExpectNeverMoreThanOutlined<v1::ApplyEditsRequest>();
  ExpectNeverMoreThanOutlined<v1::CastRaysRequest>();
  ExpectNeverMoreThanOutlined<v1::CheckCollisionsRequest>();
  ExpectNeverMoreThanOutlined<v1::CheckTrajectoryRequest>();
  ExpectNeverMoreThanOutlined<v1::CreateMapRequest>();
  ExpectNeverMoreThanOutlined<v1::ImportMapRequest>();
  ExpectNeverMoreThanOutlined<v1::IntegrateFramesRequest>();
  ExpectNeverMoreThanOutlined<v1::QueryDistancesRequest>();
  ExpectNeverMoreThanOutlined<v1::QueryPointsRequest>();
  ExpectNeverMoreThanOutlined<v1::StreamQueriesRequest>();
  ExpectNeverMoreThanOutlined<v1::UpdateMapRequest>();
}

TEST(MessageOutline, IsLittleAboveTheMemoryOfARealRequest) {
  v1::QueryPointsRequest request;
  request.set_map("maps/room");
  for (int i = 0; i < 10'000; ++i) {
    request.add_points_m()->set_x(i + 1);
    request.add_packed_points_m(0.5f);
  }
  v1::QueryPointsRequest parsed;
  ASSERT_TRUE(parsed.ParseFromString(request.SerializeAsString()));
  const auto outline = LayoutOf<v1::QueryPointsRequest>().OutlineOf(request.SerializeAsString());
  ASSERT_TRUE(outline.ok());
  EXPECT_LE(outline->message_bytes, parsed.SpaceUsedLong() * 3 / 2);
}

/// Reserves memory in a budget of `most` bytes.
class ParseWithinTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kFree_bytes = 1000;

  Status ParsePoints(const std::string& text, std::size_t most_bytes) {
    bytes_ = BytesOfText(text);
    asked_.clear();
    return ParseWithin(budget_, LayoutOf<v1::QueryPointsRequest>(), bytes_, message_, [&](std::size_t num_bytes) {
      asked_.push_back(num_bytes);
      return num_bytes <= most_bytes;
    });
  }
  static std::string TinyPoints(int num) { return Repeat(std::string("\x1a\x00", 2), num); }

  ByteBudget budget_{1 << 20, kFree_bytes};
  grpc::ByteBuffer bytes_;
  v1::QueryPointsRequest message_;
  std::vector<std::size_t> asked_;
};

TEST_F(ParseWithinTest, SmallMessagesAreCountedByTheirBytes) {
  EXPECT_TRUE(ParsePoints(TinyPoints(50), kFree_bytes).ok());
  EXPECT_EQ(asked_, (std::vector<std::size_t>{100, 100}));
  EXPECT_EQ(message_.points_m_size(), 50);
  EXPECT_FALSE(ParsePoints(TinyPoints(500), kFree_bytes).ok()) << "as a message it is not";
}

TEST_F(ParseWithinTest, LargeMessagesAreCountedWithTheirBytesWhileParsed) {
  EXPECT_TRUE(ParsePoints(TinyPoints(5000), 1 << 20).ok());
  ASSERT_EQ(asked_.size(), 2u);
  EXPECT_EQ(asked_[0], asked_[1] + 10'000);
  EXPECT_GE(asked_[1], message_.SpaceUsedLong());
  EXPECT_EQ(bytes_.Length(), 0u);
}

TEST_F(ParseWithinTest, WithoutMemoryNothingIsParsedAndTheBytesAreFreed) {
  const Status refused = ParsePoints(TinyPoints(5000), 100'000);
  EXPECT_EQ(refused.code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(refused.reason(), Reason("TOO_MANY_BYTES"));
  EXPECT_EQ(message_.points_m_size(), 0);
  EXPECT_EQ(bytes_.Length(), 0u);
}

TEST_F(ParseWithinTest, MessagesThatNeverFitAreNotRetryable) {
  const Status refused = ParsePoints(TinyPoints(50'000), 1 << 30);
  EXPECT_EQ(refused.code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(refused.reason(), Reason("BODY_TOO_LARGE"));
  EXPECT_TRUE(asked_.empty());
}

TEST_F(ParseWithinTest, AMessageThatFailsAtItsEndIsLeftEmpty) {
  const std::string no_utf8("\x0a\x01\xff", 3);
  EXPECT_FALSE(ParsePoints(TinyPoints(5000) + no_utf8, 1 << 20).ok());
  EXPECT_LT(message_.SpaceUsedLong(), kFree_bytes);
}

TEST_F(ParseWithinTest, AMalformedMessageNamesItsType) {
  for (const std::string& text : {std::string("\xff\xff", 2), std::string("\x0a\x01\xff", 3)}) {  // no UTF-8
    const Status refused = ParsePoints(text, 1 << 20);
    EXPECT_EQ(refused.code(), StatusCode::kInvalidArgument);
    EXPECT_EQ(refused.reason(), Reason("MALFORMED_PROTOBUF"));
    EXPECT_NE(refused.message().find("QueryPointsRequest"), std::string::npos) << refused.message();
  }
}

}  // namespace
}  // namespace dhpmap
