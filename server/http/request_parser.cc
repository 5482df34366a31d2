// SPDX-License-Identifier: BSD-3-Clause
#include "server/http/request_parser.h"

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/parser.hpp>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string>

namespace dhpmap::http {
namespace {

namespace beast = boost::beast;
using beast::error_code;
using Parser = beast::http::request_parser<beast::http::buffer_body>;

/// Characters of a method (RFC 9110, 5.6.2).
bool IsTokenChar(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
         std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
}

/// Whether the line that ends at `newline` continues the one before (RFC 9112, 5.2): proxies disagree on such fields.
bool IsFolded(std::string_view head, std::size_t newline) {
  const std::size_t before = newline == 0 ? std::string_view::npos : head.rfind('\n', newline - 1);
  if (before == std::string_view::npos) return false;
  return head[before + 1] == ' ' || head[before + 1] == '\t';
}

/// Beast 1.74 asserts, wrongly, that a last chunk that is also the first is not split at this point.
bool IsShortLastChunk(std::string_view framing) {
  return framing.starts_with("0\r\n") && framing.size() < std::string_view("0\r\n\r\n").size();
}

ReadOutcome OutcomeOfParsing(const error_code& error) {
  if (!error) return ReadOutcome::kOk;
  return error == beast::http::error::header_limit ? ReadOutcome::kTooLarge : ReadOutcome::kMalformed;
}

/// Beast accepts repeated lengths that agree, in one field or several (RFC 9112, 6.3); we accept only one.
bool HasOneLength(const Parser::value_type& message) {
  if (message.count(beast::http::field::content_length) > 1) return false;
  const auto length = message[beast::http::field::content_length];
  return std::all_of(length.begin(), length.end(), [](char c) { return c >= '0' && c <= '9'; });
}

HeadResult MakeHead(const Parser& parser, const error_code& error) {
  HeadResult result;
  result.outcome = OutcomeOfParsing(error);
  if (error) {
    result.problem = error.message();
    return result;
  }
  const auto& message = parser.get();
  // The parser treats an unknown coding as no body, and the body as the next request.
  const auto codings = message.equal_range(beast::http::field::transfer_encoding);
  for (auto coding = codings.first; coding != codings.second; ++coding) {
    if (message.version() >= 11 && std::next(codings.first) == codings.second &&
        EqualsIgnoringCase(std::string_view(coding->value().data(), coding->value().size()), "chunked")) {
      continue;
    }
    result.outcome = ReadOutcome::kUnknownCoding;
    return result;
  }
  if (!HasOneLength(message)) {
    result.outcome = ReadOutcome::kMalformed;
    result.problem = "its Content-Length is not one number";
    return result;
  }
  result.head.method = std::string(message.method_string());
  result.head.target = std::string(message.target());
  for (const auto& field : message) {
    result.head.headers.emplace_back(std::string(field.name_string()), std::string(field.value()));
  }
  if (const auto length = parser.content_length()) result.head.content_length = *length;
  result.is_http_1_1 = message.version() >= 11;
  result.keep_alive = parser.keep_alive();
  result.has_body = !parser.is_done();
  return result;
}

}  // namespace

struct RequestParser::Impl {
  Impl() {
    parser.header_limit(kMaxHead_bytes);
    parser.body_limit(std::numeric_limits<std::uint64_t>::max());  // the exchange has the limit; boost::none does not
                                                                   // work in 1.74
  }

  /// Returns the end of the head; 0 if it is incomplete, or if `outcome` reports an error.
  std::size_t FindHead(std::string_view bytes, ReadOutcome* outcome);
  HeadResult ParseHead(std::string_view bytes);

  Parser parser;
  std::size_t num_scanned = 0;  // of the head
  bool is_in_framing = false;   // within the framing of the body: more bytes are needed
};

// Beast's own search depends on the pieces: it may miss the end of a head that it has begun to read.
std::size_t RequestParser::Impl::FindHead(std::string_view bytes, ReadOutcome* outcome) {
  const std::string_view head = bytes.substr(0, kMaxHead_bytes);
  if (num_scanned == 0 && !head.empty() && !IsTokenChar(head[0])) *outcome = ReadOutcome::kMalformed;  // such as TLS
  while (*outcome == ReadOutcome::kOk) {
    const std::size_t newline = head.find('\n', num_scanned);
    num_scanned = newline == std::string_view::npos ? head.size() : newline + 1;
    if (newline == std::string_view::npos) break;
    if (newline < 1 || head[newline - 1] != '\r' || IsFolded(head, newline)) *outcome = ReadOutcome::kMalformed;
    else if (head.substr(0, newline + 1).ends_with("\r\n\r\n")) return newline + 1;
  }
  if (*outcome == ReadOutcome::kOk && head.size() == kMaxHead_bytes) *outcome = ReadOutcome::kTooLarge;
  return 0;
}

HeadResult RequestParser::Impl::ParseHead(std::string_view bytes) {
  error_code error;
  while (!error && !parser.is_header_done()) {
    bytes.remove_prefix(parser.put(boost::asio::const_buffer(bytes.data(), bytes.size()), error));
  }
  return MakeHead(parser, error);  // the head is complete, so a need for more bytes is an error
}

RequestParser::RequestParser() : impl_(std::make_unique<Impl>()) {}
RequestParser::~RequestParser() = default;
RequestParser::RequestParser(RequestParser&&) noexcept = default;
RequestParser& RequestParser::operator=(RequestParser&&) noexcept = default;

RequestParser::HeadStep RequestParser::AddHead(std::string_view bytes) {
  HeadStep step;
  ReadOutcome outcome = ReadOutcome::kOk;
  const std::size_t size = impl_->FindHead(bytes, &outcome);
  step.is_complete = size > 0 || outcome != ReadOutcome::kOk;
  if (!step.is_complete) return step;
  step.num_used = size;
  if (outcome == ReadOutcome::kOk) {
    step.head = impl_->ParseHead(bytes.substr(0, size));
  } else {
    step.head.outcome = outcome;
    step.head.problem = "a request begins with its method, and lines end with CR LF and begin with no blank";
  }
  return step;
}

RequestParser::BodyStep RequestParser::AddBody(std::string_view bytes, std::span<char> out) {
  Parser& parser = impl_->parser;
  auto& body = parser.get().body();
  body.data = out.data();
  body.size = out.size();
  body.more = true;
  BodyStep step;
  while (!step.is_complete() && step.num_used < bytes.size()) {
    const std::string_view rest = bytes.substr(step.num_used);
    if (impl_->is_in_framing && IsShortLastChunk(rest)) break;
    error_code error;
    step.num_used += parser.put(boost::asio::const_buffer(rest.data(), rest.size()), error);
    step.num_written = out.size() - body.size;
    impl_->is_in_framing = error == beast::http::error::need_more;
    if (impl_->is_in_framing) {
      if (bytes.size() - step.num_used > kMaxHead_bytes) step.outcome = ReadOutcome::kTooLarge;
      break;
    }
    if (error != beast::http::error::need_buffer) step.outcome = OutcomeOfParsing(error);  // else `out` is full
    step.is_end = step.outcome == ReadOutcome::kOk && parser.is_done();
  }
  return step;
}

}  // namespace dhpmap::http
