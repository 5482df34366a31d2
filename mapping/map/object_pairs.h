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

/// A user's verdict on two submaps. After an edit merged them it remains, though one is gone. Stored, so numbers are
/// never reused.
enum class PairVerdict : std::uint8_t {
  kOpen = 0,       ///< no verdict: evidence from frames decides
  kMustBeOne = 1,  ///< merge them as soon as possible
  kMustBeTwo = 2,  ///< never merge them
};

/// Verdict and evidence on whether two submaps are one object.
struct ObjectPair {
  SubmapId first, second;  ///< first < second
  PairVerdict verdict = PairVerdict::kOpen;
  /// Log-likelihood ratio of the frames, one object against two; see NotePairs.
  std::int32_t evidence = 0;
  /// At or below this, frames show two objects, by odds of 7 to 1: more than one frame has shown them as separate.
  static constexpr std::int32_t kSpeaksForTwo = -20;
  /// Whether they count as two objects: by verdict, or by evidence without a verdict.
  [[nodiscard]] bool AreTwo() const {
    return verdict == PairVerdict::kMustBeTwo || (verdict == PairVerdict::kOpen && evidence <= kSpeaksForTwo);
  }
  friend bool operator==(const ObjectPair&, const ObjectPair&) = default;
};

/// The pairs of a map with a verdict or evidence; at most kMostOpen open ones. Value type.
class ObjectPairs {
 public:
  static constexpr std::size_t kMostOpen = 2048;
  static constexpr std::int32_t kMostEvidence = 1000;

  ObjectPairs() = default;
  /// DATA_LOSS unless pairs ascend, are unique, name two different submaps, and have evidence within its limits.
  static Result<ObjectPairs> Create(std::vector<ObjectPair> pairs);

  /// A pair without an entry has neither verdict nor evidence. The order of the arguments is irrelevant.
  [[nodiscard]] ObjectPair Of(SubmapId a, SubmapId b) const;
  /// Adds evidence, clamped to `least` and `most`. A pair without verdict or evidence is dropped. Beyond kMostOpen, the
  /// open pair of the smallest absolute evidence is dropped, the first of equals.
  void AddEvidence(SubmapId a, SubmapId b, std::int32_t added, std::int32_t least, std::int32_t most);
  void SetVerdict(SubmapId a, SubmapId b, PairVerdict verdict);

  /// Drops all pairs of a removed submap.
  void Remove(SubmapId id);
  /// Moves the pairs of `merged` to `into`: evidence is added up, and a verdict of two objects holds for the whole.
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
