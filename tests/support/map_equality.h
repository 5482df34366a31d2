// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "mapping/map/map.h"

namespace dhpmap::testing {

/// Whether two maps hold the same submaps, labels, counts and free space, and the same geometry to within
/// `distance_tolerance_m` (and as fraction, `weight_tolerance`). Both 0: bit for bit.
::testing::AssertionResult MapsAreEqual(const MapSnapshot& a, const MapSnapshot& b, double distance_tolerance_m = 0,
                                        double weight_tolerance = 0);

/// Of two submaps: rows, spheres and voxels, bit for bit.
::testing::AssertionResult SubmapsAreEqual(const Submap& a, const Submap& b);

}  // namespace dhpmap::testing
