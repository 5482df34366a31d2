// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/kept_clear.h"

#include <algorithm>
#include <utility>

namespace dhpmap {
namespace {

constexpr std::size_t kMostNameBytes = 63;

bool IsName(std::string_view name) {
  const auto is_alphanumeric = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
  return !name.empty() && name.size() <= kMostNameBytes && is_alphanumeric(name.front()) &&
         std::all_of(name.begin(), name.end(),
                     [&](char c) { return is_alphanumeric(c) || c == '.' || c == '_' || c == '-'; });
}

/// Keeps squares of distances finite.
constexpr double kMost_m = 1e9;

bool IsWithinReach(const Eigen::Vector3d& p_m) { return (p_m.array().abs() <= kMost_m).all(); }

bool IsUsable(const Region& region) {
  if (const auto* box = std::get_if<Eigen::AlignedBox3d>(&region)) {
    return IsWithinReach(box->min()) && IsWithinReach(box->max()) && !box->isEmpty();
  }
  const auto& sphere = std::get<BoundingSphere>(region);
  return IsWithinReach(sphere.center_m) && sphere.radius_m > 0 && sphere.radius_m <= kMost_m;
}

bool RegionComesBefore(const KeptClearRegion& region, std::string_view name) { return region.name < name; }

}  // namespace

Result<KeptClear> KeptClear::Create(std::vector<KeptClearRegion> regions) {
  KeptClear kept_clear;
  for (KeptClearRegion& region : regions) {
    const Status added = kept_clear.Add(std::move(region));
    if (!added.ok()) return DataLoss("a region that is kept clear makes no sense: " + added.message());
  }
  return kept_clear;
}

Status KeptClear::Add(KeptClearRegion region) {
  Status bad = InvalidArgument("the region cannot be kept clear").WithReason("BAD_EDIT");
  if (!IsName(region.name))
    bad.AddViolation("name", "'" + region.name + "' is not of the form [a-z0-9][a-z0-9._-]{0,62}");
  if (!IsUsable(region.region)) bad.AddViolation("region", "is empty, or beyond 1e9 m");
  if (!bad.violations().empty()) return bad;
  const auto at = std::lower_bound(list_.begin(), list_.end(), region.name, RegionComesBefore);
  if (at != list_.end() && at->name == region.name) {
    return AlreadyExists("a region '" + region.name + "' is kept clear already").WithReason("IGNORED_REGION_EXISTS");
  }
  if (list_.size() >= kMost) {
    return ResourceExhausted("as many as " + std::to_string(kMost) + " regions of the map are kept clear already")
        .WithReason("TOO_MANY_IGNORED_REGIONS");
  }
  list_.insert(at, std::move(region));
  return Status::Ok();
}

bool KeptClear::Lift(std::string_view name) {
  const KeptClearRegion* found = Find(name);
  if (found != nullptr) list_.erase(list_.begin() + (found - list_.data()));
  return found != nullptr;
}

const KeptClearRegion* KeptClear::Find(std::string_view name) const {
  const auto at = std::lower_bound(list_.begin(), list_.end(), name, RegionComesBefore);
  return at != list_.end() && at->name == name ? &*at : nullptr;
}

}  // namespace dhpmap
