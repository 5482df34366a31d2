// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/relations.h"

#include <algorithm>
#include <map>
#include <utility>

#include "mapping/query/enclosure.h"
#include "mapping/query/free_way.h"
#include "mapping/query/resting.h"
#include "mapping/surfaces/object_shape.h"

namespace dhpmap {
namespace {

constexpr std::size_t kMostSurfacePoints = 4096;
constexpr double kLeastInside = 0.2;  // share of its support by an enclosing body
constexpr double kReach_m = 0.5;      // around feet, or 4 voxels

class Finder {
 public:
  Finder(const MapSurfaces& surfaces, const RelationQuestion& question, const std::stop_token& stop)
      : surfaces_(surfaces),
        question_(question),
        stop_(stop),
        world_(std::shared_ptr<const MapSurfaces>(std::shared_ptr<void>(), &surfaces), question.scope),
        surface_(surfaces, question.T_map_query) {}

  std::vector<Relation> Run() {
    Gather();
    for (std::size_t a = 0; a < bodies_.size() && !IsEnough(); ++a) {
      if (!bodies_[a].IsThing() || IsBefore(bodies_[a])) continue;
      RelateThing(a);
      if (stop_.stop_requested()) break;
    }
    if (found_.size() > question_.most) found_.resize(question_.most);
    return std::move(found_);
  }

 private:
  void Gather() {
    const Transform T_query_map = question_.T_map_query.inverse();
    std::vector<Eigen::AlignedBox3f> boxes;
    for (std::size_t number = 0; number < surfaces_.index().entries().size() && !stop_.stop_requested(); ++number) {
      const Submap& submap = surfaces_.index().entries()[number].submap();
      if (submap.info().panoptic == Panoptic::kUnknown || !question_.scope.Holds(submap.info())) continue;
      constexpr std::uint64_t kEver = 0;  // all of the surface: takes long for a large submap
      surfaces_.surface(number).PrepareUsedSince(kEver, surfaces_.state(), submap, stop_);
      if (stop_.stop_requested()) break;
      RelatedBody body{.number = number, .submap = &submap, .box_m = SurfaceBox(surfaces_, number, T_query_map)};
      if (body.box_m.isEmpty()) continue;
      if (bodies_.empty()) origin_m_ = body.box_m.center();
      boxes.push_back(InTree(body.box_m, 0));
      bodies_.push_back(std::move(body));
    }
    tree_ = BoxTree(boxes);
  }

  [[nodiscard]] RelatedThing ThingOf(const RelatedBody& body) const {
    return {body, SurfacePoints(surfaces_, body.number, question_.T_map_query.inverse(), kMostSurfacePoints)};
  }

  /// Enlarged by a millimetre for rounding.
  [[nodiscard]] Eigen::AlignedBox3f InTree(const Eigen::AlignedBox3d& box_m, double grow_m) const {
    const Eigen::Vector3d grow = Eigen::Vector3d::Constant(grow_m + 1e-3);
    return {(box_m.min() - origin_m_ - grow).cast<float>(), (box_m.max() - origin_m_ + grow).cast<float>()};
  }

  /// Bodies that may be related to it, sorted by id.
  std::vector<std::uint32_t> Around(const RelatedBody& body) {
    const double reach_m = std::max({question_.rules.most_gap_m, kReach_m, 4 * body.submap->info().voxel_size_m});
    std::vector<std::uint32_t> around;
    tree_.VisitOverlapping(InTree(body.box_m, reach_m),
                           [&](std::size_t position) { around.push_back(tree_.items()[position]); });
    std::sort(around.begin(), around.end());
    return around;
  }

  [[nodiscard]] bool IsEnough() const { return found_.size() >= question_.most; }
  /// Whether all its relations were returned on earlier pages.
  [[nodiscard]] bool IsBefore(const RelatedBody& subject) const {
    return question_.after && subject.id() < question_.after->subject;
  }
  [[nodiscard]] bool IsAfter(const Relation& relation) const {
    return !question_.after ||
           *question_.after < RelationPlace{relation.subject->id(), relation.object->id(), relation.kind};
  }
  [[nodiscard]] bool IsAskedFor(const RelatedBody& a, const RelatedBody& b) const {
    return !question_.submap || a.id() == *question_.submap || b.id() == *question_.submap;
  }
  [[nodiscard]] bool IsWanted(RelationKind kind) const {
    return !question_.kinds ||
           std::find(question_.kinds->begin(), question_.kinds->end(), kind) != question_.kinds->end();
  }

