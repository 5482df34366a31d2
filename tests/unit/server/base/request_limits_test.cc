// SPDX-License-Identifier: BSD-3-Clause
#include "server/base/request_limits.h"

#include <gtest/gtest.h>

#include <string>

#include "dhpmap/v1/map_service.pb.h"

namespace dhpmap {
namespace {

const google::protobuf::MethodDescriptor& MethodNamed(const std::string& name) {
  return *v1::CreateMapRequest::descriptor()->file()->pool()->FindMethodByName("dhpmap.v1.MapService." + name);
}

TEST(RequestLimits, RequestsWithListsAndStreamsMayReachTheDoorsLimit) {
  constexpr std::size_t kDoor_bytes = 64u << 20;
  EXPECT_EQ(MostRequestBytes(MethodNamed("CreateMap"), kDoor_bytes), kDoor_bytes);
  EXPECT_EQ(MostRequestBytes(MethodNamed("ImportMap"), kDoor_bytes), kDoor_bytes);
  EXPECT_EQ(MostRequestBytes(MethodNamed("VerifyMap"), kDoor_bytes), 1u << 20);
  EXPECT_EQ(MostRequestBytes(MethodNamed("VerifyMap"), 1000), 1000u) << "a smaller limit counts";
}

TEST(RequestLimits, OnlyRequestsThatCanNeverFitAreTooLarge) {
  const ByteBudget budget(1000, 100);
  EXPECT_TRUE(CheckEverFits(1000, budget).ok());
  EXPECT_EQ(CheckEverFits(1001, budget).reason(), Reason("BODY_TOO_LARGE"));
}

TEST(RequestLimits, SmallRequestsAreSmallWhenParsed) {
  const ByteBudget budget(1000, 100);
  EXPECT_TRUE(IsSmallRequest(100, 800, budget));
  EXPECT_FALSE(IsSmallRequest(101, 800, budget));
  EXPECT_FALSE(IsSmallRequest(100, 801, budget));
}

}  // namespace
}  // namespace dhpmap
