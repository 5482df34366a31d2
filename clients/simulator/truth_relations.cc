// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/truth_relations.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "clients/simulator/surface_rays.h"

namespace dhpmap::simulator {
namespace {

using Eigen::Vector3d;

constexpr double kColumn_m = 0.01;
constexpr double kFoot_m = 0.02, kSoft_m = 0.05, kBelowFeet_m = 0.02, kLeastSupport = 0.3;
constexpr int kDirections = 16, kLeastAroundShelf = 8, kLeastAroundCrate = 14;
constexpr double kHangs_m = 0.05, kTouch_m = 0.002;
constexpr double kMostGap_m = 0.5, kLeastHeightShare = 0.5;

/// One thing, and the solids that it may be related to.
struct Furniture {
  std::uint8_t id = 0;
  SolidList own;
  Eigen::AlignedBox3d box_m;
  std::vector<Vector3d> points_m;  ///< on its surface
  SolidList others;                ///< near it
};

class RelationFinder {
 public:
  RelationFinder(std::span<const Instance> instances, std::span<const Solid> solids) : instances_(instances) {
    solids_of_.resize(instances.size());
    for (const Solid& solid : solids) solids_of_[solid.instance].push_back(&solid);
    for (const Instance& instance : instances) {
      if (IsThing(instance.id) && !solids_of_[instance.id].empty()) things_.push_back(Gather(instance.id, solids));
    }
  }

  std::vector<TruthRelation> Run() {
    for (const Furniture& thing : things_) {
      AddOn(thing);
      AddIn(thing);
      if (!Is(TruthRelationKind::kOn, thing.id)) AddHangsOn(thing);
    }
    for (const Furniture& a : things_) {
      for (const Furniture& b : things_) {
        if (a.id < b.id && !IsOnOrIn(a.id, b.id) && !IsOnOrIn(b.id, a.id)) AddNextTo(a, b);
      }
    }
    KeepInnermost();
    std::sort(found_.begin(), found_.end(), [](const TruthRelation& a, const TruthRelation& b) {
      return std::tie(a.subject, a.object, a.kind) < std::tie(b.subject, b.object, b.kind);
    });
    return std::move(found_);
  }

 private:
  [[nodiscard]] bool IsThing(std::uint8_t id) const { return id != 0 && InfoOf(instances_[id].object_class).is_thing; }

  [[nodiscard]] Furniture Gather(std::uint8_t id, std::span<const Solid> solids) const {
    Furniture thing{.id = id, .own = solids_of_[id], .box_m = {}, .points_m = {}, .others = {}};
    thing.points_m = PointsOn(thing.own, kColumn_m);
    for (const Vector3d& p : thing.points_m) thing.box_m.extend(p);
    Eigen::AlignedBox3d around = thing.box_m;
    around.min().array() -= kMostGap_m;
    around.max().array() += kMostGap_m;
    for (const Solid& solid : solids) {
      if (solid.instance == id || !around.intersects(solid.Bounds())) continue;
      thing.others.push_back(&solid);
    }
    return thing;
  }

  /// The lowest point of each column of the thing.
  [[nodiscard]] static std::vector<Vector3d> Underside(const Furniture& thing) {
    constexpr double kStart_m = 0.1;
    std::vector<Vector3d> underside;
    for (double x = thing.box_m.min().x() + kColumn_m / 2; x < thing.box_m.max().x(); x += kColumn_m) {
      for (double y = thing.box_m.min().y() + kColumn_m / 2; y < thing.box_m.max().y(); y += kColumn_m) {
        const Ray up{{x, y, thing.box_m.min().z() - kStart_m}, Vector3d::UnitZ()};
        if (const auto hit = FirstOf(thing.own, up, kFar_m)) underside.push_back(up.At(hit->distance_m));
      }
    }
    return underside;
  }

