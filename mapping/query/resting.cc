// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/resting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace dhpmap {
namespace {

constexpr double kStrayShare = 0.0025;   // of a surface, below an object: outliers, not its foot
constexpr std::size_t kLeastStray = 4;   // in triangles
constexpr double kAside_vox = 3;         // surfaces end up to a voxel apart, and have a hole where they touch
constexpr double kAbove_vox = 0.5;       // a surface may be above the thing that it holds
constexpr double kTouch_vox = 2;         // below the foot
constexpr double kNear_vox = 1;          // hanging things have more distance
constexpr double kFeet_m = 0.5;          // length of a chair's legs
constexpr double kLeastUp = 0.70710678;  // cosine of 45 degrees
constexpr double kLeastHeld = 0.05;      // of the columns: the floor below a large thing is unobserved
constexpr double kLeastAtStuff = 0.1, kLeastFree = 0.5, kAllFree = 0.9;  // of points and columns, for hanging things

class Resting {
 public:
  Resting(const RelatedThing& thing, std::span<const RelatedBody* const> bodies, OneSurface& surface,
          const std::stop_token& stop)
      : thing_(thing), bodies_(bodies), surface_(surface), stop_(stop), voxel_m_(thing.voxel_m()) {
    if (thing.points_m.empty()) return;
    std::vector<double> heights_m;
    std::set<std::pair<std::int64_t, std::int64_t>> columns;
    for (const Eigen::Vector3d& p : thing.points_m) {
      heights_m.push_back(p.z());
      columns.emplace(std::llround(p.x() / voxel_m_), std::llround(p.y() / voxel_m_));
    }
    const auto stray = static_cast<std::size_t>(kStrayShare * static_cast<double>(heights_m.size()));
    const auto lowest =
        heights_m.begin() + static_cast<std::ptrdiff_t>(std::min(std::max(stray, kLeastStray), heights_m.size() - 1));
    std::nth_element(heights_m.begin(), lowest, heights_m.end());
    for (const auto& [x, y] : columns) {
      feet_m_.emplace_back(static_cast<double>(x) * voxel_m_, static_cast<double>(y) * voxel_m_, *lowest);
    }
  }

  [[nodiscard]] std::size_t num_columns() const { return feet_m_.size(); }
  /// Shares are numbers of columns. `slope`: additional lateral distance allowed for each metre below.
  std::vector<SupportShare> Within(double below_m, double slope) {
    std::vector<SupportShare> shares;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (bodies_[b] == nullptr) continue;
      shares.push_back({.body = b, .share = 0, .gap_m = std::numeric_limits<double>::infinity()});
    }
    for (const Eigen::Vector3d& foot : feet_m_) {
      if (stop_.stop_requested()) return {};
      AddHolder(foot, below_m, slope, shares);
    }
    return shares;
  }

  /// Whether the space right below is free; if it is partly free, stuff must be above or beside the thing.
  [[nodiscard]] bool Hangs(const QueryWorld& world) { return HangsAtStuff(world) || FreeBelow(world) >= kAllFree; }

  [[nodiscard]] bool HangsAtStuff(const QueryWorld& world) { return FreeBelow(world) >= kLeastFree && IsAtStuff(); }

 private:
  [[nodiscard]] double FreeBelow(const QueryWorld& world) const {
    std::size_t num_free = 0;
    for (const Eigen::Vector3d& foot : feet_m_) {
      const Eigen::Vector3d below = foot - kTouch_vox * voxel_m_ * Eigen::Vector3d::UnitZ();
      num_free += world.SightAt(surface_.T_map_query() * below, {}).is_front;
    }
    return static_cast<double>(num_free) / static_cast<double>(std::max<std::size_t>(1, feet_m_.size()));
  }

