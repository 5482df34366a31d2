// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/status.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>
#include <unordered_set>

#include "mapping/base/ids.h"
#include "mapping/base/result.h"

namespace dhpmap {
namespace {

TEST(Status, IsOkByDefaultAndCarriesWhatItWasGiven) {
  EXPECT_TRUE(Status().ok());
  EXPECT_TRUE(Status::Ok().ok());
  const Status status = NotFound("no map 'a'").WithReason("MAP_NOT_FOUND").WithViolation("map", "does not exist");
  EXPECT_FALSE(status.ok());
  EXPECT_EQ(status.code(), StatusCode::kNotFound);
  EXPECT_EQ(status.message(), "no map 'a'");
  EXPECT_EQ(status.reason(), Reason("MAP_NOT_FOUND"));
  ASSERT_EQ(status.violations().size(), 1u);
  EXPECT_EQ(status.violations()[0].field, "map");
}

TEST(Status, TextNamesCodeMessageAndEveryViolation) {
  EXPECT_EQ(Status().ToString(), "OK");
  EXPECT_EQ(Internal("boom").ToString(), "INTERNAL: boom");
  Status status = InvalidArgument("bad");
  status.AddViolation("a.b", "is 0");
  status.AddViolation("c", "is missing");
  EXPECT_EQ(status.ToString(), "INVALID_ARGUMENT: bad [a.b: is 0; c: is missing]");
}

TEST(Status, KeepsTheFirstViolationsOfVeryMany) {
  constexpr std::size_t kKept = 64;
  Status status = InvalidArgument("bad");
  for (int i = 0; i < 1000; ++i) status.AddViolation("rows[" + std::to_string(i) + "]", "is bad");
  ASSERT_EQ(status.violations().size(), kKept);
  EXPECT_EQ(status.violations().back().field, "rows[" + std::to_string(kKept - 1) + "]");
}

TEST(Status, EveryCodeHasItsOwnName) {
  std::set<std::string_view> names;
  for (int code = 0; code <= 16; ++code) names.insert(StatusCodeName(static_cast<StatusCode>(code)));
  EXPECT_EQ(names.size(), 17u);
  EXPECT_EQ(StatusCodeName(static_cast<StatusCode>(99)), "UNKNOWN");
}

TEST(Status, FactoriesGiveTheirCode) {
  EXPECT_EQ(InvalidArgument("").code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(NotFound("").code(), StatusCode::kNotFound);
  EXPECT_EQ(AlreadyExists("").code(), StatusCode::kAlreadyExists);
  EXPECT_EQ(FailedPrecondition("").code(), StatusCode::kFailedPrecondition);
  EXPECT_EQ(ResourceExhausted("").code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(OutOfRange("").code(), StatusCode::kOutOfRange);
  EXPECT_EQ(Aborted("").code(), StatusCode::kAborted);
  EXPECT_EQ(Cancelled("").code(), StatusCode::kCancelled);
  EXPECT_EQ(Unavailable("").code(), StatusCode::kUnavailable);
  EXPECT_EQ(DataLoss("").code(), StatusCode::kDataLoss);
  EXPECT_EQ(Internal("").code(), StatusCode::kInternal);
}

Result<int> Half(int value) {
  if (value % 2 != 0) return InvalidArgument(std::to_string(value) + " is odd");
  return value / 2;
}

Result<int> Quarter(int value) {
  DHPMAP_ASSIGN_OR_RETURN(const int half, Half(value));
  DHPMAP_ASSIGN_OR_RETURN(const int quarter, Half(half));
  return quarter;
}

Status CheckEven(int value, bool& got_past) {
  DHPMAP_RETURN_IF_ERROR(Half(value).status());
  got_past = true;
  return Status::Ok();
}

TEST(Result, HoldsAValueOrTheReasonWhyNot) {
  EXPECT_EQ(Half(8).value(), 4);
  EXPECT_TRUE(Half(8).status().ok());
  EXPECT_FALSE(Half(3).ok());
  EXPECT_EQ(Half(3).status().message(), "3 is odd");
}

TEST(Result, MacrosReturnTheFirstError) {
  EXPECT_EQ(*Quarter(8), 2);
  EXPECT_EQ(Quarter(7).status().message(), "7 is odd");
  EXPECT_EQ(Quarter(6).status().message(), "3 is odd");
  bool got_past = false;
  EXPECT_FALSE(CheckEven(1, got_past).ok());
  EXPECT_FALSE(got_past);
  EXPECT_TRUE(CheckEven(2, got_past).ok());
  EXPECT_TRUE(got_past);
}

TEST(Result, MovesOutWhatCannotBeCopied) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(5);
  const std::unique_ptr<int> owned = std::move(result).value();
  EXPECT_EQ(*owned, 5);
}

TEST(StrongId, ComparesCountsAndHashesByValue) {
  SubmapId next(3);
  EXPECT_EQ(next++, SubmapId(3));
  EXPECT_EQ(next, SubmapId(4));
  EXPECT_LT(SubmapId(3), next);
  const std::unordered_set<SubmapId> ids = {SubmapId(1), SubmapId(1), SubmapId(2)};
  EXPECT_EQ(ids.size(), 2u);
}

}  // namespace
}  // namespace dhpmap
