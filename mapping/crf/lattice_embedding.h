// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "mapping/base/floor_to_int.h"

namespace dhpmap {

// The permutohedral lattice of dimension D (Adams et al. 2010): the points of the plane sum x_i = 0 of D+1 dimensions
// whose coordinates are integers that leave the same remainder modulo D+1.

/// A lattice point in one number. With coordinates x_i = (D+1) q_i + r it is r + 8 sum_i 2^(20 i) q_i over the first D
/// coordinates (the last follows from them), modulo the size of the type. Being linear, a step to another lattice point
/// is an addition. Two points share a key only if they are 2^20 cells apart (some 10^6 kernel widths).
template <int D>
struct LatticeKeyType;
template <>
struct LatticeKeyType<3> {
  using type = std::uint64_t;
};
template <>
struct LatticeKeyType<6> {
  using type = unsigned __int128;
};
template <int D>
using LatticeKey = typename LatticeKeyType<D>::type;

inline std::uint32_t HashOf(std::uint64_t low, std::uint64_t high) {
  std::uint64_t h = low * 0x9E3779B97F4A7C15ull ^ high * 0xC2B2AE3D27D4EB4Full;
  h ^= h >> 29;
  h *= 0xBF58476D1CE4E5B9ull;
  return static_cast<std::uint32_t>(h >> 32);
}
inline std::uint32_t HashOfKey(std::uint64_t key) { return HashOf(key, 0); }
inline std::uint32_t HashOfKey(unsigned __int128 key) {
  return HashOf(static_cast<std::uint64_t>(key), static_cast<std::uint64_t>(key >> 64));
}

/// The corners of the simplex that a feature lies in, with its barycentric coordinates (which add up to 1).
template <int D>
struct Simplex {
  std::array<LatticeKey<D>, D + 1> keys;
  std::array<float, D + 1> weights;
};

template <int D>
class LatticeEmbedding {
 public:
  using Key = LatticeKey<D>;
  using Feature = std::array<float, D>;

  LatticeEmbedding() {
    // Splat, blur and slice together then have the variance of the unit Gaussian.
    for (int i = 0; i < D; ++i) {
      scale_[i] = static_cast<float>(std::sqrt(2.0 / 3.0) * (D + 1) / std::sqrt((i + 1.0) * (i + 2.0)));
    }
  }

  void Embed(const Feature& feature, Simplex<D>& simplex) const;

  /// The neighbour of a lattice point along one of the D+1 axes, in the one of the two directions.
  static Key Next(Key key, int axis) {
    constexpr Key kRemainderMask = 7;
    const Key step = (key & kRemainderMask) == D ? AllUnits() - D : Key{1};
    return key + step - Unit(axis);
  }

 private:
  static constexpr Key Unit(int coordinate) { return coordinate == D ? Key{0} : Key{8} << (20 * coordinate); }
  static constexpr Key AllUnits() {
    Key sum = 0;
    for (int i = 0; i < D; ++i) sum += Unit(i);
    return sum;
  }

  std::array<float, D> scale_;
};

template <int D>
inline void LatticeEmbedding<D>::Embed(const Feature& feature, Simplex<D>& simplex) const {
  // Onto the plane sum x_i = 0.
  std::array<float, D + 1> x;
  float sum = 0;
  for (int i = D; i > 0; --i) {
    const float scaled = feature[i - 1] * scale_[i - 1];
    x[i] = sum - static_cast<float>(i) * scaled;
    sum += scaled;
  }
  x[0] = sum;

  // The nearest point with remainder 0, which need not lie in the plane yet, and what is left.
  constexpr float kInverse = 1.0f / (D + 1);
  std::array<std::int32_t, D + 1> quotient;
  std::array<float, D + 1> rest;
  std::int32_t excess = 0;
  for (int i = 0; i <= D; ++i) {
    quotient[i] = FloorToInt(x[i] * kInverse + 0.5f);
    rest[i] = x[i] - static_cast<float>(quotient[i] * (D + 1));
    excess += quotient[i];
  }

  // Coordinates by descending rest; the excess is taken from the smallest, or given to the largest.
  std::array<std::int32_t, D + 1> rank{};
  for (int i = 0; i < D; ++i) {
    for (int j = i + 1; j <= D; ++j) {
      const std::int32_t below = rest[i] < rest[j] ? 1 : 0;
      rank[i] += below;
      rank[j] += 1 - below;
    }
  }
  std::array<std::int32_t, D + 1> at_rank;
  std::array<float, D + 2> sorted;
  for (int i = 0; i <= D; ++i) {
    std::int32_t r = rank[i] + excess;
    const std::int32_t wrap = r < 0 ? 1 : (r > D ? -1 : 0);
    r += wrap * (D + 1);
    quotient[i] += wrap;
    rest[i] -= static_cast<float>(wrap * (D + 1));
    at_rank[r] = i;
    sorted[r] = rest[i] * kInverse;
  }

  simplex.weights[0] = 1.0f - (sorted[0] - sorted[D]);
  for (int k = 1; k <= D; ++k) simplex.weights[k] = sorted[D - k] - sorted[D + 1 - k];

  Key key = 0;
  for (int i = 0; i < D; ++i) key += Unit(i) * static_cast<Key>(quotient[i]);
  simplex.keys[0] = key;
  for (int k = 1; k <= D; ++k) simplex.keys[k] = key = key + 1 - Unit(at_rank[D + 1 - k]);
}

}  // namespace dhpmap