  /// Counts the column for the body that supports it.
  void AddHolder(const Eigen::Vector3d& foot, double below_m, double slope, std::vector<SupportShare>& shares) {
    double limit_m = std::hypot(kAside_vox * voxel_m_ + slope * below_m, below_m);
    SupportShare* holder = nullptr;
    for (SupportShare& share : shares) {
      const RelatedBody& body = *bodies_[share.body];
      if (body.box_m.exteriorDistance(foot) > limit_m) continue;
      const auto found = surface_.Nearest(body.number, thing_.body.number, foot, limit_m);
      if (!found) continue;
      const bool ends_there = body.box_m.max().z() <= foot.z() + kAbove_vox * voxel_m_;
      if (found->up < kLeastUp && !ends_there) continue;
      const Eigen::Vector3d way = found->point_m - foot;
      if (way.z() > kAbove_vox * voxel_m_ || way.z() < -below_m) continue;
      if (way.head<2>().norm() > kAside_vox * voxel_m_ + slope * std::max(0.0, -way.z())) continue;
      limit_m = found->distance_m;
      holder = &share;
    }
    if (holder == nullptr) return;
    holder->share += 1;
    holder->gap_m = std::min(holder->gap_m, limit_m);
  }

  [[nodiscard]] bool IsAtStuff() {
    constexpr std::size_t kMostAsked = 500;
    const double near_m = kAside_vox * voxel_m_;
    const std::size_t step = thing_.points_m.size() / kMostAsked + 1;
    std::size_t num_asked = 0, num_near = 0;
    for (std::size_t i = 0; i < thing_.points_m.size() && !stop_.stop_requested(); i += step, ++num_asked) {
      const Eigen::Vector3d& p = thing_.points_m[i];
      num_near += std::any_of(bodies_.begin(), bodies_.end(), [&](const RelatedBody* body) {
        if (body == nullptr || body->IsThing() || body->box_m.exteriorDistance(p) > near_m) return false;
        const auto found = surface_.Nearest(body->number, thing_.body.number, p, near_m);
        return found && found->up < kLeastUp;
      });
    }
    return static_cast<double>(num_near) >= kLeastAtStuff * static_cast<double>(num_asked);
  }

  const RelatedThing& thing_;
  std::span<const RelatedBody* const> bodies_;
  OneSurface& surface_;
  const std::stop_token& stop_;
  const double voxel_m_;
  std::vector<Eigen::Vector3d> feet_m_;  ///< bottoms of the columns
};

/// Converts numbers of columns to shares of the supported columns.
std::vector<SupportShare> LargeShares(std::vector<SupportShare> held, std::size_t num_columns, double least_share) {
  double num_held = 0;
  for (const SupportShare& share : held) num_held += share.share;
  if (num_held < kLeastHeld * static_cast<double>(num_columns)) return {};
  for (SupportShare& share : held) share.share /= num_held;
  std::erase_if(held, [&](const SupportShare& share) { return share.share < least_share; });
  return held;
}

}  // namespace

std::vector<SupportShare> WhatTouches(const RelatedThing& thing, std::span<const RelatedBody* const> bodies,
                                      double least_share, const QueryWorld& world, OneSurface& surface,
                                      const std::stop_token& stop) {
  Resting resting(thing, bodies, surface, stop);
  const std::vector<SupportShare> held =
      LargeShares(resting.Within(kTouch_vox * thing.voxel_m(), 0), resting.num_columns(), least_share);
  const bool is_near = std::any_of(
      held.begin(), held.end(), [&](const SupportShare& share) { return share.gap_m <= kNear_vox * thing.voxel_m(); });
  return is_near || held.empty() || !resting.HangsAtStuff(world) ? held : std::vector<SupportShare>();
}

std::vector<SupportShare> WhatIsBelow(const RelatedThing& thing, std::span<const RelatedBody* const> bodies,
                                      double least_share, const QueryWorld& world, OneSurface& surface,
                                      const std::stop_token& stop) {
  Resting resting(thing, bodies, surface, stop);
  const bool knows_free = !world.surfaces().state().free_space()->tiles().empty();
  if (!knows_free || kFeet_m <= kTouch_vox * thing.voxel_m() || resting.Hangs(world)) return {};
  constexpr double k45Degrees = 1;
  return LargeShares(resting.Within(kFeet_m, k45Degrees), resting.num_columns(), least_share);
}

}  // namespace dhpmap
