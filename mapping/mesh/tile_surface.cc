// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/tile_surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "mapping/base/memory_count.h"
#include "mapping/map/slope.h"
#include "mapping/mesh/cell_cases.h"

namespace dhpmap {
namespace {

constexpr int kTileVoxels = kTileSide * kBlockSide;  // along an axis
// Cells begin one voxel before the tile; their corners are extrapolated from voxels one farther, by slopes that look at
// one more.
constexpr int kMargin = 3;
constexpr int kSide = kTileVoxels + 2 * kMargin;
constexpr int kStride[3] = {1, kSide, kSide* kSide};
constexpr std::size_t kVoxels = std::size_t{kSide} * kSide * kSide;

/// Position of a voxel of the tile, counted from its corner, -kMargin to kTileVoxels + kMargin - 1 along each axis.
constexpr int Position(int x, int y, int z) {
  return (x + kMargin) + kSide * (y + kMargin) + kSide * kSide * (z + kMargin);
}

enum Flag : std::uint8_t { kHasValue = 1, kInside = 2, kObserved = 4, kContradicted = 8 };

/// The other voxels around one.
struct Neighbour {
  int step;
  Eigen::Vector3f offset_vox;
  float nearness;
};
constexpr int kNumNeighbours = 26;
const std::array<Neighbour, kNumNeighbours>& Neighbours() {
  static const std::array<Neighbour, kNumNeighbours> neighbours = [] {
    std::array<Neighbour, kNumNeighbours> all;
    std::size_t i = 0;
    for (int k = 0; k < 27; ++k) {
      const Eigen::Vector3i offset(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      if (offset.isZero()) continue;
      all[i++] = {offset.x() * kStride[0] + offset.y() * kStride[1] + offset.z() * kStride[2], offset.cast<float>(),
                  1.0f / static_cast<float>(offset.squaredNorm())};
    }
    return all;
  }();
  return neighbours;
}

/// Eight voxels' flags at once.
using Flags8 = std::uint64_t;
constexpr Flags8 EightOf(std::uint8_t flag) { return 0x0101010101010101u * flag; }
Flags8 Load8(const std::uint8_t* flags) {
  Flags8 eight;
  std::memcpy(&eight, flags, sizeof(eight));
  return eight;
}
constexpr std::size_t kWords = (kSide + 7) / 8;  ///< for a row and a little more

template <typename T>
using RoomVector = CountedVector<T, MemoryKind::kTileRooms>;

/// Room for a tile and what is around it, which a thread keeps: to clear what a surface touched of it takes a tenth of
/// clearing all.
class TileRoom {
 public:
  static constexpr std::size_t kRows = std::size_t{kSide} * kSide;  ///< of kSide voxels along x

  RoomVector<float> distance_m = RoomVector<float>(kVoxels, std::numeric_limits<float>::quiet_NaN());
  RoomVector<std::uint8_t> flags = RoomVector<std::uint8_t>(kVoxels + 8 * kWords, 0);  // rows are read in words
  RoomVector<float> sum_m = RoomVector<float>(kVoxels, 0), weight = RoomVector<float>(kVoxels, 0);
  RoomVector<int> reached;

  void Touch(std::size_t row) {
    if (is_touched_[row]) return;
    touched_.push_back(row);
    is_touched_[row] = true;
  }
  [[nodiscard]] bool IsTouched(std::size_t row) const { return is_touched_[row]; }
  void Clear() {
    for (const std::size_t row : touched_) {
      is_touched_[row] = false;
      const auto first = static_cast<std::ptrdiff_t>(row * kSide);
      std::fill_n(distance_m.begin() + first, kSide, std::numeric_limits<float>::quiet_NaN());
      std::fill_n(flags.begin() + first, kSide, std::uint8_t{0});
    }
    touched_.clear();
    for (const int position : reached) {
      sum_m[static_cast<std::size_t>(position)] = 0;
      weight[static_cast<std::size_t>(position)] = 0;
    }
    reached.clear();
  }

 private:
  RoomVector<std::size_t> touched_;
  std::array<bool, kRows> is_touched_{};
};

constexpr std::size_t RowOf(int position) { return static_cast<std::size_t>(position) / kSide; }

/// Where block `i` of TileBlocks is, in blocks from the tile's first.
constexpr BlockIndex OffsetOf(int i) {
  constexpr int kAround = kTileSide + 2;
  return {i % kAround - 1, i / kAround % kAround - 1, i / (kAround * kAround) - 1};
}

/// A tile with the voxels around it, as far as they are observed or can be extrapolated.
class TileWindow {
 public:
  TileWindow(TileRoom& room, const TileBlocks& blocks) : room_(room) {
    room_.Clear();  // of what one left that found no memory
    for (int i = 0; i < static_cast<int>(blocks.size()); ++i) {
      if (blocks[static_cast<std::size_t>(i)] == nullptr) continue;
      CopyBlock(*blocks[static_cast<std::size_t>(i)], OffsetOf(i));
    }
    Extrapolate();
  }
  ~TileWindow() { room_.Clear(); }
  TileWindow(const TileWindow&) = delete;
  TileWindow& operator=(const TileWindow&) = delete;

  [[nodiscard]] float At(int position) const { return distance_m_[static_cast<std::size_t>(position)]; }
  [[nodiscard]] const std::uint8_t* flags() const { return flags_; }
  /// Whether a row along x has any value.
  [[nodiscard]] bool HasRow(int position) const { return room_.IsTouched(RowOf(position)); }

 private:
  /// `offset`: in blocks, from the tile's first.
  void CopyBlock(const BlockEntry& block, BlockIndex offset) {
    const auto begin = [](int d) { return d < 0 ? kBlockSide - kMargin : 0; };
    const auto end = [](int d) { return d == kTileSide ? kMargin : kBlockSide; };
    for (int z = begin(offset.z); z < end(offset.z); ++z) {
      for (int y = begin(offset.y); y < end(offset.y); ++y) {
        const int row = Position(0, offset.y * kBlockSide + y, offset.z * kBlockSide + z);
        room_.Touch(RowOf(row));
        for (int x = begin(offset.x); x < end(offset.x); ++x) {
          const int linear = LinearIndex({x, y, z});
          if (block.Shows(linear)) {
            Set(row + offset.x * kBlockSide + x, block.tsdf->distance_m[static_cast<std::size_t>(linear)], kObserved);
          } else if (block.IsContradicted(linear)) {
            flags_[static_cast<std::size_t>(row + offset.x * kBlockSide + x)] = kContradicted;
          }
        }
      }
    }
  }

  void Set(int position, float distance_m, Flag how) {
    distance_m_[static_cast<std::size_t>(position)] = distance_m;
    flags_[static_cast<std::size_t>(position)] =
        static_cast<std::uint8_t>(how | kHasValue | (distance_m < 0 ? kInside : 0));
  }

  /// Gives voxels that have an observed one among their 26 neighbours the average of what these expect there, the
  /// nearer the more.
  void Extrapolate() {
    for (int z = -2; z < kTileVoxels + 2; ++z) {
      for (int y = -2; y < kTileVoxels + 2; ++y) {
        if (HasRow(Position(0, y, z))) ExtrapolateRow(y, z);
      }
    }
    for (const int to : room_.reached) {
      const auto t = static_cast<std::size_t>(to);
      room_.Touch(RowOf(to));
      Set(to, sum_m_[t] / weight_[t], kHasValue);
    }
  }

  void ExtrapolateRow(int y, int z) {
    std::array<Flags8, kWords> all;  // flags that all of the nine rows here and around have
    all.fill(EightOf(kObserved));
    for (int k = 0; k < 9; ++k) {
      const std::uint8_t* row = flags_ + Position(-kMargin, y + k % 3 - 1, z + k / 3 - 1);
      for (std::size_t word = 0; word < all.size(); ++word) all[word] &= Load8(row + 8 * word);
    }
    std::array<std::uint8_t, 8 * (kWords + 1)> by_voxel{};
    std::memcpy(by_voxel.data(), all.data(), sizeof(all));
    const std::uint8_t* here = flags_ + Position(-kMargin, y, z);
    for (std::size_t x = 1; x + 1 < kSide; x += 8) {  // beyond the row is nothing that was observed there
      const Flags8 within =
          Load8(&by_voxel[x - 1]) & Load8(&by_voxel[x]) & Load8(&by_voxel[x + 1]) & EightOf(kObserved);
      Flags8 border = Load8(here + x) & ~within & EightOf(kObserved);
      for (; border != 0; border &= border - 1) {
        const std::size_t at = x + static_cast<std::size_t>(std::countr_zero(border)) / 8;
        if (at + 1 < kSide) SpreadFrom(Position(static_cast<int>(at) - kMargin, y, z));
      }
    }
  }

  /// What a voxel expects at those around it that are not observed, and where nobody has seen that it is otherwise.
  void SpreadFrom(int from) {
    const float here_m = At(from);
    Eigen::Vector3f slope;
    for (int i = 0; i < 3; ++i) slope[i] = Slope(At(from - kStride[i]), here_m, At(from + kStride[i]));
    for (const Neighbour& neighbour : Neighbours()) {
      const int to = from + neighbour.step;
      const auto t = static_cast<std::size_t>(to);
      if ((flags_[t] & (kObserved | kContradicted)) != 0) continue;
      if (weight_[t] == 0) room_.reached.push_back(to);
      sum_m_[t] += neighbour.nearness * (here_m + slope.dot(neighbour.offset_vox));
      weight_[t] += neighbour.nearness;
    }
  }

  TileRoom& room_;
  float* const distance_m_ = room_.distance_m.data();
  std::uint8_t* const flags_ = room_.flags.data();
  float* const sum_m_ = room_.sum_m.data();
  float* const weight_ = room_.weight.data();
};

class TileMarcher {
 public:
  TileMarcher(const TileWindow& window, double voxel_size_m)
      : window_(window), voxel_size_m_(static_cast<float>(voxel_size_m)) {}

  std::vector<SurfaceTriangle> March() {
    for (int z = -1; z < kTileVoxels; ++z) {
      for (int y = -1; y < kTileVoxels; ++y) MarchRow(y, z);
    }
    return std::move(triangles_);
  }

 private:
  void MarchRow(int y, int z) {
    constexpr int kCorners = kTileVoxels + 2;
    const int first = Position(-1, y, z);
    for (const int step : {0, kStride[1], kStride[2], kStride[1] + kStride[2]}) {
      if (!window_.HasRow(first + step)) return;
    }
    std::array<std::uint8_t, 8 * (kWords + 1)> all{}, any{};  // by corner along x
    const std::uint8_t* row = window_.flags() + first;
    for (std::size_t x = 0; x < kCorners; x += 8) {
      const Flags8 a = Load8(row + x), b = Load8(row + x + kStride[1]), c = Load8(row + x + kStride[2]),
                   d = Load8(row + x + kStride[1] + kStride[2]);
      const Flags8 of_all = a & b & c & d, of_any = a | b | c | d;
      std::memcpy(&all[x], &of_all, sizeof(of_all));
      std::memcpy(&any[x], &of_any, sizeof(of_any));
    }
    for (std::size_t x = 0; x + 1 < kCorners; x += 8) {
      const Flags8 every = Load8(&all[x]) & Load8(&all[x + 1]), some = Load8(&any[x]) | Load8(&any[x + 1]);
      static_assert(kHasValue == 1 && kInside == 2 && kObserved == 4);
      Flags8 crossed = every & ~(every >> 1) & (some >> 1) & (some >> 2) & EightOf(1);
      for (; crossed != 0; crossed &= crossed - 1) {
        const std::size_t at = x + static_cast<std::size_t>(std::countr_zero(crossed)) / 8;
        if (at + 1 < kCorners) MarchCell({static_cast<int>(at) - 1, y, z});
      }
    }
  }

  void MarchCell(VoxelIndex low) {
    const int position = Position(low.x, low.y, low.z);
    unsigned inside = 0;
    int first_observed = -1;
    for (int c = 0; c < kCellCorners; ++c) {
      const std::uint8_t flags = window_.flags()[CornerPosition(position, c)];
      if ((flags & kInside) != 0) inside |= 1u << c;
      if (first_observed < 0 && (flags & kObserved) != 0) first_observed = c;
    }
    const auto is_in_tile = [](int coordinate) { return coordinate >= 0 && coordinate < kTileVoxels; };
    if (!is_in_tile(low.x + (first_observed & 1)) || !is_in_tile(low.y + (first_observed >> 1 & 1)) ||
        !is_in_tile(low.z + (first_observed >> 2 & 1))) {
      return;
    }
    const CellCase& cell_case = CellCases()[inside];
    for (int k = 0; k < cell_case.num_triangles; ++k) {
      SurfaceTriangle& triangle = triangles_.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        triangle[i] = Crossing(low, position, cell_case.triangles[static_cast<std::size_t>(k)][i]);
      }
    }
  }

  [[nodiscard]] static int CornerPosition(int position, int corner) {
    return position + (corner & 1) * kStride[0] + (corner >> 1 & 1) * kStride[1] + (corner >> 2 & 1) * kStride[2];
  }

  /// Where the surface crosses an edge of a cell.
  [[nodiscard]] Eigen::Vector3f Crossing(VoxelIndex low, int position, int cell_edge) const {
    constexpr float kLeast = 1e-3f;  // in voxels, as in meshes
    const CellEdge edge = CellEdgeTable()[static_cast<std::size_t>(cell_edge)];
    const int start = CornerPosition(position, edge.corner);
    const float a = window_.At(start), b = window_.At(start + kStride[edge.axis]);
    Eigen::Vector3f p(static_cast<float>(low.x + (edge.corner & 1)), static_cast<float>(low.y + (edge.corner >> 1 & 1)),
                      static_cast<float>(low.z + (edge.corner >> 2 & 1)));
    p[edge.axis] += std::clamp(a / (a - b), kLeast, 1 - kLeast);
    return (p + Eigen::Vector3f::Constant(0.5f)) * voxel_size_m_;
  }

  const TileWindow& window_;
  const float voxel_size_m_;
  std::vector<SurfaceTriangle> triangles_;
};

}  // namespace

TileNeighbourhood FindNeighbourhood(const BlockTable& blocks, TileIndex tile) {
  TileNeighbourhood around;
  for (int i = 0; i < 27; ++i) {
    around[static_cast<std::size_t>(i)] =
        blocks.FindTile({tile.x + i % 3 - 1, tile.y + i / 3 % 3 - 1, tile.z + i / 9 - 1});
  }
  return around;
}

namespace {

/// Calls visit(number, tile, cell) for the places of FindBlocks where there is a tile.
template <typename Visitor>
void ForEachPlace(const TileNeighbourhood& around, TileIndex tile, Visitor&& visit) {
  const BlockIndex first = BlockIn(tile, 0);
  for (int i = 0; i < static_cast<int>(std::tuple_size_v<TileBlocks>); ++i) {
    const BlockIndex offset = OffsetOf(i);
    const TileIndex beside = TileOf(offset);
    const TileEntry* entry = around[static_cast<std::size_t>((beside.x + 1) + 3 * (beside.y + 1) + 9 * (beside.z + 1))];
    if (entry == nullptr) continue;
    visit(static_cast<std::size_t>(i), *entry->tile,
          CellOf({first.x + offset.x, first.y + offset.y, first.z + offset.z}));
  }
}

SurfaceNames NamesOf(const BlockTile& tile, int cell) {
  if (const TilePage* page = tile.page().get()) {
    const std::uint64_t tsdf = page->PartIdOf(BlockLayer::kTsdf, cell);
    return tsdf == 0 ? SurfaceNames() : SurfaceNames{tsdf, page->PartIdOf(BlockLayer::kGone, cell)};
  }
  const BlockEntry* block = tile.Find(cell);
  if (block == nullptr || block->tsdf == nullptr) return {};
  return {block->tsdf->part_id.value(), block->gone != nullptr ? block->gone->part_id.value() : 0};
}

}  // namespace

TileBlocks FindBlocks(const TileNeighbourhood& around, TileIndex tile) {
  TileBlocks blocks{};
  ForEachPlace(around, tile, [&](std::size_t i, const BlockTile& there, int cell) {
    const BlockEntry* block = there.Find(cell);
    if (block != nullptr && block->tsdf != nullptr) blocks[i] = block;
  });
  return blocks;
}

TileNames FindNames(const TileNeighbourhood& around, TileIndex tile) {
  TileNames names{};
  ForEachPlace(around, tile, [&](std::size_t i, const BlockTile& there, int cell) { names[i] = NamesOf(there, cell); });
  return names;
}

std::vector<SurfaceTriangle> ExtractTileSurface(const TileBlocks& blocks, double voxel_size_m) {
  thread_local TileRoom room;
  const TileWindow window(room, blocks);
  return TileMarcher(window, voxel_size_m).March();
}

Eigen::Vector3d TileCorner(TileIndex tile, double voxel_size_m) { return BlockCorner(BlockIn(tile, 0), voxel_size_m); }

}  // namespace dhpmap
