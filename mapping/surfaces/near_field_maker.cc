// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/near_field_maker.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "mapping/base/vector_clones.h"
#include "mapping/geometry/field_normals.h"
#include "mapping/surfaces/nearest_search.h"

namespace dhpmap {
namespace {

constexpr float kRounding_m = 2e-6f;
constexpr std::size_t kMostCandidates = 30000;
constexpr std::size_t kFew = 8;    // tested directly
constexpr std::size_t kSome = 16;  // cheaper to test than more cubes
constexpr std::uint16_t kNotKept = 0xFFFF;
constexpr std::uint32_t kNowhere = 0xFFFFFFFF;

constexpr float Sign(std::size_t corner, int axis) { return (corner >> axis & 1u) != 0 ? 1.0f : -1.0f; }

}  // namespace

void NearFieldMaker::Pool::Clear() {
  packets.clear();
  ids.clear();
}

void NearFieldMaker::Pool::Add(const TriangleCorners& triangle, std::uint32_t id) {
  const std::size_t lane = ids.size() % kLanes;
  if (lane == 0) packets.emplace_back();
  packets.back().Set(lane, triangle);
  ids.push_back(id);
}

std::shared_ptr<const NearField> NearFieldMaker::Make(BlockIndex block, std::shared_ptr<SurfaceLedger> ledger) {
  const double voxel_m = surfaces_.state().info().config.voxel_size_m, half_m = 0.5 * kBlockSide * voxel_m;
  const double radius_m = std::sqrt(3.0) * half_m;
  std::shared_ptr<NearField> field(new NearField(std::move(ledger)));
  field_ = field.get();
  field_->centre_m_ = BlockCorner(block, voxel_m) + Eigen::Vector3d::Constant(half_m);
  const std::vector<bool> all;
  const NearestSurface nearest = NearestSearch(surfaces_, all).Find(field_->centre_m_, NearField::kReach_m + radius_m);
  if (!nearest.is_any) {
    field_->is_far_ = true;
    field_->horizon_m_ = NearField::kReach_m + radius_m;
  } else {
    field_->half_ = static_cast<float>(half_m);
    field_->scale_ = static_cast<float>((1 << NearField::kLevels) / (2 * half_m));
    const double distance_m = (nearest.p_submap - nearest.point_submap).norm();
    field_->horizon_m_ = (distance_m + 2 * radius_m) * (1 + 1e-5) + 1e-5;
    const Transform& T = surfaces_.index().entries()[nearest.number].submap().info().T_map_submap;
    most_tolerance_ = static_cast<float>(NearField::kTolerance_vox * voxel_m);
    has_failed_ = false;
    field_->nearest_ = (T * nearest.point_submap - field_->centre_m_).cast<float>();
    Gather(field_->centre_m_, field_->Reach());
    nodes_.clear();
    leaves_.clear();
    exact_.clear();
    const std::uint32_t root = has_failed_ ? 0 : Divide(0, Eigen::Vector3f::Zero(), field_->half_);
    if (has_failed_) return nullptr;
    AddNormals();
    Lay(root);
    field_->nodes_.shrink_to_fit();
    field_->lists_.shrink_to_fit();
    field_->triangles_.shrink_to_fit();
  }
  field_->counted_bytes_ = field_->MemoryBytes();
  field_->ledger_->cell_bytes += field_->counted_bytes_;
  return field;
}

/// Gathers all triangles that are nearest to some point of the cell, and some more; never misses one.
void NearFieldMaker::Gather(const Eigen::Vector3d& centre_m, const FieldReach& reach) {
  pools_[0].Clear();
  numbers_.clear();
  needed_.clear();
  const SubmapIndex& index = surfaces_.index();
  index.tree().VisitWhere(reach.At(index.InTree(centre_m)), [&](std::size_t item) {
    const std::uint32_t number = index.tree().items()[item];
    const SubmapIndex::Entry& entry = index.entries()[number];
    const SubmapSurface& surface = surfaces_.surface(number);
    const Eigen::Vector3d middle_m = entry.ToSubmap(centre_m);
    const Eigen::Matrix3f turn = entry.submap().info().T_map_submap.linear().cast<float>();
    const FieldReach in_submap = reach.In(turn.transpose(), surface.InTree(middle_m));
    surface.tree().VisitWhere(in_submap, [&](std::size_t tile) {
      const TriangleTree& triangles = surfaces_.Triangles(number, tile);
      const Eigen::Vector3f middle = surface.InTile(middle_m, tile);
      triangles.tree().VisitWhere(in_submap.At(middle), [&](std::size_t leaf) {
        const std::size_t end = std::min((leaf + 1) * kLanes, triangles.num_triangles());
        for (std::size_t i = leaf * kLanes; i < end && !has_failed_; ++i) {
          TriangleCorners triangle = triangles.triangle(i);
          for (Eigen::Vector3f& corner : triangle) corner = turn * (corner - middle);
          pools_[0].Add(triangle, static_cast<std::uint32_t>(numbers_.size()));
          numbers_.push_back(number);
          needed_.push_back(triangles.NeededBy(i));
          has_failed_ = numbers_.size() > kMostCandidates;
        }
      });
    });
  });
  kept_.assign(numbers_.size(), kNotKept);
  alone_.clear();
}

/// Makes a node for the rest of a level's pool in one of its cubes: a leaf, or divided further.
std::uint32_t NearFieldMaker::Divide(std::size_t level, const Eigen::Vector3f& middle, float half) {
  const Pool& pool = pools_[level];
  Measure(pool, middle, half);
  float nearest = std::numeric_limits<float>::infinity();
  for (const Tangents& eight : tangents_)
    nearest = std::min(nearest, *std::min_element(eight.distance, std::end(eight.distance)));
  const float least = std::max(0.0f, nearest - std::sqrt(3.0f) * half);  // in the cube
  const float tolerance = std::min(most_tolerance_, static_cast<float>(NearField::kShare) * least);
  // Triangles that are nearest somewhere may be dropped only if all agree on the side of the cube, because the side
  // matters much more than the distance.
  constexpr int kRoundsAbove = 3, kRoundsInLeaf = 6;
  Thin(pool, middle, half, 0, kRoundsAbove);
  saved_ = alive_;
  const bool is_one_sided = tolerance > 0 && IsOneSided();
  const bool may_be_unsure = least > static_cast<float>(surfaces_.state().info().config.truncation_m);
  if (is_one_sided || (tolerance > 0 && may_be_unsure)) Thin(pool, middle, half, tolerance, kRoundsInLeaf);
  if (level == NearField::kLevels || NumAlive() <= (is_one_sided || may_be_unsure ? kFew : kSome)) {
    return MakeLeaf(pool, !is_one_sided && tolerance > 0 && may_be_unsure);
  }
  alive_ = saved_;
  Compact(pool, pools_[level + 1]);
  const auto node = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  for (std::size_t child = 0; child < 8 && !has_failed_; ++child) {
    const Eigen::Vector3f toward(Sign(child, 0), Sign(child, 1), Sign(child, 2));
    const std::uint32_t made = Divide(level + 1, middle + 0.5f * half * toward, 0.5f * half);
    nodes_[node][child] = made;
  }
  return node;
}

/// Which triangles have the whole cube in front of their plane, and which behind.
DHPMAP_ALWAYS_INLINE void NearFieldMaker::MeasureSides(const TrianglePacket& packet, const Float8 (&middle)[3],
                                                       float half, std::uint8_t& front, std::uint8_t& back) {
  const auto at = [&packet](int corner, int axis) -> const Float8& {
    return *reinterpret_cast<const Float8*>(packet.corners[corner][axis]);
  };
  const Float8 ab_x = at(1, 0) - at(0, 0), ab_y = at(1, 1) - at(0, 1), ab_z = at(1, 2) - at(0, 2);
  const Float8 ac_x = at(2, 0) - at(0, 0), ac_y = at(2, 1) - at(0, 1), ac_z = at(2, 2) - at(0, 2);
  const Float8 x = ab_y * ac_z - ab_z * ac_y, y = ab_z * ac_x - ab_x * ac_z, z = ab_x * ac_y - ab_y * ac_x;
  const Float8 height = x * (middle[0] - at(0, 0)) + y * (middle[1] - at(0, 1)) + z * (middle[2] - at(0, 2));
  const Float8 wide = (x < 0 ? -x : x) + (y < 0 ? -y : y) + (z < 0 ? -z : z);
  const Float8 reach = (half + 2 * kRounding_m) * wide;
  alignas(32) float heights[kLanes], reaches[kLanes];
  *reinterpret_cast<Float8*>(heights) = height;
  *reinterpret_cast<Float8*>(reaches) = reach;
  unsigned in_front = 0, behind = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    in_front |= static_cast<unsigned>(heights[lane] > reaches[lane]) << lane;
    behind |= static_cast<unsigned>(-heights[lane] > reaches[lane]) << lane;
  }
  front = static_cast<std::uint8_t>(in_front);
  back = static_cast<std::uint8_t>(behind);
}

