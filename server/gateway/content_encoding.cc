// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/content_encoding.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <new>
#include <optional>

#include "server/gateway/media_type.h"
#include "server/http/message.h"

namespace dhpmap::gateway {
namespace {

constexpr std::size_t kMostNamed_bytes = 1024;  // far below gRPC's limit of metadata
constexpr int kGzipWindow = 15 + 16;            // zlib's value for gzip headers and trailers
constexpr int kLevel = 1, kMemory = 8;

Bytef* BytesOf(std::string_view data) { return reinterpret_cast<Bytef*>(const_cast<char*>(data.data())); }

std::string_view WithoutBlanks(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

template <typename Visit>
bool AnyOfList(std::string_view list, Visit&& visit) {
  while (!list.empty()) {
    const std::size_t comma = list.find(',');
    if (visit(WithoutBlanks(list.substr(0, comma)))) return true;
    list.remove_prefix(comma == std::string_view::npos ? list.size() : comma + 1);
  }
  return false;
}

}  // namespace

bool TakesGzip(std::string_view accept_encoding) {
  std::optional<bool> takes_gzip, takes_any;
  AnyOfList(accept_encoding, [&](std::string_view coding) {
    const std::size_t end = coding.find(';');
    const std::string_view name = WithoutBlanks(coding.substr(0, end));
    const std::string_view quality = end == std::string_view::npos ? "" : WithoutBlanks(coding.substr(end + 1));
    const bool is_refused = quality.starts_with("q=0") && quality.find_first_not_of("0.", 2) == std::string_view::npos;
    if (http::EqualsIgnoringCase(name, "gzip")) takes_gzip = !is_refused;
    if (name == "*") takes_any = !is_refused;
    return false;
  });
  return takes_gzip.value_or(takes_any.value_or(false));
}

bool IsWorthGzip(std::string_view content_type) {
  for (const std::string_view type : {"model/gltf-binary", "application/x-ply", "application/x-pcd"}) {
    if (content_type == type) return true;
  }
  return false;
}

std::string EtagOfVariant(std::string_view etag, bool is_gzip) {
  std::string variant(etag);
  if (is_gzip && !etag.empty()) variant += "-gzip";
  return variant;
}

bool IsEtagNamed(std::string_view if_none_match, std::string_view etag) {
  if (etag.empty()) return false;
  return AnyOfList(if_none_match, [etag](std::string_view tag) {
    if (tag == "*") return true;
    if (tag.starts_with("W/")) tag.remove_prefix(2);
    return tag.size() == etag.size() + 2 && tag.front() == '"' && tag.back() == '"' &&
           tag.substr(1, etag.size()) == etag;
  });
}

std::string EtagsNamed(std::string_view if_none_match, bool is_gzip) {
  const std::string suffix = EtagOfVariant("x", is_gzip).substr(1) + '"';
  const std::string other = EtagOfVariant("x", !is_gzip).substr(1) + '"';
  std::string named;
  AnyOfList(if_none_match, [&](std::string_view tag) {
    if (tag.starts_with("W/")) tag.remove_prefix(2);
    const bool is_other = other.size() > suffix.size() && tag.ends_with(other);
    if (tag.size() <= suffix.size() + 1 || tag.front() != '"' || !tag.ends_with(suffix) || is_other) return false;
    tag = tag.substr(1, tag.size() - 1 - suffix.size());
    const bool is_plain = std::all_of(tag.begin(), tag.end(), [](char c) {
      return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    });
    if (is_plain && named.size() + tag.size() < kMostNamed_bytes)
      named += (named.empty() ? "" : ",") + std::string(tag);
    return false;
  });
  return named;
}

struct GzipStream::State {
  z_stream stream{};

  State() {
    if (deflateInit2(&stream, kLevel, Z_DEFLATED, kGzipWindow, kMemory, Z_DEFAULT_STRATEGY) != Z_OK) {
      throw std::bad_alloc();
    }
  }
  ~State() { deflateEnd(&stream); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  std::string Run(std::string_view data, int flush) {
    std::array<char, 16384> buffer;
    std::string out;
    stream.next_in = BytesOf(data);
    stream.avail_in = static_cast<uInt>(data.size());
    do {
      stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
      stream.avail_out = static_cast<uInt>(buffer.size());
      deflate(&stream, flush);
      out.append(buffer.data(), buffer.size() - stream.avail_out);
    } while (stream.avail_out == 0);
    return out;
  }
};

GzipStream::GzipStream() : state_(std::make_unique<State>()) {}
GzipStream::~GzipStream() = default;
GzipStream::GzipStream(GzipStream&&) noexcept = default;
GzipStream& GzipStream::operator=(GzipStream&&) noexcept = default;

std::string GzipStream::Add(std::string_view data) { return state_->Run(data, Z_NO_FLUSH); }
std::string GzipStream::End() { return state_->Run({}, Z_FINISH); }

std::string Gunzip(std::string_view gzipped, std::size_t size) {
  std::string out(size, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, kGzipWindow) != Z_OK) throw std::bad_alloc();
  stream.next_in = BytesOf(gzipped);
  stream.avail_in = static_cast<uInt>(gzipped.size());
  stream.next_out = BytesOf(out);
  stream.avail_out = static_cast<uInt>(out.size());
  inflate(&stream, Z_FINISH);
  out.resize(out.size() - stream.avail_out);
  inflateEnd(&stream);
  return out;
}

}  // namespace dhpmap::gateway
