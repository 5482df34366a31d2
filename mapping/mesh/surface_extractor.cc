// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/surface_extractor.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <optional>

#include "mapping/base/cache_line.h"
#include "mapping/mesh/cell_cases.h"
#include "mapping/mesh/owner_halo.h"
#include "mapping/mesh/tsdf_halo.h"
#include "mapping/submap/voxel_answer.h"

namespace dhpmap {
namespace {

constexpr int kEdgesPerBlock = 3 * kBlockVoxels;  // each voxel owns the edge that starts at it along each axis
constexpr int kWords = kEdgesPerBlock / 64;
constexpr int kRows = kBlockSide * kBlockSide;
static_assert(kBlockSide == 8, "a row of voxels is a byte of a mask");

/// A cell that the surface crosses.
struct ActiveCell {
  std::uint16_t linear = 0;
  std::uint8_t inside_corners = 0;
};

/// A block of the field during extraction. Vertices are numbered by block, then by edge, so that all cells around an
/// edge, in any block, use the same vertex.
struct alignas(kCacheLineBytes) MeshBlock {
  const BlockEntry* entry = nullptr;
  std::array<int, kCellCorners> forward{};           ///< neighbours at offsets 0 or 1 by corner number; -1: none
  std::array<std::uint8_t, kRows> inside{};          ///< bit x of row y + 8 z: distance < 0
  std::array<std::uint8_t, kRows> observed{};        ///< the same: was observed
  std::array<std::uint64_t, kWords> edges{};         ///< bit 3 * linear + axis: the surface crosses, in a meshed cell
  std::array<std::uint32_t, kWords> first_vertex{};  ///< number of the first vertex of each word
  MeshingVector<ActiveCell> cells;
  std::size_t num_triangles = 0, first_triangle = 0;
};

/// Location of a voxel in the field.
struct VoxelPlace {
  int block;
  int linear;
};

/// Copies of the data in and around a block.
struct BlockSurroundings {
  TsdfHalo tsdf;
  std::optional<OwnerHalo> owners;  ///< none: the submap of any voxel answers

  BlockSurroundings(const SurfaceField& field, const Halo::Blocks& blocks) : tsdf(blocks) {
    if (OwnerHalo::IsNeeded(field, blocks)) owners.emplace(field, blocks);
  }
};

}  // namespace

class SurfaceExtractor::Impl {
 public:
  Impl(const SurfaceField& field, const LabelSet& label_set, MeshColoring coloring)
      : field_(field), label_set_(label_set), coloring_(coloring), blocks_(field.blocks().size()) {}

  /// Each step finishes for all blocks before the next one starts, and writes only to its own block.
  void FindSurface(ThreadPool& pool, const std::stop_token& stop) {
    pool.ParallelFor(blocks_.size(), [&](std::size_t i) {
      if (!stop.stop_requested()) LinkBlock(i);
    });
    if (stop.stop_requested()) return;  // else FindCells would follow missing links
    pool.ParallelFor(blocks_.size(), [&](std::size_t i) {
      if (!stop.stop_requested()) FindCells(static_cast<int>(i));
    });
    if (!stop.stop_requested()) Number();
  }

  [[nodiscard]] std::size_t num_blocks() const { return blocks_.size(); }
  [[nodiscard]] std::size_t FirstVertex(std::size_t i) const {
    return i == blocks_.size() ? num_vertices_ : blocks_[i].first_vertex[0];
  }
  [[nodiscard]] std::size_t FirstTriangle(std::size_t i) const {
    return i == blocks_.size() ? num_triangles_ : blocks_[i].first_triangle;
  }

