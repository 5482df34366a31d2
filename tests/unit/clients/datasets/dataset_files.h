// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstring>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace dhpmap::testing {

inline void WriteText(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

template <typename T>
void WriteValues(const std::filesystem::path& path, const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  WriteText(path, bytes);
}

inline void WriteImage(const std::filesystem::path& path, const cv::Mat& image) {
  std::filesystem::create_directories(path.parent_path());
  cv::imwrite(path.string(), image);
}

inline constexpr const char* kIdentityPose = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";

/// One frame of the flat layout, 4 x 3 pixels: depth 2 m, red, ids 0 1 2 3 in each row.
inline void WriteFlatFrame(const std::filesystem::path& run, const std::string& id) {
  cv::Mat ids(3, 4, CV_8UC1);
  for (int i = 0; i < 12; ++i) ids.at<unsigned char>(i / 4, i % 4) = static_cast<unsigned char>(i % 4);
  WriteImage(run / (id + "_depth.tiff"), cv::Mat(3, 4, CV_32FC1, 2.0f));
  WriteImage(run / (id + "_color.png"), cv::Mat(3, 4, CV_8UC3, cv::Scalar(0, 0, 255)));
  WriteImage(run / (id + "_segmentation.png"), ids);
  WriteImage(run / (id + "_predicted.png"), ids);
  WriteText(run / (id + "_pose.txt"), kIdentityPose);
  WriteText(run / (id + "_labels.json"),
            R"([{"id":1,"isthing":true,"category_id":55,"instance_id":7,"score":0.9},)"
            R"({"id":2,"isthing":false,"category_id":53},{"id":3,"isthing":false,"category_id":0}])");
}

/// A flat data set of two frames, listed in reverse order of time.
inline void WriteFlatDataset(const std::filesystem::path& root) {
  WriteText(root / "run1/timestamps.csv",
            "ImageID,TimeStamp\n000001,1600000000200000000\n000000,1600000000100000000\n");
  WriteText(root / "run1/camera.txt", "# width height fx fy cx cy\n4 3 2 2 1.5 1\n");
  WriteText(
      root / "detectron_labels.csv",
      "InstanceID,ClassID,PanopticID,Name,Size\n0,0,0,Unknown,M\n1,1,1,things,M\n53,53,0,wall,L\n55,55,1,person,M\n");
  WriteText(root / "groundtruth_labels.csv",
            "InstanceID,ClassID,PanopticID,MeshID,InfraredID,R,G,B,Name,Size\n"
            "0,0,0,0,0,0,0,0,Unknown,M\n1,12,1,5,5,10,20,30,ChairA_01_001,S\n2,12,1,6,6,11,21,31,ChairB_01_002,S\n"
            "3,4,0,7,7,12,22,32,Floor,L\n");
  WriteFlatFrame(root / "run1", "000000");
  WriteFlatFrame(root / "run1", "000001");
}

/// A SemanticKITTI sequence of one scan with 5 points; the camera has 8 x 4 pixels and looks along the scanner's x.
inline void WriteKittiSequence(const std::filesystem::path& sequence) {
  // Three points in the image (left, middle, right), one behind the camera, one in the image that moves.
  WriteValues<float>(sequence / "velodyne/000000.bin",
                     {4, 2, 0, .1f, 4, 0, 0, .2f, 4, -1, 0, .3f, -4, 0, 0, .4f, 5, 0, 0, .5f});
  WriteValues<std::uint32_t>(sequence / "labels/000000.label", {10u | 3u << 16, 40u, 10u, 50u, 252u | 1u << 16});
  WriteText(sequence / "calib.txt",
            "P0: 1 0 0 0 0 1 0 0 0 0 1 0\nP2: 4 0 4 0 0 4 2 0 0 0 1 0\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n");
  WriteText(sequence / "poses.txt", "1 0 0 0 0 1 0 0 0 0 1 2\n");  // 2 m along the camera's z
  WriteText(sequence / "times.txt", "1.5e-01\n");
  WriteText(sequence / "detectron_labels.csv",
            "InstanceID,ClassID,PanopticID,Name,Size\n0,0,0,Unknown,M\n1,1,0,road,L\n14,14,1,car,M\n");
  cv::Mat ids(4, 8, CV_8UC1, cv::Scalar(1));
  ids.colRange(0, 4) = cv::Scalar(2);
  WriteImage(sequence / "image_2/000000.png", cv::Mat(4, 8, CV_8UC3, cv::Scalar(255, 0, 0)));
  WriteImage(sequence / "image_2/000000_predicted2.png", ids);
  WriteText(sequence / "image_2/000000_labels.json",
            R"([{"id":1,"category_id":1},{"id":2,"category_id":14,"score":0.5}])");
}

inline void WriteSevenScenes(const std::filesystem::path& root) {
  WriteImage(root / "seq-02/frame-000000.depth.png", cv::Mat(480, 640, CV_16UC1, cv::Scalar(1500)));
  cv::Mat depth(480, 640, CV_16UC1, cv::Scalar(1500));
  depth.at<unsigned short>(0, 0) = 65535;
  WriteImage(root / "seq-01/frame-000003.depth.png", depth);
  WriteImage(root / "seq-01/frame-000003.color.png", cv::Mat(480, 640, CV_8UC3, cv::Scalar(0, 255, 0)));
  WriteText(root / "seq-01/frame-000003.pose.txt", kIdentityPose);
}

/// Depth images at 10.00, 10.03 and 20 s; colour and poses near the first two only.
inline void WriteTum(const std::filesystem::path& root) {
  WriteText(root / "depth.txt", "# depth maps\n10.000000 depth/a.png\n10.030000 depth/b.png\n20.000000 depth/c.png\n");
  WriteText(root / "rgb.txt", "# color images\n10.010000 rgb/x.png\n10.029000 rgb/y.png\n");
  WriteText(root / "groundtruth.txt",
            "# timestamp tx ty tz qx qy qz qw\n9.990000 0 0 0 0 0 0 1\n10.010000 1 2 4 0 0 0.7071067811865476 "
            "0.7071067811865476\n"
            "10.040000 4 0 0 0 0 0 2\n");
  for (const char* name : {"depth/a.png", "depth/b.png", "depth/c.png"}) {
    WriteImage(root / name, cv::Mat(480, 640, CV_16UC1, cv::Scalar(5000)));
  }
  for (const char* name : {"rgb/x.png", "rgb/y.png"})
    WriteImage(root / name, cv::Mat(480, 640, CV_8UC3, cv::Scalar(9, 9, 9)));
}

}  // namespace dhpmap::testing
