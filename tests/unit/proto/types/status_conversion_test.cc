// SPDX-License-Identifier: BSD-3-Clause
#include "proto/types/status_conversion.h"

#include <gtest/gtest.h>

#include <string>

#include "google/rpc/error_details.pb.h"
#include "proto/types/http_status.h"

namespace dhpmap {
namespace {

TEST(StatusToProto, CarriesReasonAndViolations) {
  const google::rpc::Status proto =
      ToProto(NotFound("no map 'a'").WithReason("MAP_NOT_FOUND").WithViolation("name", "is 'a'"));
  EXPECT_EQ(proto.code(), 5);
  EXPECT_EQ(proto.message(), "no map 'a': name: is 'a'");
  ASSERT_EQ(proto.details_size(), 2);
  google::rpc::ErrorInfo info;
  google::rpc::BadRequest bad;
  ASSERT_TRUE(proto.details(0).UnpackTo(&info) && proto.details(1).UnpackTo(&bad));
  EXPECT_EQ(info.reason(), "MAP_NOT_FOUND");
  EXPECT_EQ(info.domain(), "dhpmap");
  EXPECT_EQ(bad.field_violations(0).field(), "name");
  EXPECT_EQ(bad.field_violations(0).description(), "is 'a'");
  EXPECT_EQ(ToProto(Internal("x")).details_size(), 0);
}

TEST(StatusToProto, ClientsAreNotToldTheCauseOfAnInternalFault) {
  const auto proto = ToProto(Internal("an internal fault").WithCause("cannot open /var/lib/maps.db"));
  EXPECT_EQ(proto.message(), "an internal fault");
  EXPECT_EQ(proto.SerializeAsString().find("maps.db"), std::string::npos);
}

TEST(StatusToProto, CarriesWhatTheReasonMeansAsMetadata) {
  const google::rpc::Status proto =
      ToProto(NotFound("m").WithReason("MERGED_INTO").WithMetadata("merged_into", "maps/m/submaps/3"));
  google::rpc::ErrorInfo info;
  ASSERT_TRUE(proto.details(0).UnpackTo(&info));
  ASSERT_EQ(info.metadata_size(), 1);
  EXPECT_EQ(info.metadata().at("merged_into"), "maps/m/submaps/3");
}

TEST(StatusToProto, WhatIsNotUtf8IsCleaned) {
  const google::rpc::Status proto = ToProto(InvalidArgument("a\xFF").WithViolation("b\xFF", "c\xFF"));
  EXPECT_EQ(proto.message(), "a?: b?: c?");
  const ErrorDetails details = ReadErrorDetails(proto.SerializeAsString());
  ASSERT_EQ(details.violations.size(), 1u);
  EXPECT_EQ(details.violations[0].field, "b?");
  EXPECT_EQ(details.violations[0].description, "c?");
}

TEST(StatusToProto, TheFirstViolationStandsInTheMessage) {
  const auto message = [](const Status& status) { return ToProto(status).message(); };
  EXPECT_EQ(message(InvalidArgument("m").WithViolation("a", "is b").WithViolation("c", "is d").WithViolation("e", "")),
            "m: a: is b, and 2 more");
  EXPECT_EQ(message(InvalidArgument("").WithViolation("a", "is b")), "a: is b");
  EXPECT_EQ(message(InvalidArgument("m")), "m");
  EXPECT_EQ(message(InvalidArgument("a: is b").WithViolation("a", "is b")), "a: is b") << "once";
  EXPECT_EQ(message(InvalidArgument("a: is b").WithViolation("a", "is b").WithViolation("c", "is d")),
            "a: is b, and 1 more");
}

TEST(ReadErrorDetails, ReadsWhatWasWrittenAndIsEmptyForAnythingElse) {
  const Status status =
      InvalidArgument("m").WithReason("BAD_MAP").WithViolation("a", "is b").WithViolation("c", "is d");
  const ErrorDetails details = ReadErrorDetails(ToProto(status).SerializeAsString());
  EXPECT_EQ(details.reason, "BAD_MAP");
  ASSERT_EQ(details.violations.size(), 2u);
  EXPECT_EQ(details.violations[1].field, "c");
  EXPECT_TRUE(ReadErrorDetails("").reason.empty());
  EXPECT_TRUE(ReadErrorDetails("no protobuf at all").violations.empty());
}

TEST(HttpStatusOf, IsThatOfTheReasonWhereItHasOneElseOfTheCode) {
  for (const StatusRow& row : StatusTable()) EXPECT_EQ(HttpStatusOf(row.grpc_code), row.http_status);
  EXPECT_EQ(HttpStatusOf(99), 500);
  EXPECT_EQ(HttpStatusOf(-1), 500);
  EXPECT_EQ(HttpStatusOf(8, Reason("BODY_TOO_LARGE")), 413);
  EXPECT_EQ(HttpStatusOf(8, Reason("TOO_MANY_EDITS")), 429);
  EXPECT_EQ(HttpStatusOf(12, Reason("METHOD_NOT_ALLOWED")), 405);
}

}  // namespace
}  // namespace dhpmap