  void MakeVertices(int i, std::size_t first, Mesh& part) const {
    const MeshBlock& block = blocks_[i];
    if (std::all_of(block.edges.begin(), block.edges.end(), [](std::uint64_t word) { return word == 0; })) return;
    const Halo::Blocks around = Halo::FindBlocks(field_, block.entry->index);
    const BlockSurroundings surroundings(field_, around);
    std::size_t vertex = block.first_vertex[0] - first;
    for (int w = 0; w < kWords; ++w) {
      for (std::uint64_t bits = block.edges[w]; bits != 0; bits &= bits - 1) {
        const int edge = 64 * w + std::countr_zero(bits);
        MakeVertex({i, edge / 3}, edge % 3, surroundings, vertex++, part);
      }
    }
  }

  void MakeTriangles(int i, std::size_t first, Mesh& part) const {
    const MeshBlock& block = blocks_[i];
    std::size_t triangle = block.first_triangle - first;
    for (const ActiveCell& cell : block.cells) {
      const CellCase& cell_case = cases_[cell.inside_corners];
      std::array<std::uint32_t, kCellEdges> vertex_of_edge;
      for (unsigned edges = cell_case.edges; edges != 0; edges &= edges - 1) {
        const int edge = std::countr_zero(edges);
        vertex_of_edge[edge] = VertexAt(Place(block, cell, edge));
      }
      for (int k = 0; k < cell_case.num_triangles; ++k) {
        const auto& [a, b, c] = cell_case.triangles[k];
        part.triangles[triangle++] = {vertex_of_edge[a], vertex_of_edge[b], vertex_of_edge[c]};
      }
    }
  }

 private:
  void LinkBlock(std::size_t i) {
    MeshBlock& block = blocks_[i];
    block.entry = &field_.blocks()[i];
    MaskVoxels(block);
    const BlockIndex index = block.entry->index;
    for (int c = 0; c < kCellCorners; ++c) {
      const BlockEntry* entry = field_.Find({index.x + (c & 1), index.y + (c >> 1 & 1), index.z + (c >> 2 & 1)});
      block.forward[c] = entry == nullptr ? -1 : static_cast<int>(field_.NumberOf(*entry));
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

  /// The row at (y, z), 0 to 8 each, with the first voxel of the neighbour along x as bit 8.
  unsigned Row(const MeshBlock& block, std::array<std::uint8_t, kRows> MeshBlock::*mask, int y, int z) const {
    const int row = (y & 7) + kBlockSide * (z & 7);
    const int side = (y >> 3) << 1 | (z >> 3) << 2;
    const int near = block.forward[side], far = block.forward[side | 1];
    unsigned bits = near < 0 ? 0u : (blocks_[near].*mask)[row];
    if (far >= 0) bits |= ((blocks_[far].*mask)[row] & 1u) << 8;
    return bits;
  }

  void FindCells(int i) {
    MeshBlock& block = blocks_[i];
    constexpr int kRows9 = kBlockSide + 1, kNumRows = kRows9 * kRows9;
    std::array<unsigned, kNumRows> inside, observed;
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
          block.cells.push_back(
              {static_cast<std::uint16_t>(LinearIndex({x, y, z})), static_cast<std::uint8_t>(corners)});
        }
      }
    }
    MarkEdges(i);
  }

  struct EdgePlace {
    int block;
    int edge;
  };
  /// Where an edge of a cell is stored: at the voxel where it starts.
  EdgePlace Place(const MeshBlock& block, const ActiveCell& cell, int cell_edge) const {
    const CellEdge edge = edge_table_[cell_edge];
    const VoxelIndex v = VoxelIn({0, 0, 0}, cell.linear);
    const VoxelIndex start{v.x + (edge.corner & 1), v.y + (edge.corner >> 1 & 1), v.z + (edge.corner >> 2 & 1)};
    const BlockIndex beyond = BlockOf(start);  // 0 or 1 along each axis
    return {block.forward[beyond.x | beyond.y << 1 | beyond.z << 2], 3 * LinearIndex(start) + edge.axis};
  }

