// SPDX-License-Identifier: BSD-3-Clause
// The small files of data sets: read or refused. The first byte chooses the reader.
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "clients/datasets/camera_file.h"
#include "clients/datasets/file_reader.h"
#include "clients/datasets/kitti_calibration.h"
#include "clients/datasets/kitti_scan.h"
#include "clients/datasets/label_table.h"
#include "clients/datasets/segment_table.h"
#include "clients/datasets/tum_track.h"
#include "tests/fuzz/fuzz_target.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

/// A folder of this process, gone when it ends.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("dhpmap-fuzz-" + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void ReadOne(int which, const fs::path& file) {
  switch (which) {
    case 0: (void)ReadPose(file); break;
    case 1: (void)LabelTable::Read(file, RowNames::kClasses); break;
    case 2: (void)LabelTable::Read(file, RowNames::kInstances); break;
    case 3: (void)ReadSegmentTable(file, LabelTable{}); break;
    case 4: (void)ReadKittiCalibration(file); break;
    case 5: (void)ReadKittiTimes(file); break;
    case 6: (void)ReadTumImages(file); break;
    case 7: {
      const auto track = TumTrack::Read(file);
      if (track.ok()) (void)track->PoseAt(1'000'000'000);
      break;
    }
    case 8: {
      const std::array folders{file.parent_path()};
      (void)FindCameraFile(folders);
      break;
    }
    default: {
      const auto points = ReadKittiPoints(file);
      if (points.ok()) fuzz::Require(16 * points->size() == fs::file_size(file));
      break;
    }
  }
}

}  // namespace

std::vector<std::string> fuzz::Seeds() {
  const std::array<std::string, 10> files = {
      "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n",
      "InstanceID,ClassID,PanopticID,Name,Size\n0,0,0,Unknown,M\n53,53,0,wall,L\n55,55,1,person,M\n",
      "InstanceID,ClassID,PanopticID,MeshID,InfraredID,R,G,B,Name,Size\n1,12,1,5,5,10,20,30,ChairA_01_001,S\n"
      "2,12,1,6,6,11,21,31,ChairB_01_002,S\n3,4,0,7,7,12,22,32,Floor,L\n",
      R"([{"id":1,"isthing":true,"category_id":55,"instance_id":7,"score":0.9},{"id":2,"category_id":53}])",
      "P0: 1 0 0 0 0 1 0 0 0 0 1 0\nP2: 4 0 4 0 0 4 2 0 0 0 1 0\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n",
      "0.000000e+00\n1.5e-01\n",
      "# colour images\n1.0 rgb/1.0.png\n1.033333333 rgb/2.png\n",
      "# timestamp tx ty tz qx qy qz qw\n0.9 0 0 0 0 0 0 1\n1.05 1 2 3 0 0 0.7071 0.7071\n",
      "# width height fx fy cx cy\n4 3 2 2 1.5 1\n",
      std::string("\0\0\x80\x3f\0\0\0\x40\0\0\x40\x40\0\0\0\0", 16)};
  std::vector<std::string> seeds;
  for (std::size_t i = 0; i < files.size(); ++i) seeds.push_back(static_cast<char>(i) + files[i]);
  return seeds;
}

}  // namespace dhpmap

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const dhpmap::Folder folder;
  const auto file = folder.path() / "camera.txt";
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size - 1));
  dhpmap::ReadOne(data[0] % 10, file);
  return 0;
}
