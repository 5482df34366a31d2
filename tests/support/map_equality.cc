// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/map_equality.h"

#include <cmath>
#include <string>
#include <string_view>

#include "mapping/submap/submap_fields.h"

namespace dhpmap::testing {
namespace {

using ::testing::AssertionFailure;
using ::testing::AssertionResult;
using ::testing::AssertionSuccess;

AssertionResult BlocksAreEqual(const BlockEntry& a, const BlockEntry& b, double distance_tolerance_m,
                               double weight_tolerance) {
  if ((a.tsdf == nullptr) != (b.tsdf == nullptr)) return AssertionFailure() << "one has no TSDF layer";
  if ((a.labels == nullptr) != (b.labels == nullptr)) return AssertionFailure() << "one has no label layer";
  if (a.labels && !(*a.labels == *b.labels)) return AssertionFailure() << "label counts differ";
  if ((a.gone == nullptr) != (b.gone == nullptr)) return AssertionFailure() << "one was not looked through";
  if (a.gone && !(*a.gone == *b.gone)) return AssertionFailure() << "what was looked through differs";
  for (std::size_t i = 0; a.tsdf && i < kBlockVoxels; ++i) {
    if (a.tsdf->IsObserved(static_cast<int>(i)) != b.tsdf->IsObserved(static_cast<int>(i))) {
      return AssertionFailure() << "voxel " << i << " is observed in one only";
    }
    if (!a.tsdf->IsObserved(static_cast<int>(i))) continue;
    const double distance_error_m = std::abs(a.tsdf->distance_m[i] - b.tsdf->distance_m[i]);
    const double weight_error = std::abs(a.tsdf->weight[i] - b.tsdf->weight[i]);
    if (distance_error_m > distance_tolerance_m || weight_error > weight_tolerance * a.tsdf->weight[i]) {
      return AssertionFailure() << "voxel " << i << ": distance " << a.tsdf->distance_m[i] << " and "
                                << b.tsdf->distance_m[i] << ", weight " << a.tsdf->weight[i] << " and "
                                << b.tsdf->weight[i];
    }
    if (distance_tolerance_m == 0 && !(a.tsdf->color[i] == b.tsdf->color[i])) {
      return AssertionFailure() << "voxel " << i << ": colours differ";
    }
  }
  return AssertionSuccess();
}

/// But for when it last changed, and its confidence.
AssertionResult InfosAreEqual(const SubmapInfo& a, const SubmapInfo& b) {
  std::string differing;
  VisitSubmapFields([&](const auto& field) {
    const std::string_view name = field.name;
    if (name == "revision" || name == "instance_confidence") return;
    if (!IsSameValue(field.Of(a), field.Of(b))) differing.append(" ").append(name);
  });
  return differing.empty() ? AssertionSuccess() : AssertionFailure() << "rows differ:" << differing;
}

AssertionResult FreeSpacesAreEqual(const FreeSpace& a, const FreeSpace& b) {
  if (a.tiles().size() != b.tiles().size()) {
    return AssertionFailure() << a.tiles().size() << " and " << b.tiles().size() << " tiles of free space";
  }
  for (const FreeTileEntry& entry : a.tiles()) {
    const FreeTile* other = b.Find(entry.index);
    if (other == nullptr || !(*entry.tile == *other)) {
      return AssertionFailure() << "free space differs in tile " << entry.index.x << ' ' << entry.index.y << ' '
                                << entry.index.z;
    }
  }
  return AssertionSuccess();
}

AssertionResult VoxelsAreEqual(const Submap& a, const Submap& b, double distance_tolerance_m, double weight_tolerance) {
  if (a.blocks().size() != b.blocks().size()) {
    return AssertionFailure() << a.blocks().size() << " and " << b.blocks().size() << " blocks";
  }
  for (const BlockEntry& entry : a.blocks().entries()) {
    const BlockEntry* other = b.blocks().Find(entry.index);
    if (other == nullptr) return AssertionFailure() << "lacks a block";
    if (AssertionResult same = BlocksAreEqual(entry, *other, distance_tolerance_m, weight_tolerance); !same) {
      return AssertionFailure() << "block " << entry.index.x << ' ' << entry.index.y << ' ' << entry.index.z << ": "
                                << same.message();
    }
  }
  return AssertionSuccess();
}

}  // namespace

AssertionResult MapsAreEqual(const MapSnapshot& a, const MapSnapshot& b, double distance_tolerance_m,
                             double weight_tolerance) {
  if (a.submaps().size() != b.submaps().size()) {
    return AssertionFailure() << a.submaps().size() << " and " << b.submaps().size() << " submaps";
  }
  if (a.info().num_frames != b.info().num_frames) return AssertionFailure() << "frame counts differ";
  if (AssertionResult same = FreeSpacesAreEqual(*a.free_space(), *b.free_space()); !same) return same;
  if (AssertionResult same = FreeSpacesAreEqual(*a.vacated(), *b.vacated()); !same) return same << " (vacated)";
  for (std::size_t s = 0; s < a.submaps().size(); ++s) {
    const Submap &left = *a.submaps()[s], &right = *b.submaps()[s];
    AssertionResult same = InfosAreEqual(left.info(), right.info());
    if (same) same = VoxelsAreEqual(left, right, distance_tolerance_m, weight_tolerance);
    if (!same) return AssertionFailure() << "submap " << left.id().value << ": " << same.message();
  }
  return AssertionSuccess();
}

AssertionResult SubmapsAreEqual(const Submap& a, const Submap& b) {
  if (AssertionResult same = InfosAreEqual(a.info(), b.info()); !same) return same;
  const BoundingSphere &left = a.bounding_sphere(), &right = b.bounding_sphere();
  if (left.center_m != right.center_m || left.radius_m != right.radius_m) return AssertionFailure() << "spheres differ";
  return VoxelsAreEqual(a, b, 0, 0);
}

}  // namespace dhpmap::testing
