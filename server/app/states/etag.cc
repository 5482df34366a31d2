// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/states/etag.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <optional>

#include "server/base/fingerprint.h"

namespace dhpmap {
namespace {

std::string Hex16(std::uint64_t number) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(number));
  return text.data();
}

// A submap's etag is HISTORY-sID-rREVISION-eEDITED, opaque to clients.

std::string StartOfEtag(const SubmapInfo& submap, const MapInfo& map) {
  return HistoryText(map.history_id) + "-s" + std::to_string(submap.id.value) + "-r";
}

std::string EndOfEtag(const SubmapInfo& submap) { return "-e" + std::to_string(submap.edited_revision); }

/// The revision in an etag that otherwise equals the submap's.
std::optional<std::int64_t> RevisionOf(std::string_view etag, const SubmapInfo& submap, const MapInfo& map) {
  const std::string start = StartOfEtag(submap, map), end = EndOfEtag(submap);
  if (etag.size() <= start.size() + end.size() || !etag.starts_with(start) || !etag.ends_with(end)) return std::nullopt;
  const std::string_view digits = etag.substr(start.size(), etag.size() - start.size() - end.size());
  std::int64_t revision = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), revision);
  const bool is_ours = error == std::errc() && stop == digits.data() + digits.size() && revision >= 0;
  return is_ours ? std::optional(revision) : std::nullopt;
}

}  // namespace

std::string HistoryText(std::uint64_t history_id) { return Hex16(history_id); }

std::string EtagOf(const SubmapInfo& submap, const MapInfo& map) {
  return StartOfEtag(submap, map) + std::to_string(submap.revision) + EndOfEtag(submap);
}

std::string EtagOf(const MapInfo& map) {
  return HistoryText(map.history_id) + "-m" + Hex16(Fingerprint(map.display_name));
}

Status CheckEtag(std::string_view given, const std::string& present, const std::string& what) {
  if (given.empty() || given == present) return Status::Ok();
  return Aborted(what + " has changed: its etag is now " + present).WithReason("ETAG_MISMATCH");
}

Status CheckEtag(std::string_view given, const SubmapInfo& submap, const MapInfo& map, const LostRevisions& lost) {
  if (given.empty()) return Status::Ok();
  const auto revision = RevisionOf(given, submap, map);
  // A revision above the submap's own was lost, too: the submap was never in that state.
  if (revision && *revision <= submap.revision && !IsLost(lost, *revision)) return Status::Ok();
  return CheckEtag(given, EtagOf(submap, map), "submap " + std::to_string(submap.id.value));
}

Status CheckNotLost(std::int64_t revision, const LostRevisions& lost, const MapInfo& map, const std::string& field) {
  if (!IsLost(lost, revision)) return Status::Ok();
  return OutOfRange("revision " + std::to_string(revision) + " of map '" + map.name +
                    "' was lost with a crash: what was read of it may never have been stored, so read it again")
      .WithReason("HISTORY_LOST")
      .WithMetadata("history_id", HistoryText(map.history_id))
      .WithViolation(field, "is of a state that was lost");
}

Status CheckExpectedRevision(const EditConditions& conditions, const MapInfo& map) {
  DHPMAP_RETURN_IF_ERROR(CheckNotLost(conditions.expected_revision, conditions.lost, map, "expected_revision"));
  if (conditions.expected_revision <= map.revision) return Status::Ok();
  return Aborted("the map is at revision " + std::to_string(map.revision) + ", not yet at " +
                 std::to_string(conditions.expected_revision))
      .WithReason("EDITED_SINCE");
}

Status CheckNotEditedSince(std::int64_t expected_revision, std::int64_t edited_revision, const std::string& what) {
  if (expected_revision <= 0 || edited_revision <= expected_revision) return Status::Ok();
  return Aborted(what + " was edited in revision " + std::to_string(edited_revision) + ", after " +
                 std::to_string(expected_revision))
      .WithReason("EDITED_SINCE");
}

}  // namespace dhpmap
