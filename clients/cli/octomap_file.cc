// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/octomap_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>

namespace dhpmap {
namespace {

constexpr int kLevels = 16;

/// Values in the file: two bits a child.
enum Kind : unsigned { kUnknown = 0, kFree = 1, kOccupied = 2, kInner = 3 };

/// Interleaves the bits of three numbers, from x's lowest bit: each level's bits select a child.
std::uint64_t Interleaved(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  std::uint64_t bits = 0;
  for (int level = 0; level < kLevels; ++level) {
    const auto bit = [level](std::uint32_t value) { return std::uint64_t{(value >> level) & 1u}; };
    bits |= (bit(x) | bit(y) << 1 | bit(z) << 2) << (3 * level);
  }
  return bits;
}

/// Writes nodes depth first: for each inner node the kinds of its children, then its inner children.
class TreeWriter {
 public:
  /// `cells`: ascending.
  Kind Write(std::span<const std::uint64_t> cells, int level) {
    if (cells.empty()) return kUnknown;
    if (level == 0) return (cells.front() & 1u) != 0 ? kOccupied : kFree;
    const std::size_t place = bytes_.size(), num_before = num_nodes_;
    bytes_.append(2, '\0');
    std::array<Kind, 8> children{};
    for (unsigned child = 0; child < 8; ++child) {
      const auto end = std::partition_point(cells.begin(), cells.end(), [=](std::uint64_t cell) {
        return ((cell >> (1 + 3 * (level - 1))) & 7u) <= child;
      });
      const auto count = static_cast<std::size_t>(end - cells.begin());
      children[child] = Write(cells.first(count), level - 1);
      cells = cells.subspan(count);
      if (children[child] != kUnknown) ++num_nodes_;
    }
    const bool are_same = children[0] != kInner && std::count(children.begin(), children.end(), children[0]) == 8;
    if (are_same && level < kLevels) {  // the root must be an inner node
      bytes_.resize(place);
      num_nodes_ = num_before;
      return children[0];
    }
    for (unsigned child = 0; child < 8; ++child) {
      bytes_[place + child / 4] = static_cast<char>(bytes_[place + child / 4] | (children[child] << 2 * (child % 4)));
    }
    return kInner;
  }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  [[nodiscard]] std::size_t num_nodes() const { return num_nodes_; }

 private:
  std::string bytes_;
  std::size_t num_nodes_ = 0;  // without the root
};

/// The shortest text that parses to the same number.
std::string Shortest(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace

Status OctomapFile::Add(int x, int y, int z, bool is_occupied) {
  for (const int index : {x, y, z}) {
    if (index < -kReach || index >= kReach) {
      return OutOfRange(
          "OctoMap reaches 32,768 cells to each side of the origin, and the map farther: take a larger "
          "resolution");
    }
  }
  if (cells_.size() == kMostCells) {
    return ResourceExhausted("more than " + std::to_string(kMostCells) + " cells: take a larger resolution");
  }
  const auto key = [](int index) { return static_cast<std::uint32_t>(index + kReach); };
  cells_.push_back(Interleaved(key(x), key(y), key(z)) << 1 | (is_occupied ? 1u : 0u));
  num_occupied_ += is_occupied ? 1 : 0;
  return Status::Ok();
}

std::string OctomapFile::Bytes(double resolution_m) {
  std::sort(cells_.begin(), cells_.end());
  TreeWriter tree;
  const bool is_empty = tree.Write(cells_, kLevels) == kUnknown;
  const std::size_t size = is_empty ? 0 : tree.num_nodes() + 1;
  return "# Octomap OcTree binary file\nid OcTree\nsize " + std::to_string(size) + "\nres " + Shortest(resolution_m) +
         "\ndata\n" + tree.bytes();
}

}  // namespace dhpmap
