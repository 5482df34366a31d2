// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/message_splitter.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

namespace dhpmap::gateway {
namespace {

TEST(MessageSplitter, SplitsTheSameWhereverThePiecesEnd) {
  const std::string text = " {\"a\":\"}{\\\"\"}\n{}{\"b\":[{},\"\\\\\"]}\r\nnot json\n{\"c\":1";
  const std::vector<std::string> expected = {R"({"a":"}{\""})", "{}", R"({"b":[{},"\\"]})", "not json", R"({"c":1)"};
  for (std::size_t piece = 1; piece <= text.size(); ++piece) {
    MessageSplitter splitter(BodyFormat::kJson, true, 100);
    std::vector<std::string> got;
    for (std::size_t at = 0; at < text.size(); at += piece) {
      splitter.Add(std::string_view(text).substr(at, piece));
      while (auto message = splitter.Next()) got.push_back(*message);
    }
    splitter.AddEnd();
    while (auto message = splitter.Next()) got.push_back(*message);
    EXPECT_EQ(got, expected) << "pieces of " << piece;
  }
}

TEST(MessageSplitter, ATakenLargeMessageIsNotKept) {
  const std::string large = R"({"a":")" + std::string(10'000, 'x') + "\"}";
  MessageSplitter splitter(BodyFormat::kJson, true, 100'000);
  splitter.Add("{}\n" + large + "\n{\"b\":");
  EXPECT_EQ(splitter.Next(), "{}");
  EXPECT_EQ(splitter.Next(), large);
  EXPECT_LE(splitter.buffered_bytes(), 6u) << "what follows";
  EXPECT_FALSE(splitter.has_nothing_left());
  EXPECT_FALSE(splitter.Next());
  splitter.Add("1}");
  EXPECT_EQ(splitter.Next(), R"({"b":1})");
}

TEST(MessageSplitter, AFileIsSplitIntoAtLeastOnePartOfBoundedSize) {
  std::string bytes(700'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i % 251);
  for (const std::size_t piece : {1'000u, 300'000u, 700'000u}) {
    MessageSplitter splitter(BodyFormat::kFile, true, 100'000'000);
    std::string got;
    const auto take = [&] {
      while (auto part = splitter.Next()) {
        EXPECT_GT(part->size(), 0u);
        EXPECT_LE(part->size(), 256u << 10);
        got += *part;
      }
    };
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      splitter.Add(std::string_view(bytes).substr(at, piece));
      take();
    }
    splitter.AddEnd();
    take();
    EXPECT_TRUE(got == bytes) << piece;
  }
  MessageSplitter empty(BodyFormat::kFile, true, 100);
  EXPECT_FALSE(empty.Next());
  empty.AddEnd();
  EXPECT_EQ(empty.Next(), "");
  EXPECT_FALSE(empty.Next());
}

TEST(MessageSplitter, FindsCutOffAndOversizedDelimitedMessages) {
  MessageSplitter cut(BodyFormat::kDelimitedProtobuf, true, 100);
  cut.Add(
      std::string_view("\x02"
                       "ab\x05"
                       "abc"));
  EXPECT_EQ(cut.Next(), "ab");
  EXPECT_FALSE(cut.Next());
  EXPECT_FALSE(cut.is_broken()) << "more may come";
  cut.AddEnd();
  EXPECT_FALSE(cut.Next());
  EXPECT_TRUE(cut.is_broken());

  MessageSplitter large(BodyFormat::kDelimitedProtobuf, true, 100);
  large.Add("\x65");
  EXPECT_FALSE(large.Next());
  EXPECT_TRUE(large.is_too_large());

  MessageSplitter endless(BodyFormat::kDelimitedProtobuf, true, 100);
  endless.Add(std::string(11, '\xFF'));
  EXPECT_FALSE(endless.Next());
  EXPECT_TRUE(endless.is_broken() || endless.is_too_large());
}

TEST(MessageSplitterClock, ScansAnEndlessLineOnlyOnce) {
  // 32 MiB in pieces of 1 KiB. Scanning the line again with each piece would read 512 GiB, which takes a minute.
  const std::string piece(1024, 'x');
  MessageSplitter splitter(BodyFormat::kJson, true, 64u << 20);
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 32 * 1024; ++i) {
    splitter.Add(piece);
    ASSERT_FALSE(splitter.Next());
  }
  splitter.AddEnd();
  EXPECT_EQ(splitter.Next()->size(), 32u << 20);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(MessageSplitter, ReadsABodyThatIsNoStreamAsOneMessage) {
  MessageSplitter splitter(BodyFormat::kJson, false, 100);
  splitter.Add("{} ");
  splitter.Add("{}");
  EXPECT_FALSE(splitter.Next());
  splitter.AddEnd();
  EXPECT_EQ(splitter.Next(), "{} {}");
  EXPECT_FALSE(splitter.Next());
}

TEST(MessageSplitter, RefusesMessagesAboveTheLimit) {
  MessageSplitter splitter(BodyFormat::kJson, true, 8);
  splitter.Add("{\"a\":1}{\"a\":123}");
  EXPECT_EQ(splitter.Next(), "{\"a\":1}");
  EXPECT_FALSE(splitter.Next());
  EXPECT_TRUE(splitter.is_too_large());
}

TEST(MessageSplitter, KnowsWhetherDataIsLeft) {
  MessageSplitter splitter(BodyFormat::kJson, true, 100);
  EXPECT_TRUE(splitter.has_nothing_left());
  splitter.Add("{} \r\n\t");
  EXPECT_FALSE(splitter.has_nothing_left());
  EXPECT_TRUE(splitter.Next());
  EXPECT_TRUE(splitter.has_nothing_left()) << "space does not count";
  splitter.Add(" {");
  EXPECT_FALSE(splitter.has_nothing_left());

  MessageSplitter whole(BodyFormat::kProtobuf, true, 100);
  whole.Add("\n");
  EXPECT_FALSE(whole.has_nothing_left()) << "in protobuf it is a byte like any other";
  whole.AddEnd();
  EXPECT_TRUE(whole.Next());
  EXPECT_TRUE(whole.has_nothing_left());
}

}  // namespace
}  // namespace dhpmap::gateway
