// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/map_quota.h"

#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "server/log/log.h"

namespace dhpmap {
namespace {

Status OutOfQuota(const std::string& principal, const std::string& has) {
  std::string text = "'";
  text.append(principal).append("' has ").append(has).append(": delete some, or ask for more");
  return ResourceExhausted(std::move(text)).WithReason("OUT_OF_QUOTA");
}

/// Of maps that are gone, whose lines are left in the file.
constexpr std::size_t kMostGone = 1000;

}  // namespace

MapQuota::MapQuota(auth::Gate& gate, MapRegistry& registry, auth::PassingTime now_s)
    : gate_(gate), registry_(registry), now_s_(std::move(now_s)) {}

Result<std::unique_ptr<MapQuota::Making>> MapQuota::Begin(const Caller& caller) {
  if (caller.principal() == nullptr || gate_.owners() == nullptr) return std::unique_ptr<Making>();
  const std::string& principal = caller.principal()->name;
  const std::vector<std::string> maps = MapsOf(principal);
  DHPMAP_RETURN_IF_ERROR(CheckDisk(principal, maps));
  const MutexLock lock(mutex_);
  int& num_making = num_making_[principal];
  const auto num = static_cast<int>(maps.size()) + num_making;
  if (num >= gate_.limits().maps) {
    if (num_making == 0) num_making_.erase(principal);
    return OutOfQuota(principal, "made " + std::to_string(num) + " maps, as many as one may");
  }
  ++num_making;
  return std::make_unique<Making>(*this, principal);
}

Status MapQuota::CheckFeed(const MapInfo& map) {
  if (gate_.owners() == nullptr) return Status::Ok();
  const auto principal = gate_.owners()->OwnerOf(map.history_id);
  return principal ? CheckDisk(*principal, MapsOf(*principal)) : Status::Ok();
}

void MapQuota::GiveBack(const std::string& principal) {
  const MutexLock lock(mutex_);
  const auto found = num_making_.find(principal);
  if (--found->second == 0) num_making_.erase(found);
}

void MapQuota::Note(const std::string& principal, const MapSummary& map) {
  auth::MapOwners& owners = *gate_.owners();
  Status noted = owners.Add(map.info.history_id, principal);
  if (const auto maps = registry_.List(); owners.size() > maps.size() + kMostGone) {
    std::set<std::uint64_t> there;
    for (const MapSummary& one : maps) there.insert(one.info.history_id);
    if (const Status kept = owners.Keep(there); noted.ok()) noted = kept;
  }
  if (!noted.ok()) LogError("who has made map '" + map.info.name + "' is not kept: " + noted.ToString());
}

std::vector<std::string> MapQuota::MapsOf(const std::string& principal) const {
  std::vector<std::string> maps;
  for (const MapSummary& map : registry_.List()) {
    if (gate_.owners()->OwnerOf(map.info.history_id) == principal) maps.push_back(map.info.name);
  }
  return maps;
}

Status MapQuota::CheckDisk(const std::string& principal, const std::vector<std::string>& maps) {
  const double now_s = now_s_();
  std::optional<Sum> sum;
  {
    const MutexLock lock(mutex_);
    if (const auto found = sums_.find(principal); found != sums_.end()) sum = found->second;
  }
  if (!sum || now_s - sum->at_s >= kSumStands_s) {
    sum = Sum{.at_s = now_s};
    for (const std::string& map : maps) {
      if (const auto bytes = registry_.DiskBytes(map); bytes.ok()) sum->bytes += *bytes;  // else it has just gone
    }
    const MutexLock lock(mutex_);
    sums_[principal] = *sum;
  }
  if (sum->bytes < gate_.limits().disk_bytes) return Status::Ok();
  return OutOfQuota(principal, "made maps of " + std::to_string(sum->bytes >> 20) + " MiB, as much as one may");
}

}  // namespace dhpmap
