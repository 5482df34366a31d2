// SPDX-License-Identifier: BSD-3-Clause
// The memory of a message is reserved before its text is parsed.
#include "server/json/message_bytes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "server/base/byte_budget.h"
#include "server/json/reader.h"
#include "tests/unit/server/json/full_message.h"

namespace dhpmap::json {
namespace {

using test::Everything;

constexpr int kTimes = 5000;

/// `item` repeated, separated by commas.
std::string ManyOf(const std::string& item, int times = kTimes) {
  std::string all;
  for (int i = 0; i < times; ++i) all += (i > 0 ? "," : "") + item;
  return all;
}

/// The largest reservation.
std::size_t AskedFor(const std::string& text, Everything& message) {
  std::size_t most_bytes = 0;
  const Status status = Read(text, &message, nullptr, [&](std::size_t num_bytes) {
    EXPECT_GE(num_bytes, most_bytes) << "it grows";
    most_bytes = num_bytes;
    return Status::Ok();
  });
  EXPECT_TRUE(status.ok()) << status.message() << " " << text.substr(0, 60);
  return most_bytes;
}

TEST(MessageBytes, AreAtLeastTheMemoryOfTheMessage) {
  for (const std::string& text :
       {std::string("{}"), "{\"many_child\":[" + ManyOf("{}") + "]}",
        "{\"many_child\":[" + ManyOf(R"({"child":{"text":"a","many_i64":[1,2]}})") + "]}",
        "{\"many_real\":[" + ManyOf("0") + "]}", "{\"many_i64\":[" + ManyOf("\"7\"") + "]}",
        "{\"many_text\":[" + ManyOf("\"\"") + "]}", "{\"many_shade\":[" + ManyOf("1") + "]}",
        "{\"text\":\"" + std::string(kTimes, 'x') + "\"}", "{\"raw\":\"" + std::string(4 * kTimes, 'A') + "\"}",
        "{\"mask\":\"" + ManyOf("A") + "\"}", "{\"times\":[" + ManyOf("\"1970-01-01T00:00:05Z\"") + "]}",
        "{\"value\":[" + ManyOf("1", 500) + "]}"}) {
    Everything message;
    const std::size_t asked_bytes = AskedFor(text, message);
    EXPECT_GE(asked_bytes, message.SpaceUsedLong()) << text.substr(0, 60);
  }
}

TEST(MessageBytes, OfAMapFieldAreThoseOfTwoFields) {
  std::string children;
  for (int i = 0; i < kTimes; ++i) children += (i > 0 ? ",\"" : "\"") + std::to_string(i) + R"(":{})";
  Everything message;
  const std::size_t asked_bytes = AskedFor("{\"children\":{" + children + "}}", message);
  EXPECT_EQ(message.children_size(), kTimes);
  EXPECT_GE(asked_bytes, 2 * kTimes * Everything().SpaceUsedLong());
}

TEST(MessageBytes, AreLittleAboveTheMemoryOfAMessage) {
  Everything message;
  const std::size_t asked_bytes = AskedFor("{\"many_child\":[" + ManyOf(R"({"i32":1})") + "]}", message);
  EXPECT_LE(asked_bytes, message.SpaceUsedLong() * 3 / 2);
}

TEST(MessageBytes, WithoutMemoryReadingStops) {
  constexpr std::size_t kMost_bytes = 200'000;
  for (const std::string& item : {std::string("{}"), std::string(R"({"child":{}})")}) {
    Everything message;
    const Status refused =
        Read("{\"many_child\":[" + ManyOf(item) + "]}", &message, nullptr,
             [](std::size_t num_bytes) { return num_bytes <= kMost_bytes ? Status::Ok() : TooManyBytes(); });
    EXPECT_EQ(refused.reason(), Reason("TOO_MANY_BYTES")) << refused.message();
    EXPECT_LE(message.SpaceUsedLong(), 2 * kMost_bytes);
    EXPECT_LT(message.many_child_size(), kTimes);
  }
}

TEST(MessageBytes, OfAStringWithEscapesIncludeItsCopy) {
  Everything message;
  const std::string letters(100'000, 'x');
  const std::size_t plain_bytes = AskedFor("{\"text\":\"" + letters + "\"}", message);
  const std::size_t escaped_bytes = AskedFor("{\"text\":\"" + letters + "\\n\"}", message);
  EXPECT_GE(plain_bytes, letters.size());
  EXPECT_GE(escaped_bytes, plain_bytes + letters.size());
}

TEST(MessageBytes, OfAnUnknownNameAreNotInTheError) {
  Everything message;
  const Status refused =
      Read("{\"" + std::string(127, 'x') + "\xC3\xA4" + std::string(1 << 20, 'x') + "\":1}", &message);
  EXPECT_EQ(refused.reason(), Reason("BAD_FIELD"));
  EXPECT_LT(refused.message().size(), 1000u);
  EXPECT_NE(refused.message().find(std::string(127, 'x') + "..."), std::string::npos) << "no half of a character";
}

}  // namespace
}  // namespace dhpmap::json
