// SPDX-License-Identifier: BSD-3-Clause
// The log of a map; undo, redo and restore.
#include "dhpmap/history.h"

#include <algorithm>
#include <utility>

#include "clients/cpp/calls/pages.h"
#include "clients/cpp/src/convert/edits.h"
#include "dhpmap/map.h"

namespace dhpmap::client {
namespace {

constexpr int kMostLoggedAPage = 1000;

LoggedEdit LoggedEditOf(const v1::LoggedEdit& told) {
  LoggedEdit edit;
  edit.revision = told.revision();
  const auto since_epoch =
      std::chrono::seconds(told.create_time().seconds()) + std::chrono::nanoseconds(told.create_time().nanos());
  edit.time += std::chrono::duration_cast<std::chrono::system_clock::duration>(since_epoch);
  edit.author = told.author();
  if (told.kind() == v1::LoggedEdit::UNDO) edit.kind = LoggedEdit::Kind::kUndo;
  if (told.kind() == v1::LoggedEdit::REDO) edit.kind = LoggedEdit::Kind::kRedo;
  for (const v1::LoggedEdit::Step& step : told.steps()) {
    edit.actions.push_back(v1::LoggedEdit::Action_Name(step.action()));
  }
  edit.targets = IdsOf(told.targets());
  edit.changed = IdsOf(told.changed_submaps());
  edit.created = IdsOf(told.created_submaps());
  edit.removed = IdsOf(told.removed_submaps());
  edit.is_undone = told.undone();
  edit.is_reversible = told.reversible();
  return edit;
}

}  // namespace

Result<std::vector<LoggedEdit>> Map::Log(const LogOptions& options) const {
  v1::ListEditsRequest request;
  request.set_parent(resource_name_);
  request.set_author(options.author);
  request.set_page_size(std::clamp(options.limit, 1, kMostLoggedAPage));
  std::vector<LoggedEdit> log;
  const auto add = [&](const v1::ListEditsResponse& page) {
    for (const v1::LoggedEdit& edit : page.edits()) {
      if (static_cast<int>(log.size()) < options.limit) log.push_back(LoggedEditOf(edit));
    }
    return static_cast<int>(log.size()) < options.limit;
  };
  if (Status status = ForEachPage(*caller_, &v1::EditService::Stub::ListEdits, request, add); !status.ok()) {
    return status;
  }
  return log;
}

Result<Undone> Map::Restore(std::int64_t revision, const RestoreOptions& options) const {
  v1::RestoreRevisionRequest request;
  request.set_map(resource_name_);
  request.set_revision(revision);
  if (options.object) request.set_submap(SubmapName(resource_name_, *options.object));
  request.set_author(options.author.empty() ? caller_->author() : options.author);
  request.set_request_id(NewRequestId());
  const auto answer = caller_->Call(&v1::EditService::Stub::RestoreRevision, request);
  if (!answer.ok()) return answer.status();
  return Undone{answer->revision(),
                {},
                IdsOf(answer->changed_submaps()),
                IdsOf(answer->created_submaps()),
                IdsOf(answer->removed_submaps())};
}

}  // namespace dhpmap::client
