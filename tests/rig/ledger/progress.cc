// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/ledger/progress.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace dhpmap::rig {
namespace {

/// Enough to be asked about again and again, in every life that follows.
constexpr std::size_t kMaxTokens = 200;

}  // namespace

void Floor::Raise(Moment told, std::int64_t value) {
  if (steps_.empty() || value > highest()) steps_[told] = value;
}

std::int64_t Floor::At(Moment moment) const {
  const auto after = steps_.upper_bound(moment);
  return after == steps_.begin() ? kNothing : std::prev(after)->second;
}

void Progress::OnRevision(std::int64_t revision, Moment asked, Moment answered) {
  if (const std::int64_t told = revisions_.At(asked); revision < told) {
    complaints_.push_back("law 2: " + what_ + " went back from revision " + std::to_string(told) + " to " +
                          std::to_string(revision));
    revisions_ = Floor();  // one complaint for each step back
  }
  revisions_.Raise(answered, revision);
}

void Progress::OnFrames(std::int64_t revision, std::int64_t num_frames) { frames_[revision] = num_frames; }

void Progress::OnDurable(std::int64_t revision) { durable_revision_ = std::max(durable_revision_, revision); }

void Progress::OnToken(std::string token, std::int64_t revision) {
  fresh_.push_back({.token = std::move(token), .revision = revision});
}

void Progress::OnStored(const std::string& session, std::int64_t sequence) {
  const auto [known, is_new] = stored_.emplace(session, sequence);
  if (sequence < known->second) {
    complaints_.push_back("law 4: " + what_ + ": session " + session + " was told that frame " +
                          std::to_string(known->second) + " is stored, then " + std::to_string(sequence));
  }
  known->second = std::max(known->second, sequence);
}

std::int64_t Progress::num_stored() const {
  std::int64_t num = 0;
  for (const auto& [session, sequence] : stored_) num += sequence + 1;
  return num;
}

void Progress::OnResumed(const std::string& session, std::optional<std::int64_t> sequence) {
  if (sequence) return OnStored(session, *sequence);
  if (const auto known = stored_.find(session); known != stored_.end()) {
    complaints_.push_back("law 4: " + what_ + ": session " + session + " was told that frame " +
                          std::to_string(known->second) + " is stored, then that nothing is");
  }
}

void Progress::OnRestarted(std::int64_t num_frames) {
  // Frames are never taken back within a history: a state with more of them than are there now was lost, and with it
  // every later one of that life.
  const auto lost = std::find_if(frames_.begin(), frames_.end(),
                                 [num_frames](const auto& state) { return state.second > num_frames; });
  if (lost != frames_.end() && lost->first <= durable_revision_) {
    complaints_.push_back("law 3: " + what_ + ": the state of revision " + std::to_string(lost->first) +
                          " is lost, although the edit of revision " + std::to_string(durable_revision_) + " was made");
  }
  for (KeptToken& token : fresh_) {
    token.is_lost = lost != frames_.end() && token.revision >= lost->first;
    if (!token.is_lost && token.revision > durable_revision_) continue;  // nobody was told which it is
    judged_.push_back(std::move(token));
  }
  if (judged_.size() > kMaxTokens) {
    judged_.erase(judged_.begin(), judged_.end() - static_cast<std::ptrdiff_t>(kMaxTokens));
  }
  fresh_.clear();
  frames_.clear();
  durable_revision_ = Floor::kNothing;
}

void Progress::OnPage(const KeptToken& token, bool is_refused_as_lost, const std::string& answer) {
  if (is_refused_as_lost == token.is_lost || !misjudged_.insert(token.token).second) return;
  complaints_.push_back("law 2: " + what_ + ": a page token of revision " + std::to_string(token.revision) +
                        (token.is_lost ? ", which was lost, must be refused as HISTORY_LOST: "
                                       : ", which was stored, must go on being good: ") +
                        answer);
}

}  // namespace dhpmap::rig
