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

/// Frames wait for a database that does not answer, so a quota that cannot be looked up keeps no robot out.
Status MayBeUnknown(Status checked) {
  return checked.code() == StatusCode::kUnavailable ? Status::Ok() : std::move(checked);
}

/// Entries of deleted maps that may stay in the file.
constexpr std::size_t kMostGone = 1000;

}  // namespace

MapQuota::MapQuota(auth::Gate& gate, MapRegistry& registry, auth::PassingTime now_s)
    : gate_(gate), registry_(registry), now_s_(std::move(now_s)) {}

Result<std::unique_ptr<MapQuota::Making>> MapQuota::Begin(const Caller& caller) {
  if (caller.principal() == nullptr || gate_.owners() == nullptr) return std::unique_ptr<Making>();
  const std::string& principal = caller.principal()->name;
  DHPMAP_RETURN_IF_ERROR(CheckDisk(principal));
  // The number may include deleted maps, so a small one settles the question without a look at the maps.
  DHPMAP_ASSIGN_OR_RETURN(const std::set<std::uint64_t> made, gate_.owners()->MapsOf(principal));
  std::size_t num_maps = made.size();
  if (!HasRoom(principal, num_maps)) {
    DHPMAP_ASSIGN_OR_RETURN(const std::vector<std::string> maps, MapsOf(principal));
    num_maps = maps.size();
  }
  const MutexLock lock(mutex_);
  int& num_making = num_making_[principal];
  const auto num = static_cast<int>(num_maps) + num_making;
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
  if (!principal.ok()) return MayBeUnknown(principal.status());
  return *principal ? MayBeUnknown(CheckDisk(**principal)) : Status::Ok();
}

bool MapQuota::HasRoom(const std::string& principal, std::size_t num_maps) {
  const MutexLock lock(mutex_);
  const auto making = num_making_.find(principal);
  const int num_making = making != num_making_.end() ? making->second : 0;
  return static_cast<int>(num_maps) + num_making < gate_.limits().maps;
}

void MapQuota::GiveBack(const std::string& principal) {
  const MutexLock lock(mutex_);
  const auto found = num_making_.find(principal);
  if (--found->second == 0) num_making_.erase(found);
}

void MapQuota::Note(const std::string& principal, const MapSummary& map) {
  Status noted = gate_.owners()->Add(map.info.history_id, principal);
  if (const Status kept = ForgetGone(); noted.ok()) noted = kept;
  if (!noted.ok()) LogError("who has made map '" + map.info.name + "' is not kept: " + noted.ToString());
}

Status MapQuota::ForgetGone() {
  auth::MapOwners& owners = *gate_.owners();
  {
    const MutexLock lock(mutex_);
    if (owners.size() <= num_known_ + kMostGone) return Status::Ok();
    num_known_ = owners.size();  // no other thread updates it meanwhile
  }
  std::set<std::uint64_t> there;
  DHPMAP_RETURN_IF_ERROR(ForEachMap([&there](const MapInfo& map) { there.insert(map.history_id); }));
  Status kept = owners.Keep(there);
  const MutexLock lock(mutex_);
  num_known_ = owners.size();
  return kept;
}

Status MapQuota::ForEachMap(const std::function<void(const MapInfo&)>& body) const {
  constexpr std::size_t kMapsALook = 128;
  for (std::string after;;) {
    DHPMAP_ASSIGN_OR_RETURN(const std::vector<MapSummary> maps, registry_.List(after, kMapsALook));
    for (const MapSummary& map : maps) body(map.info);
    if (maps.size() < kMapsALook) return Status::Ok();
    after = maps.back().info.name;
  }
}

Result<std::vector<std::string>> MapQuota::MapsOf(const std::string& principal) const {
  std::vector<std::string> maps;
  DHPMAP_ASSIGN_OR_RETURN(const std::set<std::uint64_t> made, gate_.owners()->MapsOf(principal));
  if (made.empty()) return maps;
  DHPMAP_RETURN_IF_ERROR(ForEachMap([&](const MapInfo& map) {
    if (made.contains(map.history_id)) maps.push_back(map.name);
  }));
  return maps;
}

Status MapQuota::CheckDisk(const std::string& principal) {
  const double now_s = now_s_();
  std::optional<Sum> sum;
  {
    const MutexLock lock(mutex_);
    if (const auto found = sums_.find(principal); found != sums_.end()) sum = found->second;
  }
  if (!sum || now_s - sum->at_s >= kSumStands_s) {
    sum = Sum{.at_s = now_s};
    DHPMAP_ASSIGN_OR_RETURN(const std::vector<std::string> maps, MapsOf(principal));
    for (const std::string& map : maps) {
      if (const auto bytes = registry_.DiskBytes(map); bytes.ok()) sum->bytes += *bytes;  // else just deleted
    }
    const MutexLock lock(mutex_);
    sums_[principal] = *sum;
  }
  if (sum->bytes < gate_.limits().disk_bytes) return Status::Ok();
  return OutOfQuota(principal, "made maps of " + std::to_string(sum->bytes >> 20) + " MiB, as much as one may");
}

}  // namespace dhpmap
