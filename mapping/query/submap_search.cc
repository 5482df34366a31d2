// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/submap_search.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "mapping/submap/display_name.h"
#include "mapping/surfaces/nearest_search.h"
#include "mapping/surfaces/object_shape.h"

namespace dhpmap {
namespace {

char Lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool HasPart(const std::string& text, const std::string& part) {
  return std::search(text.begin(), text.end(), part.begin(), part.end(),
                     [](char a, char b) { return Lower(a) == Lower(b); }) != text.end();
}

/// Finds the distance of one submap at a time.
class Nearness {
 public:
  explicit Nearness(const MapSurfaces& surfaces)
      : is_held_(surfaces.index().entries().size()), search_(surfaces, is_held_) {}

  /// Nothing if it is farther than the limit.
  std::optional<NearestSurface> Of(std::size_t number, const Eigen::Vector3d& p_map, double limit_m) {
    is_held_[number] = true;
    const NearestSurface found = search_.Find(p_map, limit_m);
    is_held_[number] = false;
    const bool is_near = found.is_any && (found.p_submap - found.point_submap).norm() <= limit_m;
    return is_near ? std::optional(found) : std::nullopt;
  }

 private:
  std::vector<bool> is_held_;
  NearestSearch search_;
};

class Search {
 public:
  Search(const MapSurfaces& surfaces, const SubmapQuestion& question, const std::stop_token& stop)
      : surfaces_(surfaces),
        question_(question),
        stop_(stop),
        T_query_map_(question.T_map_query.inverse()),
        nearness_(surfaces) {}

  std::vector<SubmapMatch> Run() {
    std::vector<SubmapMatch> matches = question_.near_m ? Nearest() : First();
    for (SubmapMatch& match : matches) {
      const std::size_t number = NumberOf(match);
      if (!MakeSurface(number)) break;
      match.box_m = SurfaceBox(surfaces_, number, T_query_map_);
    }
    return matches;
  }

 private:
  /// Makes the missing parts of the whole surface; takes long for a large submap. False: stopped.
  [[nodiscard]] bool MakeSurface(std::size_t number) const {
    constexpr std::uint64_t kEver = 0;
    surfaces_.surface(number).PrepareUsedSince(kEver, surfaces_.state(), surfaces_.index().entries()[number].submap(),
                                               stop_);
    return !stop_.stop_requested();
  }

  [[nodiscard]] std::size_t NumberOf(const SubmapMatch& match) const {
    const auto entries = surfaces_.index().entries();
    return static_cast<std::size_t>(
        std::find_if(entries.begin(), entries.end(),
                     [&match](const auto& entry) { return &entry.submap() == match.submap; }) -
        entries.begin());
  }

  std::vector<SubmapMatch> First() {
    std::vector<SubmapMatch> matches;
    for (std::size_t number = 0; number < surfaces_.index().entries().size(); ++number) {
      if (matches.size() == question_.most || stop_.stop_requested()) break;
      if (!IsAfter(0, number) || !Passes(number)) continue;
      SubmapMatch& match = matches.emplace_back();
      match.submap = &surfaces_.index().entries()[number].submap();
      match.nearest_m.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    return matches;
  }

  /// Visits boxes in order of distance, until no box is nearer than the farthest match.
  std::vector<SubmapMatch> Nearest() {
    const Eigen::Vector3d p_map = question_.T_map_query * *question_.near_m;
    std::vector<std::pair<double, std::size_t>> candidates;
    for (std::size_t number = 0; number < surfaces_.index().entries().size(); ++number) {
      const SubmapIndex::Entry& entry = surfaces_.index().entries()[number];
      candidates.emplace_back(entry.box_m().exteriorDistance(entry.ToSubmap(p_map)), number);
    }
    std::sort(candidates.begin(), candidates.end());
    const auto is_before = [](const SubmapMatch& a, const SubmapMatch& b) {
      return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.submap->id() < b.submap->id();
    };
    std::vector<SubmapMatch> best;  // a heap with the farthest on top
    double limit_m = question_.max_distance_m.value_or(kFarAway_m);
    for (const auto& [box_m, number] : candidates) {
      if (box_m > limit_m || question_.most == 0 || stop_.stop_requested()) break;
      if (!Passes(number)) continue;
      const auto found = nearness_.Of(number, p_map, limit_m);
      if (!found) continue;
      const double distance_m = (found->p_submap - found->point_submap).norm();
      if (!IsAfter(distance_m, number)) continue;
      const Submap& submap = surfaces_.index().entries()[number].submap();
      best.push_back({.submap = &submap,
                      .distance_m = distance_m,
                      .nearest_m = T_query_map_ * (submap.info().T_map_submap * found->point_submap)});
      std::push_heap(best.begin(), best.end(), is_before);
      if (best.size() > question_.most) {
        std::pop_heap(best.begin(), best.end(), is_before);
        best.pop_back();
      }
      if (best.size() == question_.most) limit_m = best.front().distance_m;
    }
    std::sort_heap(best.begin(), best.end(), is_before);
    return best;
  }

  [[nodiscard]] bool IsAfter(double distance_m, std::size_t number) const {
    return !question_.after ||
           *question_.after < MatchPlace{distance_m, surfaces_.index().entries()[number].submap().id()};
  }

  bool Passes(std::size_t number) {
    const SubmapInfo& submap = surfaces_.index().entries()[number].submap().info();
    if (!question_.scope.Holds(submap)) return false;
    if (question_.scope.classes && submap.panoptic == Panoptic::kUnknown) return false;
    if (!HasPart(DisplayNameOf(submap, *surfaces_.state().info().label_set), question_.name_part)) return false;
    if (question_.sphere_m &&
        !nearness_.Of(number, question_.T_map_query * question_.sphere_m->center_m, question_.sphere_m->radius_m)) {
      return false;
    }
    if (!question_.box_m) return true;
    const Eigen::AlignedBox3d& box_m = surfaces_.index().entries()[number].box_m();
    if (!question_.box_m->intersects(box_m.transformed(T_query_map_ * submap.T_map_submap))) return false;
    return MakeSurface(number) && SurfaceIsIn(surfaces_, number, T_query_map_, *question_.box_m);
  }

  static constexpr double kFarAway_m = 1e9;  // its square fits into a float

  const MapSurfaces& surfaces_;
  const SubmapQuestion& question_;
  const std::stop_token& stop_;
  const Transform T_query_map_;
  Nearness nearness_;
};

}  // namespace

std::vector<SubmapMatch> SearchSubmaps(const MapSurfaces& surfaces, const SubmapQuestion& question,
                                       const std::stop_token& stop) {
  return Search(surfaces, question, stop).Run();
}

}  // namespace dhpmap
