// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/apartment_change.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "clients/simulator/camera_path.h"
#include "clients/simulator/random.h"
#include "clients/simulator/rounded_point.h"

namespace dhpmap::simulator {
namespace {

using Box = Eigen::AlignedBox3d;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t kChangeStream = 3;
constexpr double kLeast_m = 0.2, kThinnest_m = 0.12, kMost_m = 1.6, kWidest_m = 1.6;
constexpr double kLeastShift_m = 0.7, kMostShift_m = 2.5, kStep_m = 0.25;
constexpr double kGap_m = 0.06;  ///< to neighbouring objects

std::vector<Box> BoxesOf(const ApartmentScene& scene) {
  std::vector<Box> boxes(scene.instances().size());
  for (const Solid& solid : scene.solids()) boxes[solid.instance].extend(solid.Bounds());
  return boxes;
}

/// Whether the instance is an obstacle: not what things stand on or below. Walls are checked by the room.
bool IsInTheWay(const Instance& instance) {
  switch (instance.object_class) {
    case ObjectClass::kUnknown:
    case ObjectClass::kWall:
    case ObjectClass::kFloor:
    case ObjectClass::kCeiling:
    case ObjectClass::kRug: return false;
    default: return true;
  }
}

Box Grown(const Box& box, double by_m) {
  const Eigen::Vector3d by = Eigen::Vector3d::Constant(by_m);
  return {box.min() - by, box.max() + by};
}

class Chooser {
 public:
  explicit Chooser(const ApartmentScene& scene) : boxes_(BoxesOf(scene)) {
    for (const Solid& solid : scene.solids()) {
      if (IsInTheWay(scene.instances()[solid.instance])) solids_.push_back({solid.instance, solid.Bounds()});
    }
    const CameraPath path;
    constexpr int kPoses = 600;
    for (int i = 0; i < kPoses; ++i) eyes_.push_back(path.PoseAt(static_cast<double>(i) / kPoses).translation());
  }

  /// Updates the obstacles after a change.
  void Move(const Change& change) {
    if (change.shift_m) boxes_[change.instance].translate(*change.shift_m);
    std::erase_if(solids_, [&](const Part& part) { return part.instance == change.instance && !change.shift_m; });
    for (Part& part : solids_) {
      if (part.instance == change.instance) part.box.translate(*change.shift_m);
    }
  }

  /// Whether a thing is free-standing, with nothing on it, in it or above it.
  [[nodiscard]] bool MayGo(const Instance& instance) const {
    const Box& box = boxes_[instance.id];
    if (!InfoOf(instance.object_class).is_thing || box.isEmpty()) return false;
    const Eigen::Vector3d size = box.sizes();
    if (size.maxCoeff() < kLeast_m || size.minCoeff() < kThinnest_m) return false;
    if (size.z() > kMost_m || std::hypot(size.x(), size.y()) > kWidest_m) return false;
    const Eigen::Vector3d side(0.01, 0.01, 0);
    return IsFree({box.min() - side + Eigen::Vector3d(0, 0, 0.02), box.max() + side + Eigen::Vector3d(0, 0, 0.02)},
                  instance.id);
  }
  /// Whether it also stands on the floor.
  [[nodiscard]] bool MayMove(std::uint8_t instance) const { return boxes_[instance].min().z() <= 0.05; }

  [[nodiscard]] std::optional<Eigen::Vector3d> NewPlace(std::uint8_t instance, Random& random) const {
    std::vector<Eigen::Vector3d> places;
    const int steps = static_cast<int>(kMostShift_m / kStep_m);
    for (int y = -steps; y <= steps; ++y) {
      for (int x = -steps; x <= steps; ++x) {
        const Eigen::Vector3d shift(x * kStep_m, y * kStep_m, 0);
        const double far_m = shift.norm();
        if (far_m >= kLeastShift_m && far_m <= kMostShift_m && MayStand(instance, shift)) places.push_back(shift);
      }
    }
    if (places.empty()) return std::nullopt;
    return places[random.Below(static_cast<std::uint32_t>(places.size()))];
  }

 private:
  [[nodiscard]] bool IsFree(const Box& box, std::uint8_t own) const {
    return std::none_of(solids_.begin(), solids_.end(),
                        [&](const Part& part) { return part.instance != own && part.box.intersects(box); });
  }

