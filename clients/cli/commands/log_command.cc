// SPDX-License-Identifier: BSD-3-Clause
// dhpmap log: lists the edits of a map.
#include <google/protobuf/util/time_util.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "clients/cli/connection.h"
#include "clients/cli/printable.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/edit_service.grpc.pb.h"

namespace dhpmap {
namespace {

struct LogOptions {
  std::string map, author;
  int limit = 50;
};

std::string Id(const std::string& name) { return name.substr(name.rfind('/') + 1); }

void PrintIds(const char* what, const google::protobuf::RepeatedPtrField<std::string>& names) {
  if (names.empty()) return;
  std::cout << ", " << what;
  for (const std::string& name : names) std::cout << " " << Id(name);
}

/// "17  2026-11-24T15:45:37Z  anna  move 7, rename 7, changed 7 (undone)".
void Print(const v1::LoggedEdit& edit) {
  std::cout << edit.revision() << "  " << google::protobuf::util::TimeUtil::ToString(edit.create_time()) << "  "
            << (edit.author().empty() ? "-" : Printable(edit.author())) << "  ";
  if (edit.kind() != v1::LoggedEdit::EDIT) std::cout << Lower(v1::LoggedEdit::Kind_Name(edit.kind()));
  for (const std::string& target : edit.targets()) std::cout << " " << Id(target);
  const char* separator = "";
  for (const v1::LoggedEdit::Step& step : edit.steps()) {
    std::cout << separator << Lower(v1::LoggedEdit::Action_Name(step.action()));
    if (!step.submap().empty()) std::cout << " " << Id(step.submap());
    if (step.action() == v1::LoggedEdit::RESTORE && edit.restored_revision() > 0) {
      std::cout << " to revision " << edit.restored_revision();
    }
    separator = ", ";
  }
  PrintIds("changed", edit.changed_submaps());
  PrintIds("created", edit.created_submaps());
  PrintIds("removed", edit.removed_submaps());
  if (edit.num_voxels() > 0) std::cout << ", " << edit.num_voxels() << " voxels";
  std::cout << (edit.undone() ? " (undone)" : "") << "\n";
}

/// Reads the newest edits page by page, up to the requested number.
ExitCode RunLog(const Session& session, const LogOptions& options) {
  v1::ListEditsRequest request;
  request.set_parent(MapName(options.map));
  request.set_author(options.author);
  request.set_page_size(std::min(options.limit, 1000));
  v1::ListEditsResponse all;
  const auto add = [&](v1::ListEditsResponse& page) {
    for (v1::LoggedEdit& edit : *page.mutable_edits()) {
      if (all.edits_size() < options.limit) *all.add_edits() = std::move(edit);
    }
    return all.edits_size() < options.limit;
  };
  const client::Status status =
      client::ForEachPage(*session.caller, &v1::EditService::Stub::ListEdits, request, add, client::Again::kNo);
  if (!status.ok()) return ReportError(session, status);
  if (session.json) PrintJson(all);
  else std::for_each(all.edits().begin(), all.edits().end(), Print);
  return ExitCode::kOk;
}

}  // namespace

void AddLogCommand(CLI::App& app, Session& session) {
  CLI::App* log = app.add_subcommand("log", "List the edits of a map, the newest first");
  auto options = std::make_shared<LogOptions>();
  log->add_option("map", options->map, "Name of the map")->required();
  log->add_option("--author", options->author, "Edits of this author only");
  log->add_option("-n,--limit", options->limit, "So many at most [50]")->check(CLI::PositiveNumber);
  log->callback([options, &session] { session.exit_code = RunLog(session, *options); });
}

}  // namespace dhpmap
