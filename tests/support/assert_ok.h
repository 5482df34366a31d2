// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace dhpmap::testing {

/// Whether a status is OK, ours or gRPC's, or that of a result, an answer or a stream; says what is wrong.
template <typename T>
::testing::AssertionResult IsOk(const T& what) {
  if constexpr (requires { what.status(); }) {
    return IsOk(what.status());
  } else if constexpr (requires { what.status; }) {
    return IsOk(what.status);
  } else if (what.ok()) {
    return ::testing::AssertionSuccess();
  } else if constexpr (requires { what.ToString(); }) {
    return ::testing::AssertionFailure() << what.ToString();
  } else {
    return ::testing::AssertionFailure() << "gRPC status " << what.error_code() << ": " << what.error_message();
  }
}

}  // namespace dhpmap::testing

#define EXPECT_OK(expr) EXPECT_TRUE(::dhpmap::testing::IsOk(expr))
#define ASSERT_OK(expr) ASSERT_TRUE(::dhpmap::testing::IsOk(expr))

/// `ASSERT_OK_AND_ASSIGN(const auto x, Compute())`: x is the value, or the test ends with the error.
#define ASSERT_OK_AND_ASSIGN(lhs, expr) \
  DHPMAP_ASSERT_OK_AND_ASSIGN_(DHPMAP_ASSERT_OK_CONCAT_(dhpmap_result_, __LINE__), lhs, expr)
#define DHPMAP_ASSERT_OK_AND_ASSIGN_(result, lhs, expr) \
  auto result = (expr);                                 \
  ASSERT_OK(result);                                    \
  lhs = std::move(result).value()
#define DHPMAP_ASSERT_OK_CONCAT_(a, b) DHPMAP_ASSERT_OK_CONCAT_INNER_(a, b)
#define DHPMAP_ASSERT_OK_CONCAT_INNER_(a, b) a##b
