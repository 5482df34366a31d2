// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/media_type.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <string>

#include "server/http/message.h"

namespace dhpmap::gateway {
namespace {

std::string_view Trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::string_view TypeOf(std::string_view text) { return Trimmed(text.substr(0, text.find(';'))); }

template <std::size_t N>
bool IsAnyOf(std::string_view type, const std::string_view (&names)[N]) {
  for (const std::string_view name : names) {
    if (http::EqualsIgnoringCase(type, name)) return true;
  }
  return false;
}

constexpr std::string_view kOneJsonNames[] = {"application/json", "text/json"};
constexpr std::string_view kJsonNames[] = {"application/json",   "text/json",         "application/x-ndjson",
                                           "application/ndjson", "application/jsonl", "application/json-seq"};
constexpr std::string_view kProtobufNames[] = {"application/x-protobuf", "application/protobuf",
                                               "application/vnd.google.protobuf"};
constexpr std::string_view kFileNames[] = {"application/octet-stream", "application/vnd.sqlite3",
                                           "application/x-sqlite3", "application/x-www-form-urlencoded"};
constexpr std::string_view kStreamNames[] = {"application/x-protobuf-stream", "application/x-protobuf-delimited"};

/// Whether a media range such as "text/*" contains the type.
bool IsOneOf(std::string_view range, std::string_view type) {
  if (range == "*/*" || http::EqualsIgnoringCase(range, type)) return true;
  if (!range.ends_with("/*")) return false;
  range.remove_suffix(1);
  return http::EqualsIgnoringCase(range, type.substr(0, range.size()));
}

/// The `q` of a media range, 0 to 1; 1 if missing, 0 if it is not a number.
double QualityOf(std::string_view range) {
  for (std::size_t at = range.find(';'); at != std::string_view::npos; at = range.find(';', at + 1)) {
    const std::string_view parameter = Trimmed(range.substr(at + 1));
    if (parameter.size() < 2 || (parameter[0] != 'q' && parameter[0] != 'Q') || parameter[1] != '=') continue;
    double quality = 0;
    std::from_chars(parameter.data() + 2, parameter.data() + parameter.size(), quality);
    return quality > 0 ? std::min(quality, 1.0) : 0;  // false for NaN
  }
  return 1;
}

}  // namespace

std::optional<BodyFormat> FormatOfContentType(std::string_view content_type) {
  const std::string_view type = TypeOf(content_type);
  if (type.empty() || http::EqualsIgnoringCase(type, "application/x-www-form-urlencoded") ||
      IsAnyOf(type, kJsonNames)) {
    return BodyFormat::kJson;
  }
  if (IsAnyOf(type, kProtobufNames)) return BodyFormat::kProtobuf;
  if (IsAnyOf(type, kStreamNames)) return BodyFormat::kDelimitedProtobuf;
  return std::nullopt;
}

bool IsFileType(std::string_view content_type) {
  const std::string_view type = TypeOf(content_type);
  return type.empty() || IsAnyOf(type, kFileNames);
}

bool IsOneJsonValue(std::string_view content_type) { return IsAnyOf(TypeOf(content_type), kOneJsonNames); }

AnswerFormat FormatOfAccept(std::string_view accept) {
  AnswerFormat best = AnswerFormat::kAny;
  double best_quality = 0;
  while (!accept.empty()) {
    const std::size_t comma = accept.find(',');
    const std::string_view range = accept.substr(0, comma);
    accept.remove_prefix(comma == std::string_view::npos ? accept.size() : comma + 1);
    const std::string_view type = TypeOf(range);
    AnswerFormat format = AnswerFormat::kAny;
    if (IsAnyOf(type, kJsonNames)) format = AnswerFormat::kJson;
    if (IsAnyOf(type, kProtobufNames) || IsAnyOf(type, kStreamNames)) format = AnswerFormat::kProtobuf;
    if (http::EqualsIgnoringCase(type, kEventsType)) format = AnswerFormat::kEvents;
    const double quality = QualityOf(range);
    if (quality <= best_quality) continue;
    best = format;
    best_quality = quality;
  }
  return best;
}

bool IsAccepted(std::string_view accept, std::string_view type) {
  bool is_wish = false;
  while (!accept.empty()) {
    const std::size_t comma = accept.find(',');
    const std::string_view range = accept.substr(0, comma);
    accept.remove_prefix(comma == std::string_view::npos ? accept.size() : comma + 1);
    is_wish = is_wish || TypeOf(range).find('/') != std::string_view::npos;
    if (IsOneOf(TypeOf(range), type) && QualityOf(range) > 0) return true;
  }
  return !is_wish;
}

bool IsAnyFormatAccepted(std::string_view accept) {
  const auto is_accepted = [accept](std::string_view type) { return IsAccepted(accept, type); };
  return std::any_of(std::begin(kJsonNames), std::end(kJsonNames), is_accepted) ||
         std::any_of(std::begin(kProtobufNames), std::end(kProtobufNames), is_accepted) ||
         std::any_of(std::begin(kStreamNames), std::end(kStreamNames), is_accepted) || is_accepted(kEventsType);
}

Status NotAcceptable(std::string_view accept, std::string_view type) {
  return InvalidArgument("the answer comes as " + std::string(type) + ", not as '" + std::string(accept.substr(0, 80)) +
                         "'")
      .WithReason("NOT_ACCEPTABLE");
}

}  // namespace dhpmap::gateway
