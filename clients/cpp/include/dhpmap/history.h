// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace dhpmap::client {

/// An edit of a map's log; objects are given by ids. A value.
struct LoggedEdit {
  enum class Kind { kEdit, kUndo, kRedo };

  std::int64_t revision = 0;  ///< of the state that it created
  std::chrono::system_clock::time_point time;
  std::string author;
  Kind kind = Kind::kEdit;
  std::vector<std::string> actions;   ///< of kEdit, such as "MOVE", in order
  std::vector<std::int64_t> targets;  ///< of kUndo and kRedo: the revisions of the edits
  std::vector<std::int64_t> changed, created, removed;
  bool is_undone = false;      ///< undone, and not redone since
  bool is_reversible = false;  ///< the data for undoing it are kept
};

struct LogOptions {
  std::string author;  ///< only edits of this author; empty: all
  int limit = 100;     ///< maximum number of edits
};

}  // namespace dhpmap::client
