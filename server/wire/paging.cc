// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/paging.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <utility>

#include "server/base/fingerprint.h"

namespace dhpmap {
namespace {

// A token is HISTORY.REVISION.FINGERPRINT.AFTER, with hexadecimal numbers: opaque to clients.

std::string Hex(std::uint64_t number) {
  std::array<char, 16> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number, 16).ptr};
}

/// Removes a number and the dot after it from the text.
template <typename Number>
bool TakeHex(std::string_view& text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, 16);
  if (error != std::errc() || end == text.data() + text.size() || *end != '.') return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()) + 1);
  return true;
}

std::uint64_t FingerprintOf(const google::protobuf::Message& request) {
  return Fingerprint(request.GetDescriptor()->full_name() + '\n' + request.SerializeAsString());
}

Status HistoryLost() {
  return Status(StatusCode::kOutOfRange,
                "the page token is of a state of the map that was lost with a crash, or is another map's of the same "
                "name: list again from the beginning")
      .WithReason("HISTORY_LOST");
}

}  // namespace

Status BadPageToken() {
  Status bad = InvalidArgument("this is no page token of this list").WithReason("BAD_PAGE_TOKEN");
  bad.AddViolation("page_token", "must be next_page_token of an answer to the same request");
  return bad;
}

std::int64_t RevisionOfPageToken(std::string_view token) {
  std::uint64_t history_id = 0;
  std::int64_t revision = 0;
  return TakeHex(token, history_id) && TakeHex(token, revision) ? revision : 0;
}

Result<Pager> Pager::Begin(int page_size, const std::string& token, const google::protobuf::Message& bound,
                           const PageMark& now, const LostRevisions& lost, PageSizes sizes) {
  if (page_size < 0) {
    Status bad = InvalidArgument("the page size is negative").WithReason("BAD_PAGE_SIZE");
    bad.AddViolation("page_size", "must be 0 (as many as fit) or more");
    return bad;
  }
  Pager pager;
  pager.max_items_ = page_size == 0 ? sizes.by_default : std::min(page_size, sizes.at_most);
  pager.request_fingerprint_ = FingerprintOf(bound);
  pager.mark_ = now;
  if (token.empty()) return pager;
  std::string_view text = token;
  std::uint64_t fingerprint = 0;
  PageMark& mark = pager.mark_;
  if (!TakeHex(text, mark.history_id) || !TakeHex(text, mark.revision) || !TakeHex(text, fingerprint) || text.empty() ||
      fingerprint != pager.request_fingerprint_) {
    return BadPageToken();
  }
  if (mark.history_id != now.history_id || mark.revision > now.revision || IsLost(lost, mark.revision)) {
    return HistoryLost();
  }
  mark.after = text;
  return pager;
}

Result<std::optional<SubmapId>> SubmapIdFromPage(const Pager& pager) {
  const std::string& text = pager.after();
  if (text.empty()) return std::optional<SubmapId>();
  std::uint32_t id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
  if (error != std::errc() || end != text.data() + text.size()) return BadPageToken();
  return std::optional(SubmapId(id));
}

Result<std::optional<std::int64_t>> RevisionFromPage(const Pager& pager) {
  const std::string& text = pager.after();
  if (text.empty()) return std::optional<std::int64_t>();
  std::int64_t revision = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), revision);
  if (error != std::errc() || end != text.data() + text.size()) return BadPageToken();
  return std::optional(revision);
}

bool Pager::Takes(const google::protobuf::Message& item, std::string key) {
  if (is_full_) return false;
  const std::size_t bytes = item.ByteSizeLong();
  is_full_ = num_items_ == max_items_ || (num_items_ > 0 && num_bytes_ + bytes > kMaxBytes);
  if (is_full_) return false;
  ++num_items_;
  num_bytes_ += bytes;
  mark_.after = std::move(key);
  return true;
}

void Pager::EndBehind(std::string key) {
  is_full_ = true;
  mark_.after = std::move(key);
}

std::string Pager::NextToken() const {
  if (!is_full_) return {};
  return Hex(mark_.history_id) + '.' + Hex(static_cast<std::uint64_t>(mark_.revision)) + '.' +
         Hex(request_fingerprint_) + '.' + mark_.after;
}

}  // namespace dhpmap