  /// Marks the edges that cells of block `i` use. Several blocks may mark edges of the same neighbour at once.
  void MarkEdges(int i) {
    MeshBlock& block = blocks_[i];
    std::array<std::uint64_t, kWords> own{};
    for (const ActiveCell& cell : block.cells) {
      block.num_triangles += cases_[cell.inside_corners].num_triangles;
      for (unsigned edges = cases_[cell.inside_corners].edges; edges != 0; edges &= edges - 1) {
        const EdgePlace place = Place(block, cell, std::countr_zero(edges));
        const std::uint64_t bit = std::uint64_t{1} << (place.edge % 64);
        if (place.block == i) own[place.edge / 64] |= bit;
        else Mark(blocks_[place.block].edges[place.edge / 64], bit);
      }
    }
    for (int w = 0; w < kWords; ++w) {
      if (own[w] != 0) Mark(block.edges[w], own[w]);
    }
  }

  static void Mark(std::uint64_t& word, std::uint64_t bits) {
    std::atomic_ref(word).fetch_or(bits, std::memory_order_relaxed);
  }

  void Number() {
    std::uint32_t num_vertices = 0;
    std::size_t num_triangles = 0;
    for (MeshBlock& block : blocks_) {
      for (int w = 0; w < kWords; ++w) {
        block.first_vertex[w] = num_vertices;
        num_vertices += static_cast<std::uint32_t>(std::popcount(block.edges[w]));
      }
      block.first_triangle = num_triangles;
      num_triangles += block.num_triangles;
    }
    num_vertices_ = num_vertices;
    num_triangles_ = num_triangles;
  }

  /// Computes the zero crossing between a voxel and the next one along `axis`.
  void MakeVertex(VoxelPlace start, int axis, const BlockSurroundings& around, std::size_t vertex, Mesh& part) const {
    constexpr float kMargin = 1e-3f;  // in voxels: keeps vertices of edges that meet in a zero voxel apart
    const BlockIndex block = blocks_[start.block].entry->index;
    const VoxelIndex v = VoxelIn({0, 0, 0}, start.linear);
    const int a = Halo::Position(v.x, v.y, v.z), b = a + Halo::kStride[axis];
    const TsdfHalo& tsdf = around.tsdf;
    const float rise = tsdf.At(b) - tsdf.At(a);  // not 0, because the signs differ
    const float t = std::clamp(-tsdf.At(a) / rise, kMargin, 1 - kMargin);

    Eigen::Vector3d p_field = VoxelCentre(VoxelIn(block, start.linear), 1.0);
    p_field[axis] += t;
    const Transform& T_map_field = field_.T_map_field();
    part.vertices_m[vertex] = (T_map_field * (p_field * field_.voxel_size_m())).cast<float>();

    Eigen::Vector3d gradient;
    for (int i = 0; i < 3; ++i) {
      gradient[i] = i == axis ? rise : (1 - t) * tsdf.Slope(a, i) + t * tsdf.Slope(b, i);
    }
    part.normals[vertex] = (T_map_field.linear() * gradient.normalized()).cast<float>();

    const int nearer = t > 0.5f ? b : a, farther = t > 0.5f ? a : b;
    const VoxelPlace labelling =
        PlaceOf(start.block, around.owners ? around.owners->Labelling(nearer, farther, axis) : nearer);
    SetLabel(labelling, vertex, part);
    if (coloring_ == MeshColoring::kSensor) {
      part.colors[vertex] = Mix(ColorAt(start), ColorAt(PlaceOf(start.block, b)), t);
    }
  }

  /// The voxel at a position of the block's halo.
  [[nodiscard]] VoxelPlace PlaceOf(int block, int position) const {
    const VoxelIndex v = Halo::VoxelAt(position);
    const BlockIndex offset = BlockOf(v);  // -1 to 1 along each axis
    const BlockIndex index = blocks_[block].entry->index;
    if (std::min({offset.x, offset.y, offset.z}) >= 0) {
      return {blocks_[block].forward[offset.x | offset.y << 1 | offset.z << 2], LinearIndex(v)};
    }
    const BlockEntry* entry = field_.Find({index.x + offset.x, index.y + offset.y, index.z + offset.z});
    return {static_cast<int>(field_.NumberOf(*entry)), LinearIndex(v)};
  }