  /// Bodies around one, and those that it is on or in, as indices.
  struct Surroundings {
    std::vector<const RelatedBody*> bodies;  ///< sorted by id
    std::vector<SupportShare> held_by;
    std::map<std::size_t, double> enclosure;  ///< of those that enclose it
  };
  const Surroundings& SurroundingsOf(const RelatedThing& thing) {
    const auto known = surroundings_.find(thing.body.number);
    if (known != surroundings_.end()) return known->second;
    return surroundings_.emplace(thing.body.number, LookAround(thing)).first->second;
  }
  Surroundings LookAround(const RelatedThing& thing) {
    Surroundings around;
    for (const std::uint32_t b : Around(thing.body)) {
      if (&bodies_[b] != &thing.body) around.bodies.push_back(&bodies_[b]);
    }
    const RelationRules& rules = question_.rules;
    // A body encloses a thing only if it is also below it, so walls do not enclose things in a room.
    const double least = std::min(kLeastInside, rules.least_support);
    around.held_by = WhatTouches(thing, around.bodies, least, world_, surface_, stop_);
    for (std::size_t i = 0; i < around.bodies.size() && !stop_.stop_requested(); ++i) {
      const bool is_below = IsHeldBy(around, i);
      if (!is_below && !around.bodies[i]->IsThing()) continue;  // a picture is close to a wall in all directions
      const double enclosure = EnclosureOf(thing, *around.bodies[i], is_below, world_, surface_, stop_);
      if (enclosure >= rules.least_enclosure) around.enclosure.emplace(i, enclosure);
    }
    KeepHolders(rules.least_support, around);
    if (around.held_by.empty()) {
      around.held_by = WhatIsBelow(thing, around.bodies, rules.least_support, world_, surface_, stop_);
    }
    return around;
  }

  /// A thing in a container rests on containers only; others rest on bodies with sufficient support.
  static void KeepHolders(double least_support, Surroundings& around) {
    double inside = 0;
    for (const SupportShare& held : around.held_by) inside += around.enclosure.contains(held.body) ? held.share : 0;
    std::erase_if(around.held_by, [&](const SupportShare& held) {
      return inside > 0 ? !around.enclosure.contains(held.body) : held.share < least_support;
    });
    if (inside > 0) {
      for (SupportShare& held : around.held_by) held.share /= inside;
    }
  }

  void RelateThing(std::size_t a) {
    const std::vector<std::uint32_t> around = Around(bodies_[a]);
    const auto is_asked = [&](std::uint32_t b) { return b != a && IsAskedFor(bodies_[a], bodies_[b]); };
    if (std::none_of(around.begin(), around.end(), is_asked)) return;
    const RelatedThing thing = ThingOf(bodies_[a]);
    const Surroundings& surroundings = SurroundingsOf(thing);
    std::vector<Relation> found;
    for (std::size_t i = 0; i < surroundings.bodies.size() && !stop_.stop_requested(); ++i) {
      if (IsAskedFor(bodies_[a], *surroundings.bodies[i])) Compare(thing, surroundings, i, found);
    }
    std::erase_if(found, [this](const Relation& relation) { return !IsAfter(relation); });
    // Results after a stop request may be wrong.
    if (!stop_.stop_requested()) found_.insert(found_.end(), found.begin(), found.end());
  }

  void Compare(const RelatedThing& thing, const Surroundings& around, std::size_t i, std::vector<Relation>& found) {
    const RelatedBody& object = *around.bodies[i];
    const Relation on = On(thing, around, i), in = In(thing, around, i);
    if (on.subject != nullptr && IsWanted(RelationKind::kOn)) found.push_back(on);
    if (in.subject != nullptr && IsWanted(RelationKind::kIn)) found.push_back(in);
    const bool is_related = IsHeldBy(around, i) || around.enclosure.contains(i);
    if (is_related || !object.IsThing() || object.id() < thing.body.id()) return;
    if (!IsWanted(RelationKind::kNextTo)) return;
    const Relation next = NextTo(thing, around, object);
    if (next.subject != nullptr && !IsOnOrIn(object, thing.body)) found.push_back(next);
  }

