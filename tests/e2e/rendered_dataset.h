// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace dhpmap::testing {

/// Writes a flat data set: a camera goes along a small room with a wall, a floor and two things (a ball and a box) on
/// it. Ground-truth ids: 1 floor, 2 wall, 3 ball, 4 box; predictions are the same with ids that change from frame to
/// frame.
void WriteRenderedDataset(const std::filesystem::path& root, int num_frames);

}  // namespace dhpmap::testing
