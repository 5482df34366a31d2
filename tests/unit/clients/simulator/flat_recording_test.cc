// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/flat_recording.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <vector>

#include "clients/datasets/dataset.h"
#include "clients/datasets/open_dataset.h"
#include "clients/simulator/camera_path.h"
#include "clients/simulator/renderer.h"
#include "tests/support/scenes.h"
#include "tests/unit/clients/simulator/recorded_apartment.h"

namespace dhpmap::simulator {
namespace {

namespace fs = std::filesystem;
using testing::Apartment;
using testing::BytesOfFile;

RecordingOptions SmallRecording(const fs::path& directory) {
  return {.directory = directory, .num_frames = 5, .width_px = 96, .height_px = 72};
}

Result<std::vector<InstanceView>> Record(const RecordingOptions& options, int num_threads = 1) {
  ThreadPool threads(num_threads);
  return RecordApartment(Apartment(), options, threads);
}

std::map<std::string, std::string> AllFiles(const fs::path& root) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.is_regular_file()) files[fs::relative(entry.path(), root).string()] = BytesOfFile(entry.path());
  }
  return files;
}

PanopticFrame FrameOf(Dataset& dataset, std::size_t index) {
  const Result<DatasetFrame> raw = dataset.Read(index);
  EXPECT_TRUE(raw.ok()) << raw.status().ToString();
  const Result<PanopticFrame> frame = DecodeFrame(*raw, dataset.has_persistent_ids());
  EXPECT_TRUE(frame.ok()) << frame.status().ToString();
  return *frame;
}

TEST(FlatRecording, GroundTruthIsReadBackAsRendered) {
  testing::TempDir folder;
  RecordingOptions options = SmallRecording(folder.path());
  options.has_depth_noise = false;
  ASSERT_TRUE(Record(options).ok());
  const auto dataset = OpenDataset(folder.path(), kAnyFormat, LabelSource::kGroundTruth);
  ASSERT_TRUE(dataset.ok()) << dataset.status().ToString();
  ASSERT_EQ((*dataset)->num_frames(), 5u);
  for (int i = 0; i < 5; ++i) {
    const RenderedFrame rendered =
        Renderer(Apartment()).Render(FlatLayoutCamera(96, 72), CameraPath().PoseOfFrame(i, 5));
    const PanopticFrame frame = FrameOf(**dataset, static_cast<std::size_t>(i));
    ASSERT_TRUE(frame.camera);
    EXPECT_EQ(frame.camera->camera.fx_px, 48);
    EXPECT_EQ(frame.camera->camera.cy_px, 36);
    EXPECT_EQ(frame.camera->depth_m, rendered.depth_m);
    EXPECT_TRUE(frame.T_map_sensor.isApprox(rendered.T_map_camera, 1e-7));
    for (std::size_t p = 0; p < rendered.instances.size(); ++p) {
      ASSERT_EQ(frame.camera->segments[p], rendered.instances[p]);
      const Color color = frame.camera->color[p];
      ASSERT_EQ((Rgb{color.r, color.g, color.b}), rendered.color[p]);
    }
    const auto label_set = LabelSet::Create((*dataset)->label_classes());
    ASSERT_TRUE(label_set.ok());
    EXPECT_TRUE(ValidateFrame(frame, *label_set).ok());
  }
}

TEST(FlatRecording, GroundTruthTableTellsClassesAndKinds) {
  testing::TempDir folder;
  ASSERT_TRUE(Record(SmallRecording(folder.path())).ok());
  const auto dataset = OpenDataset(folder.path(), "flat", LabelSource::kGroundTruth);
  ASSERT_TRUE(dataset.ok());
  std::map<int, LabelClass> classes;
  for (const LabelClass& label_class : (*dataset)->label_classes()) classes[label_class.id.value] = label_class;
  std::map<std::uint32_t, int> class_of;
  for (const SegmentInfo& segment : FrameOf(**dataset, 0).segments)
    class_of[segment.id.value] = segment.class_id->value;
  for (const Instance& instance : Apartment().instances()) {
    if (instance.id == 0) continue;
    ASSERT_EQ(class_of[instance.id], static_cast<int>(instance.object_class)) << instance.name;
    const LabelClass& label_class = classes[static_cast<int>(instance.object_class)];
    EXPECT_EQ(label_class.name, InfoOf(instance.object_class).name);
    EXPECT_EQ(label_class.panoptic == Panoptic::kThing, InfoOf(instance.object_class).is_thing);
  }
}

TEST(FlatRecording, PredictionsAreReadBackWithTheirTable) {
  testing::TempDir folder;
  ASSERT_TRUE(Record(SmallRecording(folder.path())).ok());
  const auto dataset = OpenDataset(folder.path(), "flat", LabelSource::kPredicted);
  ASSERT_TRUE(dataset.ok()) << dataset.status().ToString();
  const auto label_set = LabelSet::Create((*dataset)->label_classes());
  ASSERT_TRUE(label_set.ok());
  EXPECT_EQ(label_set->classes().size(), ObjectClasses().size() - 1);  // all but "unknown"
  for (std::size_t i = 0; i < (*dataset)->num_frames(); ++i) {
    const PanopticFrame frame = FrameOf(**dataset, i);
    EXPECT_FALSE(frame.segments.empty());
    EXPECT_TRUE(ValidateFrame(frame, *label_set).ok()) << ValidateFrame(frame, *label_set).ToString();
  }
}

