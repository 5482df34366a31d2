// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/ledger/phases.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

namespace dhpmap::rig {

const char* NameOf(Phase phase) {
  switch (phase) {
    case Phase::kMapping: return "mapping";
    case Phase::kRefinement: return "refinement";
    case Phase::kEdits: return "edits";
    case Phase::kCollection: return "collection";
    case Phase::kBackup: return "backup";
    case Phase::kMigration: return "migration";
  }
  return "";
}

std::optional<Phase> PhaseOfCall(std::string_view call) {
  if (call == "FinishMapping") return Phase::kRefinement;
  constexpr std::string_view kEdits[] = {"CloneSubmap", "UpdateSubmap",   "DeleteSubmap", "ApplyEdits",
                                         "UndoEdits",   "RedoEdits",      "CreateMap",    "UpdateMap",
                                         "DeleteMap",   "RestoreRevision"};
  if (std::find(std::begin(kEdits), std::end(kEdits), call) != std::end(kEdits)) return Phase::kEdits;
  return std::nullopt;
}

ThreadUse ThreadsNamed(pid_t process, std::string_view name) {
  namespace fs = std::filesystem;
  ThreadUse use;
  std::error_code error;
  for (auto task = fs::directory_iterator("/proc/" + std::to_string(process) + "/task", error);
       !error && task != fs::directory_iterator(); task.increment(error)) {
    std::string comm;
    std::ifstream names(task->path() / "comm");
    if (!std::getline(names, comm) || comm != name) continue;
    use.is_there = true;
    std::int64_t run_ns = 0;
    std::ifstream times(task->path() / "schedstat");
    if (times >> run_ns) use.run_ns += run_ns;
  }
  return use;
}

ByPhase<bool> PhaseWatch::Look() {
  ByPhase<bool> seen;
  for (const Phase phase : {Phase::kMapping, Phase::kRefinement, Phase::kEdits, Phase::kBackup}) {
    seen[phase] = calls_[phase] > 0;
  }
  // Lives as long as a refinement beside mapping does; the one at the end is a call's.
  seen[Phase::kRefinement] = seen[Phase::kRefinement] || ThreadsNamed(server_, "refinement").is_there;
  // Waits when there is nothing to collect, and before that between its steps.
  const std::int64_t run_ns = ThreadsNamed(server_, "reclaim-space").run_ns;
  seen[Phase::kCollection] = collection_ns_ >= 0 && run_ns > collection_ns_;
  collection_ns_ = run_ns;
  return seen;
}

}  // namespace dhpmap::rig
