// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/clients/connection.h"

#include <algorithm>

#include "tests/support/status_reason.h"

namespace dhpmap::rig {
Connection::Connection(const Life& life, Ledger& ledger)
    : maps(v1::MapService::NewStub(life.channel)),
      mapping(v1::MappingService::NewStub(life.channel)),
      submaps(v1::SubmapService::NewStub(life.channel)),
      edits(v1::EditService::NewStub(life.channel)),
      life_(life),
      ledger_(ledger) {}

Outcome Connection::Judge(const char* what, std::initializer_list<std::string_view> expected,
                          const grpc::Status& status) {
  if (status.ok()) return {.fate = Fate::kAnswered};
  const std::string reason = testing::ReasonOf(status);
  const std::string in_words = std::string(what) + " in life " + std::to_string(life_.number) + ": " +
                               std::to_string(status.error_code()) + " " + reason + " " + status.error_message();
  if (reason.empty()) {
    if (!life_.is_ending) ledger_.Complain("the connection was lost although nobody killed the server: " + in_words);
    return {.fate = Fate::kCut};
  }
  if (std::find(expected.begin(), expected.end(), reason) == expected.end()) {
    ledger_.Complain("an answer that nothing explains: " + in_words);
  }
  return {.fate = Fate::kRefused, .reason = reason};
}

Outcome Connection::GetMap(const std::string& name, v1::Map& map) {
  v1::GetMapRequest request;
  request.set_name(name);
  v1::GetMapResponse response;
  const Outcome outcome = Ask("GetMap", {"MAP_NOT_FOUND"},
                              [&](grpc::ClientContext* context) { return maps->GetMap(context, request, &response); });
  map = std::move(*response.mutable_map());
  return outcome;
}

Outcome Connection::List(const std::string& map, v1::ListSubmapsResponse& page, int page_size,
                         const std::string& token) {
  v1::ListSubmapsRequest request;
  request.set_parent(map);
  request.set_page_size(page_size);
  request.set_page_token(token);
  return Ask("ListSubmaps", {"HISTORY_LOST"},
             [&](grpc::ClientContext* context) { return submaps->ListSubmaps(context, request, &page); });
}

std::string MapIdOf(const std::string& name) { return name.substr(name.find('/') + 1); }

}  // namespace dhpmap::rig
