// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace dhpmap::simulator {

/// A hash of x with well-mixed bits (finaliser of splitmix64).
constexpr std::uint64_t MixBits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Keys of random streams, by purpose.
inline constexpr std::uint64_t kDepthStream = 1, kPredictionStream = 2, kScoreStream = 3;

/// Random numbers that are equal for all compilers and standard libraries, unlike those of <random>'s distributions.
class Random {
 public:
  /// Streams with different keys are independent, so a frame's noise does not depend on frames rendered before.
  Random(std::uint64_t seed, std::uint64_t frame, std::uint64_t purpose)
      : state_(MixBits(MixBits(MixBits(seed) ^ frame) ^ purpose)) {}

  std::uint64_t Bits() { return MixBits(state_++); }
  /// In [0, 1).
  double Uniform() { return static_cast<double>(Bits() >> 11) * 0x1p-53; }
  double Uniform(double from, double to) { return from + (to - from) * Uniform(); }
  bool Chance(double probability) { return Uniform() < probability; }
  /// In [0, count).
  std::uint32_t Below(std::uint32_t count) { return static_cast<std::uint32_t>(Uniform() * count); }
  /// Standard normal (Box-Muller; uses both results).
  double Gaussian() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
    const double angle = 2.0 * std::numbers::pi * Uniform();
    spare_ = radius * std::sin(angle);
    has_spare_ = true;
    return radius * std::cos(angle);
  }

 private:
  std::uint64_t state_;
  bool has_spare_ = false;
  double spare_ = 0;
};

}  // namespace dhpmap::simulator
