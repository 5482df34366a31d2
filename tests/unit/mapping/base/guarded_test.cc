// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/guarded.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <system_error>

namespace dhpmap {
namespace {

template <typename Exception>
Status StatusOf(const Exception& thrown) {
  return Guarded<Status>([&]() -> Status { throw thrown; });
}

TEST(Guarded, WhatTheMachineLacksIsNoFaultOfOurs) {
  EXPECT_EQ(StatusOf(std::bad_alloc()).reason(), Reason("OUT_OF_MEMORY"));
  const Status no_thread = StatusOf(std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again)));
  EXPECT_EQ(no_thread.code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(no_thread.reason(), Reason("TOO_BUSY"));
}

TEST(Guarded, WhatNobodyExpectedIsInternal) {
  const Status unexpected = StatusOf(std::runtime_error("/var/lib/maps.db"));
  EXPECT_EQ(unexpected.code(), StatusCode::kInternal);
  EXPECT_EQ(unexpected.message().find("maps.db"), std::string::npos) << "clients see it";
  EXPECT_NE(unexpected.ToString().find("maps.db"), std::string::npos) << "logs tell it";
  EXPECT_EQ(StatusOf(std::system_error(std::make_error_code(std::errc::permission_denied))).code(),
            StatusCode::kInternal);
  EXPECT_EQ(StatusOf(1).code(), StatusCode::kInternal);
}

}  // namespace
}  // namespace dhpmap