  [[nodiscard]] bool IsOnOrIn(const RelatedBody& subject, const RelatedBody& object) {
    const Surroundings& around = SurroundingsOf(ThingOf(subject));
    const auto found = std::find(around.bodies.begin(), around.bodies.end(), &object);
    if (found == around.bodies.end()) return false;
    const auto i = static_cast<std::size_t>(found - around.bodies.begin());
    return IsHeldBy(around, i) || around.enclosure.contains(i);
  }

  static bool IsHeldBy(const Surroundings& around, std::size_t i) {
    return std::any_of(around.held_by.begin(), around.held_by.end(),
                       [i](const SupportShare& held) { return held.body == i; });
  }

  /// Whether a container is the innermost: a cup in a box in a shelf is in the box.
  [[nodiscard]] bool IsInnermost(const Surroundings& around, std::size_t i) {
    return std::none_of(around.enclosure.begin(), around.enclosure.end(), [&](const auto& container) {
      const RelatedBody& inner = *around.bodies[container.first];
      return container.first != i && inner.IsThing() && IsIn(inner, *around.bodies[i]);
    });
  }
  [[nodiscard]] bool IsIn(const RelatedBody& subject, const RelatedBody& object) {
    const Surroundings& around = SurroundingsOf(ThingOf(subject));
    return std::any_of(around.enclosure.begin(), around.enclosure.end(),
                       [&](const auto& container) { return around.bodies[container.first] == &object; });
  }

  // Each function returns a relation without subject if it does not hold.

  static Relation On(const RelatedThing& thing, const Surroundings& around, std::size_t i) {
    for (const SupportShare& held : around.held_by) {
      if (held.body != i) continue;
      return {.kind = RelationKind::kOn,
              .subject = thing.body.submap,
              .object = around.bodies[i]->submap,
              .support = held.share,
              .gap_m = held.gap_m};
    }
    return {};
  }

  Relation In(const RelatedThing& thing, const Surroundings& around, std::size_t i) {
    const auto found = around.enclosure.find(i);
    if (found == around.enclosure.end() || !IsInnermost(around, i)) return {};
    return {.kind = RelationKind::kIn,
            .subject = thing.body.submap,
            .object = around.bodies[i]->submap,
            .enclosure = found->second,
            .gap_m = GapOf(thing, *around.bodies[i])};
  }

  /// The smallest distance between a thing and a body.
  double GapOf(const RelatedThing& thing, const RelatedBody& object) {
    double gap_m = object.box_m.diagonal().norm();
    for (const Eigen::Vector3d& p : thing.points_m) {
      if (stop_.stop_requested()) break;
      const auto found = surface_.Nearest(object.number, thing.body.number, p, gap_m);
      if (found) gap_m = std::min(gap_m, found->distance_m);
    }
    return gap_m;
  }

  Relation NextTo(const RelatedThing& thing, const Surroundings& around, const RelatedBody& object) {
    const Eigen::AlignedBox3d &a = thing.body.box_m, &b = object.box_m;
    const double shared_m = std::min(a.max().z(), b.max().z()) - std::max(a.min().z(), b.min().z());
    const double height_share = shared_m / std::min(a.sizes().z(), b.sizes().z());
    if (!(height_share >= question_.rules.least_height_share)) return {};
    std::vector<const RelatedBody*> others = around.bodies;
    std::erase(others, &object);
    const auto gap_m = FreeWay(thing, object, others, question_.rules.most_gap_m, world_, surface_, stop_);
    if (!gap_m) return {};
    return {.kind = RelationKind::kNextTo,
            .subject = thing.body.submap,
            .object = object.submap,
            .gap_m = *gap_m,
            .height_share = height_share};
  }

  const MapSurfaces& surfaces_;
  const RelationQuestion& question_;
  const std::stop_token& stop_;
  const QueryWorld world_;
  OneSurface surface_;
  std::vector<RelatedBody> bodies_;  // sorted by id
  Eigen::Vector3d origin_m_ = Eigen::Vector3d::Zero();
  BoxTree tree_;                                      // of the bodies' boxes
  std::map<std::size_t, Surroundings> surroundings_;  // computed so far, by index
  std::vector<Relation> found_;
};

}  // namespace

std::vector<Relation> FindRelations(const MapSurfaces& surfaces, const RelationQuestion& question,
                                    const std::stop_token& stop) {
  return Finder(surfaces, question, stop).Run();
}

}  // namespace dhpmap
