// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace dhpmap::testing {

/// Writes a flat data set: a camera goes along a small room with a wall, a floor and two things (a ball and a box) on
/// it. Ground-truth ids: 1 floor, 2 wall, 3 ball, 4 box; predictions are the same with ids that change from frame to
/// frame.
void WriteRenderedDataset(const std::filesystem::path& root, int num_frames);

/// Frame `index` of such a data set, held back: who maps it goes no farther, until Release or the end of life.
class HeldFrame {
 public:
  HeldFrame(const std::filesystem::path& root, int index);
  ~HeldFrame() { Release(); }
  HeldFrame(const HeldFrame&) = delete;
  HeldFrame& operator=(const HeldFrame&) = delete;
  void Release();

 private:
  std::filesystem::path file_;
  std::string content_;
  int pipe_ = -1;  ///< in the place of `file_`; both of its ends
};

}  // namespace dhpmap::testing