  void AddOn(const Furniture& thing) {
    std::vector<Vector3d> feet = Underside(thing);
    double lowest_m = kFar_m;
    for (const Vector3d& p : feet) lowest_m = std::min(lowest_m, p.z());
    std::erase_if(feet, [lowest_m](const Vector3d& p) { return p.z() > lowest_m + kFoot_m; });
    std::map<std::uint8_t, int> num_held;
    for (const Vector3d& foot : feet) {
      const Ray down{foot + kSoft_m * Vector3d::UnitZ(), -Vector3d::UnitZ()};
      if (const auto hit = FirstOf(thing.others, down, kSoft_m + kBelowFeet_m)) ++num_held[hit->solid->instance];
    }
    for (const auto& [object, num] : num_held) {
      const double support = num / static_cast<double>(feet.size());
      if (support < kLeastSupport) continue;
      found_.push_back({.kind = TruthRelationKind::kOn, .subject = thing.id, .object = object, .support = support});
    }
  }

  void AddIn(const Furniture& thing) {
    const Vector3d middle = thing.box_m.center();
    for (const Instance& instance : instances_) {
      const SolidList& object = solids_of_[instance.id];
      if (instance.id == 0 || instance.id == thing.id || object.empty()) continue;
      const auto is_met = [&](const Vector3d& direction) { return FirstOf(object, {middle, direction}, kFar_m); };
      if (!BoundsOf(object).contains(middle) || !is_met(-Vector3d::UnitZ())) continue;
      int num_met = 0;
      for (int i = 0; i < kDirections; ++i) {
        const double angle = 2 * std::numbers::pi * (i + 0.5) / kDirections;
        if (is_met({std::cos(angle), std::sin(angle), 0})) ++num_met;
      }
      const bool is_in = num_met >= kLeastAroundCrate || (num_met >= kLeastAroundShelf && is_met(Vector3d::UnitZ()));
      if (is_in) found_.push_back({.kind = TruthRelationKind::kIn, .subject = thing.id, .object = instance.id});
    }
  }

  void KeepInnermost() {
    const std::vector<TruthRelation> all = found_;
    const auto is_in = [&all](std::uint8_t subject, std::uint8_t object) {
      return std::any_of(all.begin(), all.end(), [&](const TruthRelation& r) {
        return r.kind == TruthRelationKind::kIn && r.subject == subject && r.object == object;
      });
    };
    std::erase_if(found_, [&](const TruthRelation& outer) {
      return outer.kind == TruthRelationKind::kIn && std::any_of(all.begin(), all.end(), [&](const TruthRelation& r) {
               return is_in(outer.subject, r.object) && is_in(r.object, outer.object);
             });
    });
  }

  void AddHangsOn(const Furniture& thing) {
    std::map<std::uint8_t, int> num_near;
    for (const Vector3d& p : thing.points_m) {
      const Solid* nearest = nullptr;
      double least_m = kHangs_m;
      for (const Solid* solid : thing.others) {
        const double distance_m = solid->Distance(p);
        if (distance_m < least_m) std::tie(least_m, nearest) = std::pair(distance_m, solid);
      }
      if (nearest != nullptr) ++num_near[nearest->instance];
    }
    const auto most = std::max_element(num_near.begin(), num_near.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most == num_near.end()) return;
    found_.push_back({.kind = TruthRelationKind::kHangsOn, .subject = thing.id, .object = most->first});
  }

  void AddNextTo(const Furniture& a, const Furniture& b) {
    const double shared_m =
        std::min(a.box_m.max().z(), b.box_m.max().z()) - std::max(a.box_m.min().z(), b.box_m.min().z());
    const double height_share = shared_m / std::min(a.box_m.sizes().z(), b.box_m.sizes().z());
    if (height_share < kLeastHeightShare || a.box_m.exteriorDistance(b.box_m) > kMostGap_m) return;
    const std::optional<double> gap_m = FreeWay(a, b);
    if (!gap_m) return;
    found_.push_back({.kind = TruthRelationKind::kNextTo,
                      .subject = a.id,
                      .object = b.id,
                      .gap_m = *gap_m,
                      .height_share = height_share});
  }

