// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/apartment_change.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "clients/simulator/flat_recording.h"
#include "tests/support/scenes.h"
#include "tests/unit/clients/simulator/recorded_apartment.h"

namespace dhpmap::simulator {
namespace {

using testing::Apartment;
using testing::BytesOfFile;

std::vector<Change> Choose(int count, std::uint64_t seed) {
  const auto changes = ChooseChanges(Apartment(), count, seed);
  EXPECT_TRUE(changes.ok()) << changes.status().ToString();
  return changes.ok() ? *changes : std::vector<Change>();
}

Eigen::AlignedBox3d BoxOf(const ApartmentScene& scene, std::uint8_t instance) {
  Eigen::AlignedBox3d box;
  for (const Solid& solid : scene.solids()) {
    if (solid.instance == instance) box.extend(solid.Bounds());
  }
  return box;
}

TEST(ApartmentChange, MovesAndTakesAwayAsManyThingsAsAskedForAndLeavesTheOthers) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const std::vector<Change> changes = Choose(3, seed);
    ASSERT_EQ(changes.size(), 6u);
    EXPECT_EQ(std::count_if(changes.begin(), changes.end(), [](const Change& c) { return c.shift_m.has_value(); }), 3);
    const ApartmentScene after = Changed(Apartment(), changes);
    for (const Instance& instance : Apartment().instances()) {
      if (instance.id == 0) continue;
      const Eigen::AlignedBox3d before = BoxOf(Apartment(), instance.id), now = BoxOf(after, instance.id);
      const auto change =
          std::find_if(changes.begin(), changes.end(), [&](const Change& c) { return c.instance == instance.id; });
      if (change == changes.end()) {
        EXPECT_TRUE(before.isApprox(now)) << instance.name;
      } else if (!change->shift_m) {
        EXPECT_TRUE(now.isEmpty()) << instance.name;
      } else {
        EXPECT_FALSE(now.intersects(before)) << instance.name;
        EXPECT_NEAR((now.center() - before.center() - *change->shift_m).norm(), 0, 1e-9);
        EXPECT_GT(Changed(Apartment(), {{instance.id, std::nullopt}}).Distance(now.center()), 0) << "in nothing else";
      }
    }
  }
}

TEST(ApartmentChange, TheSameSeedChoosesTheSameAndTooManyAreRefused) {
  const std::vector<Change> once = Choose(2, 7), again = Choose(2, 7);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].instance, again[i].instance);
    EXPECT_EQ(once[i].shift_m, again[i].shift_m);
  }
  const auto refused = ChooseChanges(Apartment(), 90, 1);
  EXPECT_EQ(refused.status().code(), StatusCode::kInvalidArgument);
  EXPECT_TRUE(Choose(0, 1).empty());
}

TEST(ApartmentChange, ARecordingOfTwoWalksBeginsAsThatOfOneAndSaysWhatHasChanged) {
  testing::TempDir once, twice;
  RecordingOptions options{.directory = once.path(), .num_frames = 3, .width_px = 64, .height_px = 48};
  ThreadPool threads(1);
  ASSERT_TRUE(RecordApartment(Apartment(), options, threads).ok());
  options.directory = twice.path();
  options.num_changed = 2;
  ASSERT_TRUE(RecordApartment(Apartment(), options, threads).ok());
  for (const char* file : {"run1/000002_depth.tiff", "run1/000002_segmentation.png", "run1/000000_pose.txt"}) {
    EXPECT_EQ(BytesOfFile(once.path() / file), BytesOfFile(twice.path() / file));
  }
  EXPECT_EQ(BytesOfFile(twice.path() / "run1/000002_pose.txt"), BytesOfFile(twice.path() / "run1/000005_pose.txt"));
  EXPECT_FALSE(std::filesystem::exists(once.path() / "changes.json"));
  const auto json = nlohmann::json::parse(BytesOfFile(twice.path() / "changes.json"));
  EXPECT_EQ(json["first_frame_after"], 3);
  const std::vector<Change> changes = Choose(2, options.seed);
  ASSERT_EQ(json["changes"].size(), changes.size());
  for (std::size_t i = 0; i < changes.size(); ++i) {
    EXPECT_EQ(json["changes"][i]["id"], changes[i].instance);
    EXPECT_EQ(json["changes"][i]["change"], changes[i].shift_m ? "moved" : "gone");
  }
}

}  // namespace
}  // namespace dhpmap::simulator
