// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/base/result.h"

namespace dhpmap {

/// What somebody has said of two submaps. Of two that somebody has merged it goes on to be said, though one is gone.
/// Kept in files.
enum class PairVerdict : std::uint8_t {
  kOpen = 0,       ///< nobody has: frames tell
  kMustBeOne = 1,  ///< they are merged as soon as they can be
  kMustBeTwo = 2,  ///< they are never merged
};

/// What is known of whether two submaps are one object.
struct ObjectPair {
  SubmapId first, second;  ///< the first is the smaller
  PairVerdict verdict = PairVerdict::kOpen;
  /// Logarithm of how much likelier the frames are if they are one than if they are two; see NotePairs.
  std::int32_t evidence = 0;
  /// From here on down frames speak for two, by odds of 7 to 1: more than one frame has shown them apart.
  static constexpr std::int32_t kSpeaksForTwo = -20;
  /// Whether they are to be taken for two: somebody has said so, or frames speak for it and nobody has said otherwise.
  [[nodiscard]] bool AreTwo() const {
    return verdict == PairVerdict::kMustBeTwo || (verdict == PairVerdict::kOpen && evidence <= kSpeaksForTwo);
  }
  friend bool operator==(const ObjectPair&, const ObjectPair&) = default;
};

/// The pairs of a map of which anything is known, of open ones at most kMostOpen. Value type.
class ObjectPairs {
 public:
  static constexpr std::size_t kMostOpen = 2048;
  static constexpr std::int32_t kMostEvidence = 1000;

  ObjectPairs() = default;
  /// DATA_LOSS unless they are ascending and each once, of two different submaps, with evidence within its limits.
  static Result<ObjectPairs> Create(std::vector<ObjectPair> pairs);

  /// Nothing is known of a pair that is not there. In any order.
  [[nodiscard]] ObjectPair Of(SubmapId a, SubmapId b) const;
  /// Adds evidence, within `least` and `most`. A pair without verdict or evidence is forgotten; of too many open ones
  /// that of the least evidence either way goes, the first of equals.
  void AddEvidence(SubmapId a, SubmapId b, std::int32_t added, std::int32_t least, std::int32_t most);
  void SetVerdict(SubmapId a, SubmapId b, PairVerdict verdict);

  /// Forgets all pairs of a submap that is no longer there.
  void Remove(SubmapId id);
  /// Pairs of `merged` are `into`'s from now on: evidence is added up, and that they must be two holds of the whole.
  void Merge(SubmapId merged, SubmapId into);

  /// Ascending by first, then second.
  [[nodiscard]] std::span<const ObjectPair> pairs() const { return pairs_; }
  friend bool operator==(const ObjectPairs&, const ObjectPairs&) = default;

 private:
  ObjectPair& At(SubmapId a, SubmapId b);
  void Bound();

  std::vector<ObjectPair> pairs_;
};

}  // namespace dhpmap
