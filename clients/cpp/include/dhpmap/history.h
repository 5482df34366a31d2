// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace dhpmap::client {

/// An edit of a map's log; objects by their ids. A value.
struct LoggedEdit {
  enum class Kind { kEdit, kUndo, kRedo };

  std::int64_t revision = 0;  ///< of the state that it made
  std::chrono::system_clock::time_point time;
  std::string author;
  Kind kind = Kind::kEdit;
  std::vector<std::string> actions;   ///< of kEdit, such as "MOVE", in their order
  std::vector<std::int64_t> targets;  ///< of kUndo and kRedo: the edits, by their revisions
  std::vector<std::int64_t> changed, created, removed;
  bool is_undone = false;      ///< and not done again since
  bool is_reversible = false;  ///< what it takes to undo it is kept
};

struct LogOptions {
  std::string author;  ///< only edits of this one; empty: of all
  int limit = 100;     ///< edits at most
};

}  // namespace dhpmap::client
