// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstring>

#include "server/base/fingerprint.h"
#include "tests/rig/clients/clients.h"

namespace dhpmap::rig {
namespace {

constexpr int kPageSize = 3;

/// The same for the same voxels in whatever order. Of distances and weights the store keeps no more than so many bits.
std::uint64_t DigestOf(const v1::StreamSubmapVoxelsResponse& voxels) {
  std::uint64_t sum = 0;
  for (int i = 0; i < voxels.tsdf_m_size(); ++i) {
    std::array<float, 3> p{};
    std::copy_n(voxels.xyz_m().begin() + 3 * i, 3, p.begin());
    std::string text(sizeof(p), '\0');
    std::memcpy(text.data(), p.data(), sizeof(p));
    text += voxels.rgb().substr(3 * static_cast<std::size_t>(i), 3);
    text += std::to_string(voxels.class_id(i)) + " " + std::to_string(voxels.class_confidence(i));
    sum += Fingerprint(text);
  }
  return sum;
}

}  // namespace

void ReadingClient::Run(const Life& life) {
  Connection server(life, ledger_);
  while (ReadOnce(AnyOf(life.maps), server)) {
  }
}

bool ReadingClient::ReadOnce(const FedMap& map, Connection& server) {
  const int chance = Any(100);
  if (chance < 45) return ReadAll(map, server);
  if (chance < 60) return ReadOne(map, server);
  if (chance < 70) return ReadMap(map, server);
  if (chance < 80) return ReadPages(map, server);
  if (chance < 92) return AskWithOldToken(map, server);
  return ReadVoxels(map, server);
}

bool ReadingClient::ReadAll(const FedMap& map, Connection& server) {
  const Moment asked = ledger_.Now();
  v1::ListSubmapsResponse all;
  if (server.List(map.name, all).fate != Fate::kAnswered) return false;
  ledger_.OnListing(map.history, all, asked);
  for (const v1::Submap& submap : all.submaps()) highest_id_ = std::max(highest_id_, submap.instance_id());
  return true;
}

Outcome ReadingClient::Get(const std::string& name, Connection& server, v1::GetSubmapResponse& response) {
  v1::GetSubmapRequest request;
  request.set_name(name);
  return server.Ask("GetSubmap", {"SUBMAP_NOT_FOUND", "MERGED_INTO"}, [&](grpc::ClientContext* context) {
    return server.submaps->GetSubmap(context, request, &response);
  });
}

bool ReadingClient::ReadOne(const FedMap& map, Connection& server) {
  const std::int64_t id = static_cast<std::int64_t>(Random() % static_cast<std::uint64_t>(highest_id_ + 2));
  const Moment asked = ledger_.Now();
  v1::GetSubmapResponse response;
  const Outcome outcome = Get(map.name + "/submaps/" + std::to_string(id), server, response);
  if (outcome.fate == Fate::kAnswered) ledger_.OnSubmap(map.history, response.submap(), response.revision(), asked);
  if (outcome.fate == Fate::kRefused) ledger_.OnNoSubmap(map.history, id, asked);
  return outcome.fate != Fate::kCut;
}

bool ReadingClient::ReadMap(const FedMap& map, Connection& server) {
  const Moment asked = ledger_.Now();
  v1::Map summary;
  if (server.GetMap(map.name, summary).fate != Fate::kAnswered) return false;
  ledger_.OnMap(summary, asked);
  return true;
}

bool ReadingClient::ReadPages(const FedMap& map, Connection& server) {
  std::string token;
  do {
    const Moment asked = ledger_.Now();
    v1::ListSubmapsResponse page;
    if (server.List(map.name, page, kPageSize, token).fate != Fate::kAnswered) return false;
    for (const v1::Submap& submap : page.submaps()) {
      ledger_.OnSubmap(map.history, submap, page.revision(), asked);
    }
    // A token goes on being of the state that the first page was of.
    if (token.empty() && !page.next_page_token().empty()) {
      ledger_.OnPageToken(map.history, page.next_page_token(), page.revision());
    }
    token = page.next_page_token();
  } while (!token.empty() && Happens(70));
  return true;
}

bool ReadingClient::AskWithOldToken(const FedMap& map, Connection& server) {
  const auto token = ledger_.TokenToAsk(map.history, Random());
  if (!token) return ReadMap(map, server);
  v1::ListSubmapsResponse page;
  const Outcome outcome = server.List(map.name, page, kPageSize, token->token);
  if (outcome.fate == Fate::kCut) return false;
  const bool is_refused = outcome.fate == Fate::kRefused;
  ledger_.OnPage(map.history, *token, is_refused,
                 is_refused ? outcome.reason : "a page of revision " + std::to_string(page.revision()));
  return true;
}

/// If a submap has one etag before and after its voxels were streamed, they are of that state.
bool ReadingClient::ReadVoxels(const FedMap& map, Connection& server) {
  v1::ListSubmapsResponse all;
  if (server.List(map.name, all).fate != Fate::kAnswered) return false;
  const v1::Submap before = AnyOf(*all.mutable_submaps());
  v1::StreamSubmapVoxelsRequest request;
  request.set_name(before.name());
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + Connection::kTimeout);
  const auto stream = server.submaps->StreamSubmapVoxels(&context, request);
  v1::StreamSubmapVoxelsResponse part;
  std::int64_t num_voxels = 0;
  std::uint64_t digest = 0;
  while (stream->Read(&part)) {
    num_voxels += part.tsdf_m_size();
    digest += DigestOf(part);
  }
  const Outcome streamed = server.Judge("StreamSubmapVoxels", {"SUBMAP_NOT_FOUND", "MERGED_INTO"}, stream->Finish());
  if (streamed.fate != Fate::kAnswered) return streamed.fate == Fate::kRefused;
  v1::GetSubmapResponse after;
  const Outcome got = Get(before.name(), server, after);
  if (got.fate == Fate::kAnswered && after.submap().etag() == before.etag()) {
    ledger_.OnVoxels(map.history, before, std::to_string(num_voxels) + " voxels, digest " + std::to_string(digest));
  }
  return got.fate != Fate::kCut;
}

}  // namespace dhpmap::rig