  void SetLabel(VoxelPlace voxel, std::size_t vertex, Mesh& part) const {
    const BlockHolder& holder = field_.HolderAt(static_cast<std::size_t>(voxel.block), voxel.linear);
    const BestLabel best = ClassOfVoxel(*holder.submap, *holder.block, voxel.linear);
    const ClassId vertex_class(static_cast<std::uint16_t>(best.id));
    part.classes[vertex] = vertex_class.value;
    part.instances[vertex] = holder.submap->id().value;
    if (coloring_ != MeshColoring::kSensor) part.colors[vertex] = LabelColor(holder.submap->info(), vertex_class);
  }

  [[nodiscard]] Color ColorAt(VoxelPlace voxel) const { return blocks_[voxel.block].entry->tsdf->color[voxel.linear]; }

  static Color Mix(Color a, Color b, float t) {
    const auto mix = [t](std::uint8_t x, std::uint8_t y) {
      return static_cast<std::uint8_t>(static_cast<float>(x) * (1 - t) + static_cast<float>(y) * t + 0.5f);
    };
    return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
  }

  [[nodiscard]] Color LabelColor(const SubmapInfo& submap, ClassId vertex_class) const {
    if (submap.panoptic == Panoptic::kUnknown) return ColorOfId(0);
    if (coloring_ == MeshColoring::kInstance) return ColorOfId(submap.id.value);
    const LabelClass* label = label_set_.Find(vertex_class);
    // In label sets without colours, all are black.
    return label == nullptr || label->color == Color{} ? ColorOfId(vertex_class.value) : label->color;
  }

  [[nodiscard]] std::uint32_t VertexAt(EdgePlace place) const {
    const MeshBlock& block = blocks_[place.block];
    const int word = place.edge / 64;
    const std::uint64_t before = block.edges[word] & ((std::uint64_t{1} << (place.edge % 64)) - 1);
    return block.first_vertex[word] + static_cast<std::uint32_t>(std::popcount(before));
  }

  const SurfaceField& field_;
  const LabelSet& label_set_;
  const MeshColoring coloring_;
  const CellCaseTable& cases_ = CellCases();
  const std::array<CellEdge, kCellEdges>& edge_table_ = CellEdgeTable();
  MeshingVector<MeshBlock> blocks_;  // in the order of the field
  std::size_t num_vertices_ = 0, num_triangles_ = 0;
};

SurfaceExtractor::SurfaceExtractor(const SurfaceField& field, const LabelSet& label_set, MeshColoring coloring,
                                   ThreadPool& pool, const std::stop_token& stop)
    : impl_(std::make_unique<Impl>(field, label_set, coloring)) {
  impl_->FindSurface(pool, stop);
}

SurfaceExtractor::~SurfaceExtractor() = default;
SurfaceExtractor::SurfaceExtractor(SurfaceExtractor&&) noexcept = default;

std::size_t SurfaceExtractor::num_blocks() const { return impl_->num_blocks(); }
std::size_t SurfaceExtractor::FirstVertex(std::size_t block) const { return impl_->FirstVertex(block); }
std::size_t SurfaceExtractor::FirstTriangle(std::size_t block) const { return impl_->FirstTriangle(block); }

void SurfaceExtractor::MakeVertices(std::size_t block, std::size_t first, Mesh& part) const {
  impl_->MakeVertices(static_cast<int>(block), first, part);
}

void SurfaceExtractor::MakeTriangles(std::size_t block, std::size_t first, Mesh& part) const {
  impl_->MakeTriangles(static_cast<int>(block), first, part);
}

void ResizeVertices(std::size_t num_vertices, Mesh& part) {
  part.vertices_m.resize(num_vertices);
  part.normals.resize(num_vertices);
  part.colors.resize(num_vertices);
  part.classes.resize(num_vertices);
  part.instances.resize(num_vertices);
}

}  // namespace dhpmap
