// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tests/rig/ledger/state_names.h"

namespace dhpmap::rig {

/// A place in the order in which the clients of a run ask and are answered.
using Moment = std::int64_t;

/// A number that never goes back: whoever asks after somebody was told a value gets that or a higher one.
class Floor {
 public:
  static constexpr std::int64_t kNothing = std::numeric_limits<std::int64_t>::min();

  void Raise(Moment told, std::int64_t value);
  /// The highest value that anybody had been told by then.
  [[nodiscard]] std::int64_t At(Moment moment) const;
  [[nodiscard]] std::int64_t highest() const { return steps_.empty() ? kNothing : steps_.rbegin()->second; }

 private:
  std::map<Moment, std::int64_t> steps_;  // both ascend
};

/// A page token of a state, and what must become of it after the next restart.
struct KeptToken {
  std::string token;
  std::int64_t revision = 0;
  bool is_lost = false;  ///< its state was never stored: HISTORY_LOST; else it goes on being good
};

/// Laws 2 and 4 for one history of a map. Thread-compatible.
class Progress {
 public:
  /// `what`: the map and its history, for complaints.
  Progress(std::string what, Complaints& complaints) : what_(std::move(what)), complaints_(complaints) {}

  void OnRevision(std::int64_t revision, Moment asked, Moment answered);
  /// A state as the map's summary tells it.
  void OnFrames(std::int64_t revision, std::int64_t num_frames);
  /// A revision that cannot be lost any more: that of an edit which was made.
  void OnDurable(std::int64_t revision);
  void OnToken(std::string token, std::int64_t revision);

  void OnStored(const std::string& session, std::int64_t sequence);
  /// Frames of all sessions that somebody was told are stored. Sequences begin at 0.
  [[nodiscard]] std::int64_t num_stored() const;
  /// What the first answer of a stream says.
  void OnResumed(const std::string& session, std::optional<std::int64_t> sequence);

  /// The first summary after a restart, before anything is fused: tells which states were lost.
  void OnRestarted(std::int64_t num_frames);

  /// Tokens of states from before the last restart of which it is certain what must become of them.
  [[nodiscard]] const std::vector<KeptToken>& tokens() const { return judged_; }
  void OnPage(const KeptToken& token, bool is_refused_as_lost, const std::string& answer);

 private:
  std::string what_;
  Complaints& complaints_;
  Floor revisions_;
  std::map<std::string, std::int64_t> stored_;
  std::map<std::int64_t, std::int64_t> frames_;  // by revision, since the last restart
  std::int64_t durable_revision_ = Floor::kNothing;
  std::vector<KeptToken> fresh_;  // told since the last restart
  std::vector<KeptToken> judged_;
  std::set<std::string> misjudged_;  // one complaint each
};

}  // namespace dhpmap::rig
