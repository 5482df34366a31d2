// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/object_pairs.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace dhpmap {
namespace {

bool IsBeforePair(const ObjectPair& a, const ObjectPair& b) {
  return a.first != b.first ? a.first < b.first : a.second < b.second;
}

ObjectPair PairOf(SubmapId a, SubmapId b) { return {.first = std::min(a, b), .second = std::max(a, b)}; }

bool SaysNothing(const ObjectPair& pair) { return pair.verdict == PairVerdict::kOpen && pair.evidence == 0; }

}  // namespace

Result<ObjectPairs> ObjectPairs::Create(std::vector<ObjectPair> pairs) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ObjectPair& pair = pairs[i];
    const bool is_good = pair.first != kUnknownSubmap && pair.first < pair.second && !SaysNothing(pair) &&
                         pair.verdict <= PairVerdict::kMustBeTwo && std::abs(pair.evidence) <= kMostEvidence;
    if (!is_good || (i > 0 && !IsBeforePair(pairs[i - 1], pair))) return DataLoss("its pairs of objects are damaged");
  }
  ObjectPairs created;
  created.pairs_ = std::move(pairs);
  return created;
}

ObjectPair ObjectPairs::Of(SubmapId a, SubmapId b) const {
  const ObjectPair wanted = PairOf(a, b);
  const auto found = std::lower_bound(pairs_.begin(), pairs_.end(), wanted, IsBeforePair);
  return found != pairs_.end() && !IsBeforePair(wanted, *found) ? *found : wanted;
}

ObjectPair& ObjectPairs::At(SubmapId a, SubmapId b) {
  const ObjectPair wanted = PairOf(a, b);
  const auto found = std::lower_bound(pairs_.begin(), pairs_.end(), wanted, IsBeforePair);
  if (found != pairs_.end() && !IsBeforePair(wanted, *found)) return *found;
  return *pairs_.insert(found, wanted);
}

void ObjectPairs::AddEvidence(SubmapId a, SubmapId b, std::int32_t added, std::int32_t least, std::int32_t most) {
  ObjectPair& pair = At(a, b);
  pair.evidence = std::clamp(pair.evidence + added, std::max(least, -kMostEvidence), std::min(most, kMostEvidence));
  Bound();
}

void ObjectPairs::SetVerdict(SubmapId a, SubmapId b, PairVerdict verdict) {
  At(a, b).verdict = verdict;
  Bound();
}

void ObjectPairs::Bound() {
  std::erase_if(pairs_, SaysNothing);
  if (pairs_.size() <= kMostOpen) return;
  const auto num_open = static_cast<std::size_t>(std::count_if(
      pairs_.begin(), pairs_.end(), [](const ObjectPair& pair) { return pair.verdict == PairVerdict::kOpen; }));
  if (num_open <= kMostOpen) return;
  pairs_.erase(std::min_element(pairs_.begin(), pairs_.end(), [](const ObjectPair& x, const ObjectPair& y) {
    if ((x.verdict == PairVerdict::kOpen) != (y.verdict == PairVerdict::kOpen)) return x.verdict == PairVerdict::kOpen;
    return std::abs(x.evidence) < std::abs(y.evidence);
  }));
}

void ObjectPairs::Remove(SubmapId id) {
  std::erase_if(pairs_, [id](const ObjectPair& pair) { return pair.first == id || pair.second == id; });
}

void ObjectPairs::Merge(SubmapId merged, SubmapId into) {
  std::vector<ObjectPair> moved;
  for (const ObjectPair& pair : pairs_) {
    if (pair.first == merged || pair.second == merged) moved.push_back(pair);
  }
  Remove(merged);
  for (const ObjectPair& pair : moved) {
    const SubmapId other = pair.first == merged ? pair.second : pair.first;
    if (other == into) continue;
    ObjectPair& kept = At(into, other);
    kept.verdict = std::max(kept.verdict, pair.verdict);
    kept.evidence = std::clamp(kept.evidence + pair.evidence, -kMostEvidence, kMostEvidence);
  }
  Bound();
}

}  // namespace dhpmap