DHPMAP_VECTOR_CLONES
void NearFieldMaker::Measure(const Pool& pool, const Eigen::Vector3f& middle, float half) {
  tangents_.resize(pool.packets.size());
  alive_.assign(pool.packets.size(), 0);
  front_.resize(pool.packets.size());
  back_.resize(pool.packets.size());
  const Float8 p[3] = {Float8{} + middle[0], Float8{} + middle[1], Float8{} + middle[2]};
  for (std::size_t i = 0; i < pool.packets.size(); ++i) {
    const TrianglePacket::Away away = pool.packets[i].AwayFrom(p);
    Tangents& eight = tangents_[i];
    *reinterpret_cast<Float8*>(eight.distance) = away.squared;
    unsigned alive = 0;
    alignas(32) float share[kLanes];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const float squared = eight.distance[lane];
      const bool is_there = squared >= 0;  // not NaN
      const float distance = std::sqrt(is_there ? squared : 0.0f);
      eight.distance[lane] = is_there ? distance : std::numeric_limits<float>::infinity();
      share[lane] = distance > kRounding_m ? 1 / distance : 0;
      alive |= static_cast<unsigned>(is_there) << lane;
    }
    const Float8 shares = *reinterpret_cast<const Float8*>(share);
    *reinterpret_cast<Float8*>(eight.slope[0]) = away.x * shares;
    *reinterpret_cast<Float8*>(eight.slope[1]) = away.y * shares;
    *reinterpret_cast<Float8*>(eight.slope[2]) = away.z * shares;
    alive_[i] = static_cast<std::uint8_t>(alive);
    MeasureSides(pool.packets[i], p, half, front_[i], back_[i]);
  }
}

