// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>

#include "mapping/mesh/cell_cases.h"
#include "mapping/mesh/mesh.h"
#include "mapping/mesh/tsdf_halo.h"

namespace dhpmap {
namespace {

constexpr int kEdgesPerBlock = 3 * kBlockVoxels;  // each voxel owns the edges that start at it, one an axis
constexpr int kWords = kEdgesPerBlock / 64;
constexpr int kRows = kBlockSide * kBlockSide;
static_assert(kBlockSide == 8, "a row of voxels is a byte of a mask");

/// A block of the submap during extraction. Vertices are numbered by block, then by edge, so that the same edge gives
/// the same vertex to every cell around it, whichever block the cell is in.
struct MeshBlock {
  const BlockEntry* entry = nullptr;
  std::array<int, kCellCorners> forward{};           ///< neighbours at offsets 0 or 1 by corner number; -1 = none
  std::array<std::uint8_t, kRows> inside{};          ///< bit x of row y + 8 z: distance < 0
  std::array<std::uint8_t, kRows> observed{};        ///< the same: has been observed
  std::array<std::uint64_t, kWords> edges{};         ///< bit 3 * linear + axis: the surface crosses, in a cell we mesh
  std::array<std::uint32_t, kWords> first_vertex{};  ///< number of the first vertex of each word
};

/// A cell that the surface crosses.
struct ActiveCell {
  std::uint32_t block = 0;
  std::uint16_t linear = 0;
  std::uint8_t inside_corners = 0;
};

class Extractor {
 public:
  Extractor(const Submap& submap, const LabelSet& label_set, MeshColoring coloring)
      : submap_(submap), label_set_(label_set), coloring_(coloring) {}

  Mesh Run() {
    CollectBlocks();
    for (std::uint32_t i = 0; i < blocks_.size(); ++i) FindCells(i);
    NumberVertices();
    for (const MeshBlock& block : blocks_) MakeVertices(block);
    for (const ActiveCell& cell : cells_) MakeTriangles(cell);
    return std::move(mesh_);
  }

 private:
  /// Sorts the blocks, so that the mesh does not depend on the order of their allocation, and links neighbours.
  void CollectBlocks() {
    const auto entries = submap_.blocks().entries();
    std::vector<const BlockEntry*> sorted;
    for (const BlockEntry& entry : entries) {
      if (entry.tsdf != nullptr) sorted.push_back(&entry);
    }
    std::sort(sorted.begin(), sorted.end(),
              [](const BlockEntry* a, const BlockEntry* b) { return a->index < b->index; });
    blocks_.resize(sorted.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) blocks_[i].entry = sorted[i];
    std::vector<int> block_of_entry(entries.size(), -1);
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      block_of_entry[static_cast<std::size_t>(blocks_[i].entry - entries.data())] = static_cast<int>(i);
    }
    for (MeshBlock& block : blocks_) {
      MaskVoxels(block);
      const BlockIndex index = block.entry->index;
      for (int c = 0; c < kCellCorners; ++c) {
        const BlockEntry* entry =
            submap_.blocks().Find({index.x + (c & 1), index.y + (c >> 1 & 1), index.z + (c >> 2 & 1)});
        block.forward[c] = entry == nullptr ? -1 : block_of_entry[static_cast<std::size_t>(entry - entries.data())];
      }
    }
  }

  static void MaskVoxels(MeshBlock& block) {
    const TsdfBlock& tsdf = *block.entry->tsdf;
    for (int row = 0; row < kRows; ++row) {
      unsigned inside = 0, observed = 0;
      for (int x = 0; x < kBlockSide; ++x) {
        const int linear = row * kBlockSide + x;
        inside |= static_cast<unsigned>(tsdf.distance_m[linear] < 0) << x;
        observed |= static_cast<unsigned>(tsdf.IsObserved(linear)) << x;
      }
      block.inside[row] = static_cast<std::uint8_t>(inside);
      block.observed[row] = static_cast<std::uint8_t>(observed);
    }
  }

  /// The row at (y, z), 0 to 8 each, with the first voxel of the neighbour in x as bit 8.
  unsigned Row(const MeshBlock& block, std::array<std::uint8_t, kRows> MeshBlock::*mask, int y, int z) const {
    const int row = (y & 7) + kBlockSide * (z & 7);
    const int side = (y >> 3) << 1 | (z >> 3) << 2;
    const int near = block.forward[side], far = block.forward[side | 1];
    unsigned bits = near < 0 ? 0u : (blocks_[near].*mask)[row];
    if (far >= 0) bits |= ((blocks_[far].*mask)[row] & 1u) << 8;
    return bits;
  }

