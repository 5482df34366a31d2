// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/takeovers/stored_maps.h"

#include <grpcpp/grpcpp.h>

#include <map>

#include "dhpmap/v1/edit_service.grpc.pb.h"
#include "dhpmap/v1/map_service.grpc.pb.h"

namespace dhpmap::rig {
namespace {

using Complaints = std::vector<std::string>;

void CheckFrames(v1::MapService::Stub& maps, const std::string& map, std::int64_t last_frame, Complaints& complaints) {
  v1::GetMapRequest request;
  request.set_name(map);
  v1::GetMapResponse response;
  grpc::ClientContext context;
  const grpc::Status got = maps.GetMap(&context, request, &response);
  const std::int64_t stored = response.map().num_frames();
  if (!got.ok()) complaints.push_back(map + ": cannot be read: " + got.error_message());
  if (got.ok() && stored < last_frame) complaints.push_back(map + ": frames are lost");
  if (got.ok() && stored > last_frame + 1) complaints.push_back(map + ": frames are doubled");
}

/// Revisions of the logged edits by author.
std::multimap<std::string, std::int64_t> ReadEdits(v1::EditService::Stub& edits, const std::string& map,
                                                   Complaints& complaints) {
  std::multimap<std::string, std::int64_t> logged;
  v1::ListEditsRequest request;
  request.set_parent(map);
  do {
    v1::ListEditsResponse page;
    grpc::ClientContext context;
    const grpc::Status got = edits.ListEdits(&context, request, &page);
    if (!got.ok()) complaints.push_back(map + ": no list of its edits: " + got.error_message());
    for (const v1::LoggedEdit& edit : page.edits()) logged.emplace(edit.author(), edit.revision());
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  return logged;
}

void CheckEdits(const std::multimap<std::string, std::int64_t>& logged, const std::string& map,
                const std::vector<std::int64_t>& revisions, Complaints& complaints) {
  for (std::size_t i = 0; i < revisions.size(); ++i) {
    const std::string author = "edit-" + std::to_string(i + 1);
    const auto found = logged.find(author);
    if (found == logged.end()) complaints.push_back(map + ": " + author + " is lost");
    else if (found->second != revisions[i]) complaints.push_back(map + ": " + author + " has another revision");
    if (logged.count(author) > 1) complaints.push_back(map + ": " + author + " is doubled");
  }
  if (logged.size() > revisions.size() + 1) complaints.push_back(map + ": more edits are stored than were made");
}

}  // namespace

Complaints ComplaintsOfStored(const std::shared_ptr<grpc::Channel>& server, const std::string& map,
                              std::int64_t last_frame, const std::vector<std::int64_t>& edit_revisions) {
  Complaints complaints;
  CheckFrames(*v1::MapService::NewStub(server), map, last_frame, complaints);
  CheckEdits(ReadEdits(*v1::EditService::NewStub(server), map, complaints), map, edit_revisions, complaints);
  return complaints;
}

}  // namespace dhpmap::rig
