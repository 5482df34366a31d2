// SPDX-License-Identifier: BSD-3-Clause
#include "server/json/base64.h"

#include <gtest/gtest.h>

namespace dhpmap::json {
namespace {

TEST(Base64, RoundTripsEveryLength) {
  std::string bytes;
  for (int i = 0; i < 70; ++i) {
    std::string text;
    AppendBase64(bytes, &text);
    EXPECT_EQ(text.size() % 4, 0u);
    EXPECT_EQ(DecodeBase64(text), bytes);
    while (!text.empty() && text.back() == '=') text.pop_back();
    EXPECT_EQ(DecodeBase64(text), bytes) << "without padding";
    bytes += static_cast<char>(i * 37 + 200);
  }
}

TEST(Base64, AcceptsBothAlphabetsOnly) {
  EXPECT_EQ(DecodeBase64("-_-_"), DecodeBase64("+/+/"));
  for (const char* text : {"A", "AAAAA", "AA!A", "AA=A", "====", "A A="}) EXPECT_FALSE(DecodeBase64(text)) << text;
}

}  // namespace
}  // namespace dhpmap::json