bool NearFieldMaker::IsOneSided() const {
  bool are_front = true, are_back = true;
  for (std::size_t i = 0; i < alive_.size(); ++i) {
    are_front &= (alive_[i] & ~unsigned{front_[i]}) == 0;
    are_back &= (alive_[i] & ~unsigned{back_[i]}) == 0;
  }
  return are_front || are_back;
}

/// Drops triangles that others dominate, the nearest first.
void NearFieldMaker::Thin(const Pool& pool, const Eigen::Vector3f& middle, float half, float slack, int num_rounds) {
  picked_.assign(alive_.size(), 0);
  for (int round = 0; round < num_rounds; ++round) {
    float nearest = std::numeric_limits<float>::infinity();
    std::size_t at = 0, lane_at = 0, num_left = 0;
    for (std::size_t i = 0; i < alive_.size(); ++i) {
      for (unsigned left = alive_[i] & ~unsigned{picked_[i]}; left != 0; left &= left - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(left));
        ++num_left;
        if (tangents_[i].distance[lane] >= nearest) continue;
        nearest = tangents_[i].distance[lane];
        at = i, lane_at = lane;
      }
    }
    if (num_left == 0 || (num_left == 1 && round > 0)) return;
    picked_[at] = static_cast<std::uint8_t>(picked_[at] | 1u << lane_at);
    DropFarther(DistancesAtCorners(pool.packets[at].Get(lane_at), middle, half), half, slack);
    for (std::size_t i = 0; i < alive_.size(); ++i) alive_[i] |= picked_[i];
  }
}

DHPMAP_VECTOR_CLONES
NearFieldMaker::AtCorners NearFieldMaker::DistancesAtCorners(const TriangleCorners& triangle,
                                                             const Eigen::Vector3f& middle, float half) {
  TrianglePacket packet;
  alignas(32) float at[3][kLanes];
  for (std::size_t k = 0; k < kLanes; ++k) {
    packet.Set(k, triangle);
    for (int axis = 0; axis < 3; ++axis) at[axis][k] = middle[axis] + half * Sign(k, axis);
  }
  const Float8 p[3] = {*reinterpret_cast<const Float8*>(at[0]), *reinterpret_cast<const Float8*>(at[1]),
                       *reinterpret_cast<const Float8*>(at[2])};
  alignas(32) float squared[kLanes];
  *reinterpret_cast<Float8*>(squared) = packet.AwayFrom(p).squared;
  AtCorners distances;
  for (std::size_t k = 0; k < kLanes; ++k) distances[k] = std::sqrt(squared[k]);
  return distances;
}

