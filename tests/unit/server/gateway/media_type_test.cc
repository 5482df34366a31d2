// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/media_type.h"

#include <gtest/gtest.h>

namespace dhpmap::gateway {
namespace {

TEST(MediaType, KnowsTheTypesOfBodies) {
  EXPECT_EQ(FormatOfContentType(""), BodyFormat::kJson);
  EXPECT_EQ(FormatOfContentType("application/x-www-form-urlencoded"), BodyFormat::kJson);
  EXPECT_EQ(FormatOfContentType("application/json ; charset=utf-8"), BodyFormat::kJson);
  EXPECT_EQ(FormatOfContentType("application/x-protobuf"), BodyFormat::kProtobuf);
  EXPECT_EQ(FormatOfContentType("application/x-protobuf-stream"), BodyFormat::kDelimitedProtobuf);
  EXPECT_FALSE(FormatOfContentType("multipart/form-data; boundary=x"));
}

TEST(MediaType, ChoosesAnAcceptedType) {
  EXPECT_EQ(FormatOfAccept(""), AnswerFormat::kAny);
  EXPECT_EQ(FormatOfAccept("*/*"), AnswerFormat::kAny);
  EXPECT_EQ(FormatOfAccept("text/html,application/xml;q=0.9,*/*;q=0.8"), AnswerFormat::kAny);
  EXPECT_EQ(FormatOfAccept("application/json"), AnswerFormat::kJson);
  EXPECT_EQ(FormatOfAccept("text/event-stream"), AnswerFormat::kEvents);
  EXPECT_EQ(FormatOfAccept("application/json;q=0.5, application/x-protobuf"), AnswerFormat::kProtobuf);
  EXPECT_EQ(FormatOfAccept("application/x-protobuf;q=0, application/x-ndjson;q=0.1"), AnswerFormat::kJson);
  EXPECT_EQ(FormatOfAccept("application/octet-stream"), AnswerFormat::kAny);
}

TEST(MediaType, IgnoresCaseAndSpaces) {
  EXPECT_EQ(FormatOfContentType("  Application/X-NDJSON\t; a=b"), BodyFormat::kJson);
  EXPECT_EQ(FormatOfAccept("APPLICATION/X-PROTOBUF ;Q=0.2"), AnswerFormat::kProtobuf);
  EXPECT_FALSE(FormatOfContentType("application/jsonx"));
  EXPECT_FALSE(FormatOfContentType("application"));
}

TEST(MediaType, PrefersTheFirstOfEqualPreferences) {
  EXPECT_EQ(FormatOfAccept("application/json, application/x-protobuf"), AnswerFormat::kJson);
  EXPECT_EQ(FormatOfAccept("application/x-protobuf, application/json"), AnswerFormat::kProtobuf);
  EXPECT_EQ(FormatOfAccept("*/*, application/json;q=0.9"), AnswerFormat::kAny);
}

TEST(MediaType, IgnoresMalformedPreferences) {
  for (const char* accept : {",,,", ";q=1", "application/json;q=0", "application/json;q=x", "application/json;q=-1",
                             "application/json;q=nan", ";;;q"}) {
    EXPECT_EQ(FormatOfAccept(accept), AnswerFormat::kAny) << accept;
  }
}

TEST(MediaType, IsAcceptedByAMatchingRange) {
  constexpr std::string_view kPly = "application/x-ply";
  for (const char* accept : {"", " ", ",,,", "nonsense", "*/*", "application/*", "Application/X-PLY",
                             "model/gltf-binary, application/x-ply;q=0.1", "model/gltf-binary,*/*;q=0.01"}) {
    EXPECT_TRUE(IsAccepted(accept, kPly)) << accept;
  }
  for (const char* accept : {"model/gltf-binary", "model/*", "application/x-ply;q=0", "application/x-plyx",
                             "application/x-pl", "application/json, text/*"}) {
    EXPECT_FALSE(IsAccepted(accept, kPly)) << accept;
  }
}

TEST(MediaType, SomeClientsAcceptNoneOfOurFormats) {
  for (const char* accept : {"", "*/*", "application/*", "text/*", "text/json", "application/x-ndjson;q=0.1",
                             "application/x-protobuf-stream", "text/event-stream", "text/html,*/*;q=0.8", ",,,"}) {
    EXPECT_TRUE(IsAnyFormatAccepted(accept)) << accept;
  }
  for (const char* accept : {"text/html", "model/gltf-binary", "image/*", "application/json;q=0"}) {
    EXPECT_FALSE(IsAnyFormatAccepted(accept)) << accept;
  }
}

TEST(MediaType, SomeTypesMeanASingleJsonValue) {
  for (const char* type : {"application/json", "Application/JSON; charset=utf-8", "text/json"}) {
    EXPECT_TRUE(IsOneJsonValue(type)) << type;
  }
  for (const char* type : {"", "application/x-ndjson", "application/jsonl", "application/x-www-form-urlencoded",
                           "application/x-protobuf"}) {
    EXPECT_FALSE(IsOneJsonValue(type)) << type;
  }
}

}  // namespace
}  // namespace dhpmap::gateway
