// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/relations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "mapping/query/nearest_search.h"
#include "mapping/query/object_shape.h"
#include "mapping/query/ray_query.h"

namespace dhpmap {
namespace {

constexpr double kContact_vox = 2;
/// Between surfaces of objects that touch, each of which ends up to a voxel before the other.
constexpr double kHold_vox = 3;
constexpr double kLeastUp = 0.70710678;  // cosine of 45 degrees
/// Stray voxels below an object are not what it stands on.
constexpr double kStrayShare = 0.02;
constexpr std::size_t kMostPoints = 4096;  // of a surface, for what it touches
constexpr std::size_t kMostEnclosed = 48;  // of a surface, for rays
constexpr std::size_t kFewEnclosed = 8;    // one point of so many of them is asked first
constexpr double kLeastInBox = 0.5;        // of the subject's box, for rays to be cast at all

/// A thing or stuff, in the asker's frame.
struct RelatedBody {
  std::size_t number = 0;
  const Submap* submap = nullptr;
  Eigen::AlignedBox3d box_m;

  [[nodiscard]] bool IsThing() const { return submap->info().panoptic == Panoptic::kThing; }
  [[nodiscard]] SubmapId id() const { return submap->id(); }
};

/// A thing with points of its surface: of a few at a time.
struct Subject {
  const RelatedBody& body;
  std::vector<Eigen::Vector3d> points_m;
};

double Volume(const Eigen::AlignedBox3d& box) { return box.isEmpty() ? 0 : box.sizes().prod(); }

/// The 26 directions to the cells around a cell, as unit vectors.
std::vector<Eigen::Vector3d> AllAround() {
  std::vector<Eigen::Vector3d> directions;
  for (int n = 0; n < 27; ++n) {
    const Eigen::Vector3d cell(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
    if (!cell.isZero()) directions.push_back(cell.normalized());
  }
  return directions;
}

/// How the surface of one object lies to points: asks that object alone. After `stop` it ends soon, and what it says
/// means nothing.
class Judge {
 public:
  Judge(const MapSurfaces& surfaces, const RelationQuestion& question, const std::stop_token& stop)
      : surfaces_(surfaces),
        question_(question),
        stop_(stop),
        T_query_map_(question.T_map_query.inverse()),
        is_held_(surfaces.index().entries().size()),
        is_there_(surfaces.index().entries().size(), true),
        search_(surfaces, is_held_, is_there_) {}

  struct Support {
    double share = 0;
    double gap_m = 0;
  };
  Support SupportOf(const Subject& subject, const RelatedBody& object) {
    std::vector<double> heights_m;
    for (const Eigen::Vector3d& p : subject.points_m) heights_m.push_back(p.z());
    const auto lowest =
        heights_m.begin() + static_cast<std::ptrdiff_t>(kStrayShare * static_cast<double>(heights_m.size()));
    std::nth_element(heights_m.begin(), lowest, heights_m.end());
    const double reach_m = kContact_vox * subject.body.submap->info().voxel_size_m, bottom_m = *lowest;
    const double hold_m = kHold_vox * subject.body.submap->info().voxel_size_m;
    const FlagSet held(is_held_, object.number, true);
    const FlagSet absent(is_there_, subject.body.number, false);  // what holds it up is there without it
    int num_bottom = 0, num_held = 0;
    double gap_m = hold_m;
    for (const Eigen::Vector3d& p : subject.points_m) {
      if (stop_.stop_requested()) break;
      if (p.z() > bottom_m + reach_m) continue;
      ++num_bottom;
      const auto found = Nearest(p, hold_m);
      if (!found || found->up < kLeastUp || found->point_m.z() > p.z() + reach_m / 2) continue;
      ++num_held;
      gap_m = std::min(gap_m, found->distance_m);
    }
    if (num_held == 0) return {};
    return {static_cast<double>(num_held) / num_bottom, gap_m};
  }

  /// The least distance, infinity if it is more than the limit.
  double GapOf(const Subject& subject, const RelatedBody& object, double limit_m) {
    const FlagSet held(is_held_, object.number, true);
    double gap_m = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& p : subject.points_m) {
      if (stop_.stop_requested()) break;
      if (object.box_m.exteriorDistance(p) > std::min(limit_m, gap_m)) continue;
      if (const auto found = Nearest(p, std::min(limit_m, gap_m))) gap_m = std::min(gap_m, found->distance_m);
    }
    return gap_m;
  }

  double EnclosureOf(const Subject& subject, const RelatedBody& object) {
    static const std::vector<Eigen::Vector3d> directions = AllAround();
    const double limit_m = object.box_m.diagonal().norm();
    // Ends with a share below `least` once that is all it can be.
    const auto share_met_from = [&](std::size_t first, std::size_t step, double least) {
      const std::size_t num_points = (subject.points_m.size() - first + step - 1) / step;
      const auto num_rays = static_cast<double>(num_points * directions.size());
      double num_met = num_rays;  // at most
      for (std::size_t i = first; i < subject.points_m.size(); i += step) {
        if (stop_.stop_requested()) return 0.0;
        for (const Eigen::Vector3d& direction : directions) {
          const Ray ray{question_.T_map_query * subject.points_m[i], question_.T_map_query.linear() * direction};
          if (MeetsSubmap(surfaces_, object.number, ray, limit_m)) continue;
          if (--num_met < least * num_rays) return num_met / num_rays;
        }
      }
      return num_met / num_rays;
    };
    if (subject.points_m.empty()) return 0;
    // A wall's box holds all that stands in the room. A few points tell that it is far from being around them.
    const std::size_t step = std::max<std::size_t>(1, subject.points_m.size() / kMostEnclosed);
    const double least = question_.rules.least_enclosure;
    const double of_few = share_met_from(step / 2, kFewEnclosed * step, 0.75 * least);
    return of_few < 0.75 * least ? of_few : share_met_from(0, step, least);
  }

 private:
  /// Sets the flag of one submap for its life.
  class FlagSet {
   public:
    FlagSet(std::vector<bool>& flags, std::size_t number, bool value) : flags_(flags), number_(number), value_(value) {
      flags_[number_] = value_;
    }
    ~FlagSet() { flags_[number_] = !value_; }
    FlagSet(const FlagSet&) = delete;
    FlagSet& operator=(const FlagSet&) = delete;

   private:
    std::vector<bool>& flags_;
    std::size_t number_;
    bool value_;
  };
  struct Found {
    double distance_m;
    double up;                ///< of the normal
    Eigen::Vector3d point_m;  ///< asker's frame
  };
  std::optional<Found> Nearest(const Eigen::Vector3d& p, double limit_m) {
    const NearestSurface found = search_.Find(question_.T_map_query * p, limit_m);
    if (!found.is_any) return std::nullopt;
    const double distance_m = (found.p_submap - found.point_submap).norm();
    if (distance_m > limit_m) return std::nullopt;
    const Transform T_query_submap =
        T_query_map_ * surfaces_.index().entries()[found.number].submap().info().T_map_submap;
    return Found{distance_m, (T_query_submap.linear() * found.normal_submap).z(), T_query_submap * found.point_submap};
  }

  const MapSurfaces& surfaces_;
  const RelationQuestion& question_;
  const std::stop_token& stop_;
  const Transform T_query_map_;
  std::vector<bool> is_held_, is_there_;
  NearestSearch search_;
};

class Finder {
 public:
  Finder(const MapSurfaces& surfaces, const RelationQuestion& question, const std::stop_token& stop)
      : surfaces_(surfaces), question_(question), stop_(stop), judge_(surfaces, question, stop) {}