  /// The shortest straight line from points of `a` to the nearest point of `b` that meets nothing else.
  static std::optional<double> FreeWay(const Furniture& a, const Furniture& b) {
    std::vector<std::pair<double, Vector3d>> starts;
    for (const Vector3d& p : a.points_m) {
      if (b.box_m.exteriorDistance(p) > kMostGap_m) continue;
      const double distance_m = DistanceTo(b.own, p);
      if (distance_m <= kMostGap_m) starts.emplace_back(distance_m, p);
    }
    std::sort(starts.begin(), starts.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    SolidList others;
    for (const Solid* solid : a.others) {
      if (solid->instance != b.id) others.push_back(solid);
    }
    for (const auto& [distance_m, p] : starts) {
      if (distance_m <= kColumn_m) return std::max(distance_m, 0.0);
      const Vector3d nearest = p - distance_m * Slope(b.own, p);
      const bool is_on_it = DistanceTo(b.own, nearest) < kTouch_m;  // false if two solids are equally near
      if (is_on_it && IsFree(others, p, nearest)) return distance_m;
    }
    return std::nullopt;
  }

  /// Near both ends the line may touch solids (a picture touches its wall); elsewhere it may not run along a face of
  /// theirs.
  static bool IsFree(const SolidList& solids, const Vector3d& from, const Vector3d& to) {
    constexpr double kStep_m = 0.005, kEnd_m = 0.02, kClear_m = 0.001;
    const double length_m = (to - from).norm();
    for (double at_m = 0; at_m < length_m; at_m += kStep_m) {
      const double distance_m = DistanceTo(solids, from + at_m / length_m * (to - from));
      const bool is_at_end = at_m < kEnd_m || at_m > length_m - kEnd_m;
      if (distance_m < (is_at_end ? -kTouch_m : kClear_m)) return false;
    }
    return true;
  }

  /// Gradient of the distance to solids, outside them.
  static Vector3d Slope(const SolidList& solids, const Vector3d& p) {
    constexpr double kStep_m = 1e-5;
    Vector3d slope;
    for (int i = 0; i < 3; ++i) {
      const Vector3d step = kStep_m * Vector3d::Unit(i);
      slope[i] = DistanceTo(solids, p + step) - DistanceTo(solids, p - step);
    }
    return slope.normalized();
  }

  [[nodiscard]] bool Is(TruthRelationKind kind, std::uint8_t subject) const {
    return std::any_of(found_.begin(), found_.end(),
                       [&](const TruthRelation& r) { return r.kind == kind && r.subject == subject; });
  }
  [[nodiscard]] bool IsOnOrIn(std::uint8_t subject, std::uint8_t object) const {
    return std::any_of(found_.begin(), found_.end(), [&](const TruthRelation& r) {
      return r.kind != TruthRelationKind::kHangsOn && r.kind != TruthRelationKind::kNextTo && r.subject == subject &&
             r.object == object;
    });
  }

  std::span<const Instance> instances_;
  std::vector<SolidList> solids_of_;  ///< by instance
  std::vector<Furniture> things_;     ///< sorted by id
  std::vector<TruthRelation> found_;
};

}  // namespace

const char* NameOf(TruthRelationKind kind) {
  switch (kind) {
    case TruthRelationKind::kOn: return "ON";
    case TruthRelationKind::kIn: return "IN";
    case TruthRelationKind::kHangsOn: return "HANGS_ON";
    case TruthRelationKind::kNextTo: return "NEXT_TO";
  }
  return "";
}

std::vector<TruthRelation> RelationsOf(std::span<const Instance> instances, std::span<const Solid> solids) {
  return RelationFinder(instances, solids).Run();
}

}  // namespace dhpmap::simulator
