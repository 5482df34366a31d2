// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace dhpmap::rig {

/// What a server may be at when it is killed.
enum class Phase { kMapping, kRefinement, kEdits, kCollection, kBackup, kMigration };
inline constexpr std::size_t kNumPhases = 6;
/// "mapping"
const char* NameOf(Phase phase);

/// Of the unary calls that make a server do what is a phase; nothing for others.
std::optional<Phase> PhaseOfCall(std::string_view call);

/// A number for each phase.
template <typename T>
class ByPhase {
 public:
  T& operator[](Phase phase) { return values_[static_cast<std::size_t>(phase)]; }
  const T& operator[](Phase phase) const { return values_[static_cast<std::size_t>(phase)]; }

 private:
  std::array<T, kNumPhases> values_{};
};

/// How many calls of each phase clients wait for. Thread-safe.
using CallsUnderWay = ByPhase<std::atomic<int>>;

/// Counts a call while it lives.
class CallUnderWay {
 public:
  CallUnderWay(CallsUnderWay& calls, Phase phase) : count_(calls[phase]) { ++count_; }
  ~CallUnderWay() { --count_; }
  CallUnderWay(const CallUnderWay&) = delete;
  CallUnderWay& operator=(const CallUnderWay&) = delete;

 private:
  std::atomic<int>& count_;
};

/// Sees what a server is at: by the calls that are under way, and for what no call asks for by its threads, which are
/// named. Thread-compatible.
class PhaseWatch {
 public:
  PhaseWatch(pid_t server, const CallsUnderWay& calls) : server_(server), calls_(calls) {}

  /// At this moment; of kCollection whether there was any since the last look.
  ByPhase<bool> Look();

 private:
  const pid_t server_;
  const CallsUnderWay& calls_;
  std::int64_t collection_ns_ = -1;  ///< that its thread had run by the last look; -1: it was not looked at
};

/// Of a process: whether it has a thread of this name, and how long these have run on a core (0 without such numbers).
struct ThreadUse {
  bool is_there = false;
  std::int64_t run_ns = 0;
};
ThreadUse ThreadsNamed(pid_t process, std::string_view name);

}  // namespace dhpmap::rig