  [[nodiscard]] bool MayStand(std::uint8_t instance, const Eigen::Vector3d& shift) const {
    const Box& before = boxes_[instance];
    const Box box = Grown(Box(before).translate(shift), kGap_m);
    if (box.intersects(before) || !IsFree(box, instance)) return false;
    const auto is_inside = [](const Room& room, const Box& b) {
      return b.min().x() >= room.min_x_m && b.max().x() <= room.max_x_m && b.min().y() >= room.min_y_m &&
             b.max().y() <= room.max_y_m;
    };
    const auto rooms = ApartmentScene::Rooms();
    const bool is_in_its_room = std::any_of(rooms.begin(), rooms.end(), [&](const Room& room) {
      return is_inside(room, Grown(before, -0.1)) && is_inside(room, box);
    });
    if (!is_in_its_room) return false;
    return std::none_of(eyes_.begin(), eyes_.end(), [&](const Eigen::Vector3d& eye) {
      return box.exteriorDistance(Eigen::Vector3d(eye.x(), eye.y(), box.center().z())) < CameraPath::kClearance_m;
    });
  }

  /// A solid that may be an obstacle.
  struct Part {
    std::uint8_t instance;
    Box box;
  };

  std::vector<Box> boxes_;  ///< by instance
  std::vector<Part> solids_;
  std::vector<Eigen::Vector3d> eyes_;
};

}  // namespace

Result<std::vector<Change>> ChooseChanges(const ApartmentScene& scene, int count, std::uint64_t seed) {
  Chooser chooser(scene);
  Random random(seed, 0, kChangeStream);
  std::vector<std::uint8_t> candidates;
  for (const Instance& instance : scene.instances()) {
    if (chooser.MayGo(instance)) candidates.push_back(instance.id);
  }
  for (std::size_t i = candidates.size(); i > 1; --i) {
    std::swap(candidates[i - 1], candidates[random.Below(static_cast<std::uint32_t>(i))]);
  }
  std::vector<Change> changes;
  const auto has_changed = [&changes](std::uint8_t id) {
    return std::any_of(changes.begin(), changes.end(), [id](const Change& c) { return c.instance == id; });
  };
  const auto wanted = static_cast<std::size_t>(count);
  for (const std::uint8_t id : candidates) {
    if (changes.size() == wanted) break;
    if (!chooser.MayMove(id)) continue;
    const Change change{.instance = id, .shift_m = chooser.NewPlace(id, random)};
    if (!change.shift_m) continue;
    chooser.Move(change);
    changes.push_back(change);
  }
  const std::size_t num_moved = changes.size();
  for (const std::uint8_t id : candidates) {
    if (changes.size() < 2 * wanted && !has_changed(id)) changes.push_back({.instance = id, .shift_m = std::nullopt});
  }
  if (changes.size() < 2 * wanted) {
    const std::size_t most = std::min(num_moved, candidates.size() / 2);
    return InvalidArgument("the recording cannot be made")
        .WithViolation("change", "no more than " + std::to_string(most) + " things can be moved and taken away");
  }
  std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.instance < b.instance; });
  return changes;
}

ApartmentScene Changed(const ApartmentScene& scene, const std::vector<Change>& changes) {
  std::vector<Solid> solids;
  for (Solid solid : scene.solids()) {
    const auto change =
        std::find_if(changes.begin(), changes.end(), [&](const Change& c) { return c.instance == solid.instance; });
    if (change != changes.end() && !change->shift_m) continue;
    if (change != changes.end()) solid.center_m += *change->shift_m;
    solids.push_back(solid);
  }
  return scene.WithSolids(std::move(solids));
}

std::string ChangesJson(const ApartmentScene& scene, const std::vector<Change>& changes, int first_frame_after) {
  const std::vector<Box> boxes = BoxesOf(scene);
  Json list = Json::array();
  for (const Change& change : changes) {
    const Instance& instance = scene.instances()[change.instance];
    const Box& box = boxes[change.instance];
    Json entry = {{"id", instance.id},
                  {"class", InfoOf(instance.object_class).name},
                  {"name", instance.name},
                  {"change", change.shift_m ? "moved" : "gone"},
                  {"box_m", {{"min", RoundedPoint(box.min())}, {"max", RoundedPoint(box.max())}}}};
    if (change.shift_m) entry["moved_by_m"] = RoundedPoint(*change.shift_m);
    list.push_back(std::move(entry));
  }
  return Json{{"first_frame_after", first_frame_after}, {"changes", std::move(list)}}.dump(1) + "\n";
}

}  // namespace dhpmap::simulator
