// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/connected_objects.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mapping/base/grid.h"

namespace dhpmap::evaluator {
namespace {

/// Cells of one class in disjoint sets of connected cells (union-find).
class Islands {
 public:
  std::uint32_t Add(BlockIndex cell) {
    const auto [it, is_new] = numbers_.try_emplace(cell, static_cast<std::uint32_t>(parents_.size()));
    if (is_new) parents_.push_back(it->second);
    return it->second;
  }

  void JoinNeighbours() {
    for (const auto& [c, number] : numbers_) {
      for (int n = 14; n < 27; ++n) {  // half of the neighbours suffices: the relation is symmetric
        const auto it = numbers_.find({c.x + n % 3 - 1, c.y + n / 3 % 3 - 1, c.z + n / 9 - 1});
        if (it != numbers_.end()) Join(number, it->second);
      }
    }
  }

  std::uint32_t RootOf(std::uint32_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }

 private:
  void Join(std::uint32_t a, std::uint32_t b) {
    a = RootOf(a), b = RootOf(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

  std::unordered_map<BlockIndex, std::uint32_t, BlockIndexHash> numbers_;
  std::vector<std::uint32_t> parents_;
};

class ConnectedObjects final : public MappingSystem {
 public:
  ConnectedObjects(std::string name, const SystemSetup& setup, std::unique_ptr<MappingSystem> system)
      : name_(std::move(name)), setup_(setup), system_(std::move(system)) {}

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] bool has_instances() const override { return true; }
  Status Integrate(const PanopticFrame& frame) override { return system_->Integrate(frame); }
  void Finish() override { system_->Finish(); }
  [[nodiscard]] LabelledSurface Surface() const override {
    LabelledSurface surface = system_->Surface();
    const int gap_vox = std::max(1, setup_.config.tracking.split_gap_vox);
    NumberConnectedObjects(*setup_.label_set, setup_.config.voxel_size_m, gap_vox, surface);
    return surface;
  }
  [[nodiscard]] SystemTimes times() const override { return system_->times(); }

 private:
  std::string name_;
  SystemSetup setup_;
  std::unique_ptr<MappingSystem> system_;
};

}  // namespace

void NumberConnectedObjects(const LabelSet& label_set, double voxel_size_m, int gap_vox, LabelledSurface& surface) {
  Mesh& mesh = surface.mesh;
  const double cell_m = voxel_size_m * gap_vox;
  std::map<std::uint16_t, Islands> of_class;
  std::vector<std::uint32_t> cells(mesh.vertices_m.size(), 0);
  mesh.instances.assign(mesh.vertices_m.size(), 0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const LabelClass* label_class = label_set.Find(ClassId(mesh.classes[i]));
    if (mesh.classes[i] == 0 || label_class == nullptr || label_class->panoptic != Panoptic::kThing) continue;
    const VoxelIndex at = VoxelAt(mesh.vertices_m[i].cast<double>(), cell_m);
    cells[i] = of_class[mesh.classes[i]].Add({at.x, at.y, at.z});
  }
  for (auto& [class_id, islands] : of_class) islands.JoinNeighbours();
  std::map<std::pair<std::uint16_t, std::uint32_t>, std::uint32_t> ids;  // by class and root
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto islands = of_class.find(mesh.classes[i]);
    if (islands == of_class.end()) continue;
    const auto root = std::pair(mesh.classes[i], islands->second.RootOf(cells[i]));
    mesh.instances[i] = ids.try_emplace(root, static_cast<std::uint32_t>(ids.size() + 1)).first->second;
  }
}

std::unique_ptr<MappingSystem> WithConnectedObjects(std::string name, const SystemSetup& setup,
                                                    std::unique_ptr<MappingSystem> system) {
  return std::make_unique<ConnectedObjects>(std::move(name), setup, std::move(system));
}

}  // namespace dhpmap::evaluator
