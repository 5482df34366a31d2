// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/object_pages.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <system_error>

namespace dhpmap {
namespace {

/// kNum integers separated by dashes; nothing for any other text.
template <std::size_t kNum>
std::optional<std::array<std::uint64_t, kNum>> NumbersIn(std::string_view text) {
  std::array<std::uint64_t, kNum> numbers{};
  for (std::size_t i = 0; i < kNum; ++i) {
    if (i > 0) {
      if (!text.starts_with('-')) return std::nullopt;
      text.remove_prefix(1);
    }
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), numbers[i]);
    if (error != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  return text.empty() ? std::optional(numbers) : std::nullopt;
}

bool IsId(std::uint64_t number) { return number <= UINT32_MAX; }

SubmapId IdOf(std::uint64_t number) { return SubmapId(static_cast<std::uint32_t>(number)); }

}  // namespace

// Encodes the distance by its bits, so that the next page starts exactly after it.
std::string KeyOf(const SubmapMatch& match) {
  return std::to_string(std::bit_cast<std::uint64_t>(match.distance_m)) + '-' +
         std::to_string(match.submap->id().value);
}

Result<std::optional<MatchPlace>> MatchFromPage(const Pager& pager) {
  if (pager.after().empty()) return std::optional<MatchPlace>();
  const auto numbers = NumbersIn<2>(pager.after());
  if (!numbers || !IsId((*numbers)[1])) return BadPageToken();
  const MatchPlace place{std::bit_cast<double>((*numbers)[0]), IdOf((*numbers)[1])};
  if (!std::isfinite(place.distance_m)) return BadPageToken();
  return std::optional(place);
}

std::string KeyOf(const Relation& relation) {
  return std::to_string(relation.subject->id().value) + '-' + std::to_string(relation.object->id().value) + '-' +
         std::to_string(static_cast<int>(relation.kind));
}

Result<std::optional<RelationPlace>> RelationFromPage(const Pager& pager) {
  if (pager.after().empty()) return std::optional<RelationPlace>();
  const auto numbers = NumbersIn<3>(pager.after());
  if (!numbers) return BadPageToken();
  const auto& [subject, object, kind] = *numbers;
  if (!IsId(subject) || !IsId(object) || kind > static_cast<std::uint64_t>(RelationKind::kNextTo)) {
    return BadPageToken();
  }
  return std::optional(RelationPlace{IdOf(subject), IdOf(object), static_cast<RelationKind>(kind)});
}

}  // namespace dhpmap