  std::vector<Relation> Run() {
    Gather();
    for (std::size_t a = 0; a < bodies_.size() && !IsEnough(); ++a) {
      if (!bodies_[a].IsThing()) continue;
      std::optional<Subject> subject;
      for (const std::uint32_t b : Around(a)) {
        if (stop_.stop_requested()) return std::move(found_);
        if (b == a || !IsAskedFor(bodies_[a], bodies_[b])) continue;
        if (!subject) subject.emplace(SubjectOf(bodies_[a]));
        Compare(*subject, bodies_[b]);
      }
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
      constexpr std::uint64_t kEver = 0;  // all of the surface: of a large submap that takes long
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

  [[nodiscard]] Subject SubjectOf(const RelatedBody& body) const {
    return {body, SurfacePoints(surfaces_, body.number, question_.T_map_query.inverse(), kMostPoints)};
  }

  /// Rounded outwards by a millimetre.
  [[nodiscard]] Eigen::AlignedBox3f InTree(const Eigen::AlignedBox3d& box_m, double grow_m) const {
    const Eigen::Vector3d grow = Eigen::Vector3d::Constant(grow_m + 1e-3);
    return {(box_m.min() - origin_m_ - grow).cast<float>(), (box_m.max() - origin_m_ + grow).cast<float>()};
  }

  /// Those that may have to do with it, by ascending id.
  std::vector<std::uint32_t> Around(std::size_t a) {
    const RelatedBody& body = bodies_[a];
    const double reach_m = std::max(question_.rules.most_gap_m, kHold_vox * body.submap->info().voxel_size_m);
    std::vector<std::uint32_t> around;
    tree_.VisitOverlapping(InTree(body.box_m, reach_m),
                           [&](std::size_t position) { around.push_back(tree_.items()[position]); });
    std::sort(around.begin(), around.end());
    return around;
  }

  [[nodiscard]] bool IsEnough() const { return found_.size() >= question_.most; }
  [[nodiscard]] bool IsAskedFor(const RelatedBody& a, const RelatedBody& b) const {
    return !question_.submap || a.id() == *question_.submap || b.id() == *question_.submap;
  }
  [[nodiscard]] bool IsWanted(RelationKind kind) const {
    return !question_.kinds ||
           std::find(question_.kinds->begin(), question_.kinds->end(), kind) != question_.kinds->end();
  }

  void Compare(const Subject& subject, const RelatedBody& object) {
    const Relation on = On(subject, object), in = In(subject, object);
    if (stop_.stop_requested()) return;
    if (on.subject != nullptr && IsWanted(RelationKind::kOn)) found_.push_back(on);
    if (in.subject != nullptr && IsWanted(RelationKind::kIn)) found_.push_back(in);
    const bool is_related = on.subject != nullptr || in.subject != nullptr;
    if (is_related || !object.IsThing() || object.id() < subject.body.id()) return;
    if (!IsWanted(RelationKind::kNextTo)) return;
    const Relation next = NextTo(subject, object);
    if (next.subject == nullptr) return;
    const Subject other = SubjectOf(object);
    const bool is_reverse = On(other, subject.body).subject != nullptr || In(other, subject.body).subject != nullptr;
    if (!is_reverse && !stop_.stop_requested()) found_.push_back(next);
  }

  // Each is without a subject if it does not hold.

  Relation On(const Subject& subject, const RelatedBody& object) {
    const double reach_m = kHold_vox * subject.body.submap->info().voxel_size_m;
    Eigen::AlignedBox3d bottom_m = subject.body.box_m;
    bottom_m.min().array() -= reach_m;
    if (!bottom_m.intersects(object.box_m)) return {};
    const Judge::Support support = judge_.SupportOf(subject, object);
    if (support.share < question_.rules.least_support) return {};
    return {.kind = RelationKind::kOn,
            .subject = subject.body.submap,
            .object = object.submap,
            .support = support.share,
            .gap_m = support.gap_m};
  }

  Relation In(const Subject& subject, const RelatedBody& object) {
    const double in_box = Volume(subject.body.box_m.intersection(object.box_m));
    if (in_box < kLeastInBox * Volume(subject.body.box_m) || !object.box_m.contains(subject.body.box_m.center()))
      return {};
    const double enclosure = judge_.EnclosureOf(subject, object);
    if (enclosure < question_.rules.least_enclosure) return {};
    return {.kind = RelationKind::kIn,
            .subject = subject.body.submap,
            .object = object.submap,
            .enclosure = enclosure,
            .gap_m = judge_.GapOf(subject, object, object.box_m.diagonal().norm())};
  }

  Relation NextTo(const Subject& subject, const RelatedBody& object) {
    const double shared_m = std::min(subject.body.box_m.max().z(), object.box_m.max().z()) -
                            std::max(subject.body.box_m.min().z(), object.box_m.min().z());
    const double height_share = shared_m / std::min(subject.body.box_m.sizes().z(), object.box_m.sizes().z());
    if (!(height_share >= question_.rules.least_height_share)) return {};
    const double gap_m = judge_.GapOf(subject, object, question_.rules.most_gap_m);
    if (gap_m > question_.rules.most_gap_m) return {};
    return {.kind = RelationKind::kNextTo,
            .subject = subject.body.submap,
            .object = object.submap,
            .gap_m = gap_m,
            .height_share = height_share};
  }

  const MapSurfaces& surfaces_;
  const RelationQuestion& question_;
  const std::stop_token& stop_;
  Judge judge_;
  std::vector<RelatedBody> bodies_;  // by ascending id
  Eigen::Vector3d origin_m_ = Eigen::Vector3d::Zero();
  BoxTree tree_;  // of their boxes
  std::vector<Relation> found_;
};

}  // namespace

std::vector<Relation> FindRelations(const MapSurfaces& surfaces, const RelationQuestion& question,
                                    const std::stop_token& stop) {
  return Finder(surfaces, question, stop).Run();
}

}  // namespace dhpmap