DHPMAP_VECTOR_CLONES
void NearFieldMaker::DropFarther(const AtCorners& other, float half, float slack) {
  typedef std::int32_t Int8 __attribute__((vector_size(32), may_alias));
  typedef std::uint64_t Words __attribute__((vector_size(32), may_alias));
  const Int8 bits = {1, 2, 4, 8, 16, 32, 64, 128};
  for (std::size_t i = 0; i < tangents_.size(); ++i) {
    if (alive_[i] == 0) continue;
    const Tangents& eight = tangents_[i];
    const Float8 d = *reinterpret_cast<const Float8*>(eight.distance) - (kRounding_m - slack);
    const Float8 x = *reinterpret_cast<const Float8*>(eight.slope[0]) * half;
    const Float8 y = *reinterpret_cast<const Float8*>(eight.slope[1]) * half;
    const Float8 z = *reinterpret_cast<const Float8*>(eight.slope[2]) * half;
    const Float8 low = d - z, high = d + z;
    const Int8 nearer = (low - x - y < other[0]) | (low + x - y < other[1]) | (low - x + y < other[2]) |
                        (low + x + y < other[3]) | (high - x - y < other[4]) | (high + x - y < other[5]) |
                        (high - x + y < other[6]) | (high + x + y < other[7]);
    const Int8 kept = nearer & bits;
    const Words words = reinterpret_cast<const Words&>(kept);
    const std::uint64_t folded = words[0] | words[1] | words[2] | words[3];
    alive_[i] = static_cast<std::uint8_t>(alive_[i] & static_cast<unsigned>(folded | folded >> 32));
  }
}

std::size_t NearFieldMaker::NumAlive() const {
  std::size_t count = 0;
  for (const std::uint8_t alive : alive_) count += static_cast<std::size_t>(std::popcount(alive));
  return count;
}

void NearFieldMaker::Compact(const Pool& from, Pool& to) const {
  to.Clear();
  for (std::size_t i = 0; i < alive_.size(); ++i) {
    for (unsigned left = alive_[i]; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      to.Add(from.packets[i].Get(lane), from.ids[i * kLanes + lane]);
    }
  }
}

std::uint32_t NearFieldMaker::MakeLeaf(const Pool& pool, bool is_unsure) {
  Leaf leaf{.is_unsure = is_unsure, .first_exact = static_cast<std::uint32_t>(exact_.size())};
  for (std::size_t i = 0; i < saved_.size(); ++i) {
    for (unsigned left = saved_[i]; left != 0; left &= left - 1) {
      exact_.push_back(pool.ids[i * kLanes + static_cast<std::size_t>(std::countr_zero(left))]);
    }
  }
  leaf.num_exact = static_cast<std::uint32_t>(exact_.size()) - leaf.first_exact;
  List(pool, leaf);
  leaves_.push_back(leaf);
  return NearField::kLeaf | static_cast<std::uint32_t>(leaves_.size() - 1);
}

/// Lists the remaining triangles of a pool, the nearest first.
void NearFieldMaker::List(const Pool& pool, Leaf& leaf) {
  listed_.clear();
  for (std::size_t i = 0; i < alive_.size(); ++i) {
    for (unsigned left = alive_[i]; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      listed_.emplace_back(tangents_[i].distance[lane], static_cast<std::uint32_t>(i * kLanes + lane));
    }
  }
  if (listed_.size() > NearField::kMostInList) return;  // the list is too long: unknown
  std::sort(listed_.begin(), listed_.end());
  leaf.first = static_cast<std::uint32_t>(field_->lists_.size());
  leaf.count = static_cast<std::uint32_t>(listed_.size());
  has_failed_ = has_failed_ || leaf.first + leaf.count >= NearField::kMostListed;
  for (const auto& [distance, at] : listed_) {
    const std::uint16_t kept = Keep(pool.ids[at], pool.packets[at / kLanes].Get(at % kLanes));
    if (leaf.count == 1) {
      if (alone_[kept] != kNowhere) {
        leaf.first = alone_[kept];
        return;
      }
      alone_[kept] = leaf.first;
    }
    field_->lists_.push_back(kept);
  }
}

std::uint32_t NearFieldMaker::CodeOf(const Leaf& leaf) const {
  const auto begin = exact_.begin() + leaf.first_exact;
  const bool may_end = std::any_of(begin, begin + leaf.num_exact, [this](std::uint32_t id) { return may_end_[id]; });
  return NearField::kLeaf | (leaf.is_unsure ? NearField::kUnsure : 0) | leaf.count << NearField::kCountShift |
         (may_end ? NearField::kMayEnd : 0) | leaf.first;
}

