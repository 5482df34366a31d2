// SPDX-License-Identifier: BSD-3-Clause
#include "server/http/request_parser.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace dhpmap::http {
namespace {

struct Parsed {
  HeadResult head;
  ReadOutcome body_outcome = ReadOutcome::kOk;
  std::string body;
  bool has_ended = false;
  std::string rest;  ///< not used
};

/// The first request of `bytes`, which come so many at a time; the body goes out so many at a time.
Parsed ParsedIn(const std::string& bytes, std::size_t piece_bytes, std::size_t out_bytes = 1000) {
  RequestParser parser;
  Parsed parsed;
  std::string unread;
  std::size_t at = 0;
  const auto more = [&] {
    if (at == bytes.size()) return false;
    unread += bytes.substr(at, piece_bytes);
    at = std::min(at + piece_bytes, bytes.size());
    return true;
  };
  while (true) {
    RequestParser::HeadStep step = parser.AddHead(unread);
    unread.erase(0, step.num_used);
    if (step.is_complete) {
      parsed.head = std::move(step.head);
      break;
    }
    if (!more()) {
      parsed.head.outcome = ReadOutcome::kClosed;
      return parsed;
    }
  }
  std::string out(out_bytes, '\0');
  bool goes_on = parsed.head.outcome == ReadOutcome::kOk && parsed.head.has_body;
  while (goes_on) {
    const RequestParser::BodyStep step = parser.AddBody(unread, out);
    unread.erase(0, step.num_used);
    parsed.body += out.substr(0, step.num_written);
    parsed.body_outcome = step.outcome;
    parsed.has_ended = step.is_end;
    goes_on = step.outcome == ReadOutcome::kOk && !step.is_end && (step.is_complete() || more());
  }
  parsed.rest = unread + bytes.substr(at);
  return parsed;
}

const std::string kChunked =
    "POST /a?b HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: Chunked\r\n\r\n5;x=\"y\"\r\nhello\r\n1\r\n!\r\n0\r\nT: "
    "t\r\n\r\n";
const std::string kSized = "PUT /a HTTP/1.0\r\nContent-Length: 6\r\nConnection: keep-alive\r\n\r\nhello!";
constexpr std::array<std::size_t, 5> kPieces = {1, 2, 3, 7, 1000};

TEST(RequestParser, ParsesTheSameRequestFromAnyPieces) {
  for (const std::size_t piece : kPieces) {
    for (const std::size_t out : {1u, 2u, 1000u}) {
      const Parsed chunked = ParsedIn(kChunked + "GET / HTTP/1.1\r\n", piece, out);
      ASSERT_EQ(chunked.head.outcome, ReadOutcome::kOk) << piece;
      EXPECT_EQ(chunked.head.head.method, "POST");
      EXPECT_EQ(chunked.head.head.target, "/a?b");
      EXPECT_EQ(FindHeader(chunked.head.head.headers, "host"), "x");
      EXPECT_FALSE(chunked.head.head.content_length);
      EXPECT_EQ(chunked.body, "hello!") << piece << " " << out;
      EXPECT_TRUE(chunked.has_ended);
      EXPECT_EQ(chunked.rest, "GET / HTTP/1.1\r\n") << "the next request's";
      const Parsed sized = ParsedIn(kSized + "x", piece, out);
      EXPECT_EQ(sized.head.head.content_length, 6u);
      EXPECT_FALSE(sized.head.is_http_1_1);
      EXPECT_TRUE(sized.head.keep_alive);
      EXPECT_EQ(sized.body, "hello!") << piece << " " << out;
      EXPECT_TRUE(sized.has_ended);
      EXPECT_EQ(sized.rest, "x");
    }
  }
}

TEST(RequestParser, AChunkedBodyMayBeEmptyAndSplitAnywhere) {
  const std::string head = "PUT /a HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n";
  for (const char* body : {"0\r\n\r\n", "0\r\nT: t\r\n\r\n", "00\r\n\r\n", "0;a=b\r\n\r\n"}) {
    for (std::size_t piece = 1; piece <= head.size() + 9; ++piece) {
      const Parsed parsed = ParsedIn(head + body + "next", piece);
      EXPECT_EQ(parsed.body_outcome, ReadOutcome::kOk) << piece;
      EXPECT_TRUE(parsed.has_ended) << piece;
      EXPECT_EQ(parsed.body, "");
      EXPECT_EQ(parsed.rest, "next") << piece;
    }
  }
}

TEST(RequestParser, ATruncatedRequestIsNotAnError) {
  for (const std::string& whole : {kChunked, kSized}) {
    for (std::size_t length = 0; length < whole.size(); ++length) {
      const Parsed parsed = ParsedIn(whole.substr(0, length), 5);
      EXPECT_TRUE(parsed.head.outcome == ReadOutcome::kOk || parsed.head.outcome == ReadOutcome::kClosed) << length;
      EXPECT_EQ(parsed.body_outcome, ReadOutcome::kOk) << length;
      EXPECT_FALSE(parsed.has_ended) << length;
    }
  }
}

TEST(RequestParser, TheSizeOfAHeadIsLimited) {
  for (const std::size_t piece : {1000u, 1u << 20}) {
    const auto head = [](std::size_t size) { return "GET / HTTP/1.1\r\nX: " + std::string(size, 'x') + "\r\n\r\n"; };
    EXPECT_EQ(ParsedIn(head(30'000), piece).head.outcome, ReadOutcome::kOk);
    EXPECT_EQ(ParsedIn(head(40'000), piece).head.outcome, ReadOutcome::kTooLarge);
    EXPECT_EQ(ParsedIn("GET /" + std::string(40'000, 'x'), piece).head.outcome, ReadOutcome::kTooLarge);
  }
}

TEST(RequestParser, DataBetweenPartsOfABodyIsLimited) {
  const std::string endless = "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n1;" + std::string(100'000, 'x');
  EXPECT_NE(ParsedIn(endless, 1000).body_outcome, ReadOutcome::kOk);
}

TEST(RequestParser, RefusesMalformedRequests) {
  const std::pair<const char*, ReadOutcome> cases[] = {
      {"GARBAGE\r\n\r\n", ReadOutcome::kMalformed},
      {"GET / HTTP/9.9\r\n\r\n", ReadOutcome::kMalformed},
      {"GET / HTTP/1.1\r\nno colon\r\n\r\n", ReadOutcome::kMalformed},
      {"GET / HTTP/1.1\r\nContent-Length: x\r\n\r\n", ReadOutcome::kMalformed},
      {"GET / HTTP/1.1\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n", ReadOutcome::kMalformed},
      {"GET / HTTP/1.1\r\nContent-Length: 1\r\nA: b\r\nContent-Length: 1\r\n\r\nx", ReadOutcome::kMalformed},
      {"GET / HTTP/1.1\r\nContent-Length: 1, 1\r\n\r\nx", ReadOutcome::kMalformed},
      {"GET / HTTP/1.1\r\nContent-Length: 1\r\nTransfer-Encoding: chunked\r\n\r\n", ReadOutcome::kMalformed},
      {"GET / HTTP/1.1\r\nA: b\r\n c\r\n\r\n", ReadOutcome::kMalformed},
      {"GET / HTTP/1.1\r\nA: b\r\n\tc\r\n\r\n", ReadOutcome::kMalformed},
      {"GET / HTTP/1.1\r\n A: b\r\n\r\n", ReadOutcome::kMalformed},
      {"GET / HTTP/1.1\r\nA: b\r\n \r\n\r\n", ReadOutcome::kMalformed},
      {"GET / HTTP/1.1\nA: b\r\n\r\n", ReadOutcome::kMalformed},
      {"GET / HTTP/1.1\r\nTransfer-Encoding: gzip\r\n\r\n", ReadOutcome::kUnknownCoding},
      {"GET / HTTP/1.1\r\nTransfer-Encoding: gzip, chunked\r\n\r\n", ReadOutcome::kUnknownCoding},
      {"GET / HTTP/1.0\r\nTransfer-Encoding: chunked\r\n\r\n", ReadOutcome::kUnknownCoding},
  };
  for (const auto& [bytes, outcome] : cases) {
    for (const std::size_t piece : kPieces) EXPECT_EQ(ParsedIn(bytes, piece).head.outcome, outcome) << bytes;
  }
  const std::string bad = "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n{}\r\n";
  for (const std::size_t piece : kPieces) {
    EXPECT_EQ(ParsedIn(bad, piece).body_outcome, ReadOutcome::kMalformed) << piece;
  }
}

}  // namespace
}  // namespace dhpmap::http