TEST(FlatRecording, SameOptionsWriteTheSameBytesWhateverTheThreads) {
  testing::TempDir one, three, other_seed;
  ASSERT_TRUE(Record(SmallRecording(one.path()), 1).ok());
  ASSERT_TRUE(Record(SmallRecording(three.path()), 3).ok());
  const auto files = AllFiles(one.path());
  EXPECT_EQ(files.size(), 5u * 6 + 5);
  EXPECT_EQ(files, AllFiles(three.path()));
  RecordingOptions options = SmallRecording(other_seed.path());
  options.seed = 2;
  ASSERT_TRUE(Record(options).ok());
  const auto others = AllFiles(other_seed.path());
  EXPECT_NE(files.at("run1/000000_depth.tiff"), others.at("run1/000000_depth.tiff"));
  EXPECT_NE(files.at("run1/000000_predicted.png"), others.at("run1/000000_predicted.png"));
  EXPECT_EQ(files.at("run1/000000_color.png"), others.at("run1/000000_color.png"));
}

TEST(FlatRecording, AFrameIsTheSameWithoutThoseBeforeIt) {
  testing::TempDir all, late;
  ASSERT_TRUE(Record(SmallRecording(all.path())).ok());
  RecordingOptions options = SmallRecording(late.path());
  options.first_frame = 3;
  options.run = "run2";
  ASSERT_TRUE(Record(options).ok());
  EXPECT_FALSE(fs::exists(late.path() / "run2/000002_color.png"));
  for (const char* file : {"000003_depth.tiff", "000004_predicted.png", "000004_labels.json"}) {
    EXPECT_EQ(BytesOfFile(all.path() / "run1" / file), BytesOfFile(late.path() / "run2" / file)) << file;
  }
}

TEST(FlatRecording, TruthTellsPointsOnThingsInView) {
  testing::TempDir folder;
  RecordingOptions options = SmallRecording(folder.path());
  options.num_frames = 10;
  ASSERT_TRUE(Record(options).ok());
  const auto truth = nlohmann::json::parse(BytesOfFile(folder.path() / "truth.json"));
  ASSERT_GT(truth.size(), 30u);
  for (const auto& entry : truth) {
    const auto id = entry["id"].get<std::size_t>();
    const Instance& instance = Apartment().instances()[id];
    EXPECT_EQ(entry["name"], instance.name);
    EXPECT_EQ(entry["class"], InfoOf(instance.object_class).name);
    EXPECT_EQ(entry["kind"], InfoOf(instance.object_class).is_thing ? "thing" : "stuff");
    const Eigen::Vector3d p(entry["point_m"][0], entry["point_m"][1], entry["point_m"][2]);
    EXPECT_NEAR(Apartment().Distance(p), 0, 3e-4) << instance.name;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(p[axis], entry["box_m"]["min"][static_cast<std::size_t>(axis)].get<double>() - 1e-3);
      EXPECT_LE(p[axis], entry["box_m"]["max"][static_cast<std::size_t>(axis)].get<double>() + 1e-3);
    }
  }
}

TEST(FlatRecording, TruthTellsTheBoxAroundWhatPixelsShow) {
  testing::TempDir folder;
  RecordingOptions options = SmallRecording(folder.path());
  options.num_frames = 10;
  ASSERT_TRUE(Record(options).ok());
  std::map<std::size_t, std::vector<Eigen::Vector3d>> points_m;
  for (int i = 0; i < 10; ++i) {
    const PinholeCamera camera = FlatLayoutCamera(96, 72);
    const RenderedFrame frame = Renderer(Apartment()).Render(camera, CameraPath().PoseOfFrame(i, 10));
    for (int v = 0; v < 72; ++v) {
      for (int u = 0; u < 96; ++u) {
        const auto pixel = static_cast<std::size_t>(96 * v + u);
        const Eigen::Vector3d looking((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1);
        points_m[frame.instances[pixel]].push_back(frame.T_map_camera *
                                                   (static_cast<double>(frame.depth_m[pixel]) * looking));
      }
    }
  }
  const auto truth = nlohmann::json::parse(BytesOfFile(folder.path() / "truth.json"));
  ASSERT_GT(truth.size(), 30u);
  for (const auto& entry : truth) {
    const auto& box = entry["seen_box_m"];
    const double yaw_rad = box["yaw_deg"].get<double>() * std::numbers::pi / 180;
    const Eigen::Matrix3d back = Eigen::AngleAxisd(-yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    Eigen::Vector3d reach = Eigen::Vector3d::Zero(), center, size;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      center[static_cast<int>(axis)] = box["center"][axis].get<double>();
      size[static_cast<int>(axis)] = box["size"][axis].get<double>();
    }
    for (const Eigen::Vector3d& p : points_m[entry["id"].get<std::size_t>()]) {
      reach = reach.cwiseMax((back * (p - center)).cwiseAbs());
    }
    EXPECT_LT((2 * reach - size).cwiseAbs().maxCoeff(), 4e-3) << entry["name"];
  }
}

TEST(FlatRecording, RefusesWhatItCannotMake) {
  testing::TempDir folder;
  RecordingOptions options = SmallRecording(folder.path());
  options.num_frames = 0;
  options.width_px = 3;
  options.run = "../up";
  options.noise_level = std::nan("");
  const Status status = Record(options).status();
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(status.violations().size(), 4u);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(FlatRecording, SaysWhereItCannotWrite) {
  testing::TempDir folder;
  std::ofstream(folder.path() / "file") << "in the way";
  const Status status = Record(SmallRecording(folder.path() / "file")).status();
  EXPECT_EQ(status.code(), StatusCode::kUnavailable);
  EXPECT_FALSE(fs::exists(folder.path() / "truth.json"));
}

}  // namespace
}  // namespace dhpmap::simulator
