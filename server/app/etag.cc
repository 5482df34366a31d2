// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/etag.h"

#include <array>
#include <cstdio>

#include "mapping/base/fingerprint.h"

namespace dhpmap {
namespace {

std::string Hex16(std::uint64_t number) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(number));
  return text.data();
}

}  // namespace

std::string HistoryText(std::uint64_t history_id) { return Hex16(history_id); }

std::string EtagOf(const SubmapInfo& submap, const MapInfo& map) {
  return HistoryText(map.history_id) + "-r" + std::to_string(submap.revision);
}

std::string EtagOf(const MapInfo& map) {
  return HistoryText(map.history_id) + "-m" + Hex16(Fingerprint(map.display_name));
}

Status CheckEtag(std::string_view given, const std::string& present, const std::string& what) {
  if (given.empty() || given == present) return Status::Ok();
  return Aborted(what + " has changed: its etag is now " + present).WithReason("ETAG_MISMATCH");
}

}  // namespace dhpmap