  void FindCells(std::uint32_t i) {
    const MeshBlock& block = blocks_[i];
    constexpr int kRows9 = kBlockSide + 1;
    std::array<unsigned, kRows9 * kRows9> inside, observed;
    for (int z = 0; z < kRows9; ++z) {
      for (int y = 0; y < kRows9; ++y) {
        inside[y + kRows9 * z] = Row(block, &MeshBlock::inside, y, z);
        observed[y + kRows9 * z] = Row(block, &MeshBlock::observed, y, z);
      }
    }
    for (int z = 0; z < kBlockSide; ++z) {
      for (int y = 0; y < kBlockSide; ++y) {
        const int r = y + kRows9 * z;
        const std::array<int, 4> rows = {r, r + 1, r + kRows9, r + kRows9 + 1};  // by bits y, z of the corner
        unsigned all_observed = ~0u, any_inside = 0, all_inside = ~0u;
        for (const int row : rows) {
          all_observed &= observed[row] & observed[row] >> 1;
          any_inside |= inside[row] | inside[row] >> 1;
          all_inside &= inside[row] & inside[row] >> 1;
        }
        for (unsigned active = all_observed & any_inside & ~all_inside & 0xFFu; active != 0; active &= active - 1) {
          const int x = std::countr_zero(active);
          unsigned corners = 0;
          for (int k = 0; k < 4; ++k) corners |= (inside[rows[k]] >> x & 3u) << (2 * k);
          AddCell({i, static_cast<std::uint16_t>(LinearIndex({x, y, z})), static_cast<std::uint8_t>(corners)});
        }
      }
    }
  }

  struct EdgePlace {
    int block;
    int edge;
  };
  /// Where the edge of a cell is kept: at the voxel it starts from.
  EdgePlace Place(const ActiveCell& cell, int cell_edge) const {
    const CellEdge edge = edge_table_[cell_edge];
    const VoxelIndex v = VoxelIn({0, 0, 0}, cell.linear);
    const VoxelIndex start{v.x + (edge.corner & 1), v.y + (edge.corner >> 1 & 1), v.z + (edge.corner >> 2 & 1)};
    const BlockIndex beyond = BlockOf(start);  // 0 or 1 along each axis
    return {blocks_[cell.block].forward[beyond.x | beyond.y << 1 | beyond.z << 2], 3 * LinearIndex(start) + edge.axis};
  }

  void AddCell(const ActiveCell& cell) {
    cells_.push_back(cell);
    for (unsigned edges = cases_[cell.inside_corners].edges; edges != 0; edges &= edges - 1) {
      const EdgePlace place = Place(cell, std::countr_zero(edges));
      blocks_[place.block].edges[place.edge / 64] |= std::uint64_t{1} << (place.edge % 64);
    }
  }

  void NumberVertices() {
    std::uint32_t count = 0;
    for (MeshBlock& block : blocks_) {
      for (int w = 0; w < kWords; ++w) {
        block.first_vertex[w] = count;
        count += static_cast<std::uint32_t>(std::popcount(block.edges[w]));
      }
    }
    mesh_.vertices_m.reserve(count);
    mesh_.normals.reserve(count);
    mesh_.colors.reserve(count);
    mesh_.classes.reserve(count);
    mesh_.instances.assign(count, submap_.id().value);
    mesh_.triangles.reserve(2 * cells_.size());
  }

  void MakeVertices(const MeshBlock& block) {
    if (std::all_of(block.edges.begin(), block.edges.end(), [](std::uint64_t word) { return word == 0; })) return;
    const TsdfHalo halo(submap_.blocks(), block.entry->index);
    for (int w = 0; w < kWords; ++w) {
      for (std::uint64_t bits = block.edges[w]; bits != 0; bits &= bits - 1) {
        const int edge = 64 * w + std::countr_zero(bits);
        MakeVertex(block, halo, edge / 3, edge % 3);
      }
    }
  }