/// The number of a triangle's submap, together with the submaps that the triangle needs.
std::uint16_t NearFieldMaker::NumberInField(std::uint32_t id) {
  const SubmapId submap = surfaces_.index().entries()[numbers_[id]].submap().id();
  const std::span<const SubmapId> needed = needed_[id];
  std::size_t position = 0;
  while (position < field_->submaps_.size() &&
         !(field_->submaps_[position] == submap && std::ranges::equal(field_->needed_[position], needed))) {
    ++position;
  }
  if (position == field_->submaps_.size()) {
    field_->submaps_.push_back(submap);
    field_->needed_.emplace_back(needed.begin(), needed.end());
  }
  return static_cast<std::uint16_t>(position);
}

std::uint16_t NearFieldMaker::Keep(std::uint32_t id, const TriangleCorners& triangle) {
  if (kept_[id] != kNotKept) return kept_[id];
  NearField::Triangle& kept = field_->triangles_.emplace_back();
  for (std::size_t i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) kept.corners[i][axis] = triangle[i][axis];
  }
  kept.submap = NumberInField(id);
  alone_.push_back(kNowhere);
  kept_[id] = static_cast<std::uint16_t>(field_->triangles_.size() - 1);
  return kept_[id];
}

/// Stores the upper levels as a grid, down to the level at which less than a quarter of the cubes are divided.
void NearFieldMaker::Lay(std::uint32_t root) {
  std::vector<std::uint32_t> level = {root}, next;
  int num_levels = 0;
  for (; num_levels < NearField::kLevels - 1; ++num_levels) {
    const auto num_divided =
        std::count_if(level.begin(), level.end(), [](auto at) { return (at & NearField::kLeaf) == 0; });
    if (num_divided == 0 || 4 * static_cast<std::size_t>(num_divided) < level.size()) break;
    next.clear();
    for (const std::uint32_t at : level) {
      for (std::size_t child = 0; child < 8; ++child)
        next.push_back((at & NearField::kLeaf) != 0 ? at : nodes_[at][child]);
    }
    level.swap(next);
  }
  field_->grid_shift_ = 3 * (NearField::kLevels - num_levels);
  for (std::uint32_t& at : level) at = Copy(at);
  field_->grid_ = std::move(level);
}

/// Copies the nodes below the grid.
std::uint32_t NearFieldMaker::Copy(std::uint32_t at) {
  if ((at & NearField::kLeaf) != 0) return CodeOf(leaves_[at & ~NearField::kLeaf]);
  const auto copy = static_cast<std::uint32_t>(field_->nodes_.size());
  field_->nodes_.emplace_back();
  for (std::size_t child = 0; child < 8; ++child) {
    const std::uint32_t below = Copy(nodes_[at][child]);
    field_->nodes_[copy][child] = below;
  }
  return copy;
}

/// Adds normals of corners and edges of the listed triangles, from all triangles around them, and which surfaces may
/// end there.
void NearFieldMaker::AddNormals() {
  may_end_.assign(numbers_.size(), false);
  std::vector<std::uint32_t> wanted;
  for (const std::uint32_t id : exact_) {
    if (may_end_[id]) continue;
    may_end_[id] = true;
    wanted.push_back(id);
  }
  const Pool& all = pools_[0];
  const auto triangle = [&all](std::uint32_t id) { return all.packets[id / kLanes].Get(id % kLanes); };
  FieldNormals normals(wanted.size());
  std::vector<FieldNormals::Places> places;
  places.reserve(wanted.size());
  for (const std::uint32_t id : wanted) places.push_back(normals.Want(triangle(id)));
  const auto surface_of = [this](std::uint32_t number) {
    constexpr std::uint32_t kOnMapGrid = 0xFFFFFFFE;  // counts as one surface for all its submaps
    return surfaces_.index().entries()[number].IsInMapFrame() ? kOnMapGrid : number;
  };
  for (const std::uint32_t id : all.ids) normals.Add(triangle(id), surface_of(numbers_[id]));
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    bool goes_on = true;
    for (std::size_t k = 0; k < 3; ++k) {
      goes_on = goes_on && normals.GoesOn(places[i].corners[k]) && normals.GoesOn(places[i].edges[k]);
    }
    may_end_[wanted[i]] = !goes_on;
    (void)NumberInField(wanted[i]);  // a change of it concerns the field, listed or not
    if (kept_[wanted[i]] == kNotKept) continue;
    NearField::Triangle& kept = field_->triangles_[kept_[wanted[i]]];
    for (std::size_t k = 0; k < 3; ++k) {
      kept.corner_normals[k] = NearField::PackNormal(normals.sums()[places[i].corners[k]]);
      kept.edge_normals[k] = NearField::PackNormal(normals.sums()[places[i].edges[k]]);
    }
  }
}

}  // namespace dhpmap
