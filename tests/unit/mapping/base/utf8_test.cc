// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/utf8.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

TEST(FindInvalidUtf8, AcceptsEveryLengthAndRefusesTheForbidden) {
  EXPECT_EQ(FindInvalidUtf8("plain ascii, longer than eight"), std::string_view::npos);
  EXPECT_EQ(FindInvalidUtf8("\xC3\xA4 \xE2\x82\xAC \xF0\x9F\x98\x80"), std::string_view::npos);
  EXPECT_EQ(FindInvalidUtf8("abcdefgh\xFF"), 8u);
  EXPECT_EQ(FindInvalidUtf8("\xC0\x80"), 0u) << "overlong";
  EXPECT_EQ(FindInvalidUtf8("\xED\xA0\x80"), 0u) << "surrogate";
  EXPECT_EQ(FindInvalidUtf8("\xF4\x90\x80\x80"), 0u) << "beyond U+10FFFF";
  EXPECT_EQ(FindInvalidUtf8("a\xE2\x82"), 1u) << "cut off";
  EXPECT_EQ(ToValidUtf8("a\xE2\x82z\xFF"), "a??z?");
}

}  // namespace
}  // namespace dhpmap