  /// The zero crossing between voxel `linear` and the next one along `axis`.
  void MakeVertex(const MeshBlock& block, const TsdfHalo& halo, int linear, int axis) {
    constexpr float kMargin = 1e-3f;  // in voxels: vertices of edges that meet in a zero voxel stay apart
    const VoxelIndex v = VoxelIn({0, 0, 0}, linear);
    const int a = TsdfHalo::Position(v.x, v.y, v.z), b = a + TsdfHalo::kStride[axis];
    const float rise = halo.At(b) - halo.At(a);  // not 0: the signs differ
    const float t = std::clamp(-halo.At(a) / rise, kMargin, 1 - kMargin);

    Eigen::Vector3d p_submap = VoxelCentre(VoxelIn(block.entry->index, linear), 1.0);
    p_submap[axis] += t;
    const Transform& T_map_submap = submap_.info().T_map_submap;
    mesh_.vertices_m.push_back((T_map_submap * (p_submap * submap_.info().voxel_size_m)).cast<float>());

    Eigen::Vector3d gradient;
    for (int i = 0; i < 3; ++i) {
      gradient[i] = i == axis ? rise : (1 - t) * halo.Slope(a, i) + t * halo.Slope(b, i);
    }
    mesh_.normals.push_back((T_map_submap.linear() * gradient.normalized()).cast<float>());
    AddAttributes(block, v, linear, axis, t);
  }

  void AddAttributes(const MeshBlock& block, VoxelIndex v, int linear, int axis, float t) {
    VoxelIndex next = v;
    (axis == 0 ? next.x : axis == 1 ? next.y : next.z) += 1;
    const bool is_beyond = BlockOf(next) != BlockIndex{0, 0, 0};
    const BlockEntry& next_entry = is_beyond ? *blocks_[block.forward[1 << axis]].entry : *block.entry;
    const int next_linear = LinearIndex(next);
    const BlockEntry& nearest = t > 0.5f ? next_entry : *block.entry;
    const std::uint16_t vertex_class = ClassAt(nearest, t > 0.5f ? next_linear : linear);
    mesh_.classes.push_back(vertex_class);
    mesh_.colors.push_back(coloring_ == MeshColoring::kSensor
                               ? Mix(block.entry->tsdf->color[linear], next_entry.tsdf->color[next_linear], t)
                               : LabelColor(vertex_class));
  }

  [[nodiscard]] std::uint16_t ClassAt(const BlockEntry& entry, int linear) const {
    if (entry.labels == nullptr || entry.labels->IsEmpty(linear)) return submap_.info().class_id.value;
    const BestLabel best = entry.labels->BestClass(linear);
    return best.count == 0 ? submap_.info().class_id.value : static_cast<std::uint16_t>(best.id);
  }

  static Color Mix(Color a, Color b, float t) {
    const auto mix = [t](std::uint8_t x, std::uint8_t y) {
      return static_cast<std::uint8_t>(static_cast<float>(x) * (1 - t) + static_cast<float>(y) * t + 0.5f);
    };
    return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
  }

  [[nodiscard]] Color LabelColor(std::uint16_t vertex_class) const {
    if (submap_.info().panoptic == Panoptic::kUnknown) return ColorOfId(0);
    if (coloring_ == MeshColoring::kInstance) return ColorOfId(submap_.id().value);
    const LabelClass* label = label_set_.Find(ClassId(vertex_class));
    // Label sets often come without colours, all black then.
    return label == nullptr || label->color == Color{} ? ColorOfId(vertex_class) : label->color;
  }

  void MakeTriangles(const ActiveCell& cell) {
    const CellCase& cell_case = cases_[cell.inside_corners];
    std::array<std::uint32_t, kCellEdges> vertex_of_edge;
    for (unsigned edges = cell_case.edges; edges != 0; edges &= edges - 1) {
      const int edge = std::countr_zero(edges);
      vertex_of_edge[edge] = VertexAt(Place(cell, edge));
    }
    for (int i = 0; i < cell_case.num_triangles; ++i) {
      const auto& [a, b, c] = cell_case.triangles[i];
      mesh_.triangles.push_back({vertex_of_edge[a], vertex_of_edge[b], vertex_of_edge[c]});
    }
  }

  [[nodiscard]] std::uint32_t VertexAt(EdgePlace place) const {
    const MeshBlock& block = blocks_[place.block];
    const int word = place.edge / 64;
    const std::uint64_t before = block.edges[word] & ((std::uint64_t{1} << (place.edge % 64)) - 1);
    return block.first_vertex[word] + static_cast<std::uint32_t>(std::popcount(before));
  }

  const Submap& submap_;
  const LabelSet& label_set_;
  const MeshColoring coloring_;
  const CellCaseTable& cases_ = CellCases();
  const std::array<CellEdge, kCellEdges>& edge_table_ = CellEdgeTable();
  std::vector<MeshBlock> blocks_;
  std::vector<ActiveCell> cells_;
  Mesh mesh_;
};

}  // namespace

Mesh ExtractMesh(const Submap& submap, const LabelSet& label_set, MeshColoring coloring) {
  return Extractor(submap, label_set, coloring).Run();
}

}  // namespace dhpmap
