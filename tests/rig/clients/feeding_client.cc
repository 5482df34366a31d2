// SPDX-License-Identifier: BSD-3-Clause
#include <deque>

#include "tests/rig/clients/clients.h"

namespace dhpmap::rig {
namespace {

constexpr const char* kSession = "robot";
constexpr std::size_t kMaxInFlight = 3;

}  // namespace

void FeedingClient::Run(const Life& life) {
  Connection server(life, ledger_);
  while (FeedOneStream(life, server)) {
    if (Happens(30) && !FinishMapping(life.maps[map_], server)) return;
  }
}

bool FeedingClient::FeedOneStream(const Life& life, Connection& server) {
  const FedMap& map = life.maps[map_];
  const Moment asked = ledger_.Now();
  v1::Map summary;
  if (server.GetMap(map.name, summary).fate != Fate::kAnswered) return false;
  ledger_.OnMap(summary, asked);

  const CallUnderWay counted(life.under_way, Phase::kMapping);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + Connection::kTimeout);
  const auto stream = server.mapping->IntegrateFrames(&context);
  v1::IntegrateFramesRequest opening;
  opening.set_map(map.name);
  opening.set_session(kSession);
  v1::IntegrateFramesResponse greeting;
  bool goes_on = stream->Write(opening) && stream->Read(&greeting);
  if (goes_on) {
    const auto stored = greeting.has_committed_sequence() ? std::optional(greeting.committed_sequence()) : std::nullopt;
    ledger_.OnResumed(map.history, kSession, stored, summary.num_frames());
    goes_on = SendFrames(life, stored.value_or(-1) + 1, *stream);
  }
  if (!goes_on) context.TryCancel();  // a refused frame; or the connection is lost, and this changes nothing
  return server.Judge("IntegrateFrames", {}, stream->Finish()).fate == Fate::kAnswered && goes_on;
}

bool FeedingClient::SendFrames(const Life& life, std::int64_t first, Stream& stream) {
  const FedMap& map = life.maps[map_];
  const std::int64_t end = first + 10 + Any(60);
  std::deque<Moment> waiting;
  std::int64_t next_ack = first;
  for (std::int64_t sequence = first; sequence < end; ++sequence) {
    v1::IntegrateFramesRequest request;
    request.set_sequence(sequence);
    *request.mutable_frame() = corridor_.Frame(life.number, sequence);
    waiting.push_back(ledger_.Now());
    if (!stream.Write(request)) return false;
    if (waiting.size() < kMaxInFlight) continue;
    if (!ReadAck(map, next_ack++, waiting.front(), stream)) return false;
    waiting.pop_front();
  }
  stream.WritesDone();
  for (const Moment asked : waiting) {
    if (!ReadAck(map, next_ack++, asked, stream)) return false;
  }
  v1::IntegrateFramesResponse last;
  if (!stream.Read(&last)) return false;
  ledger_.OnStored(map.history, kSession, last.committed_sequence());
  if (last.committed_sequence() != end - 1) {
    ledger_.Complain("law 4: a stream ended well, but not all of it is stored: " + last.ShortDebugString());
  }
  return true;
}

bool FeedingClient::ReadAck(const FedMap& map, std::int64_t sequence, Moment asked, Stream& stream) {
  v1::IntegrateFramesResponse ack;
  if (!stream.Read(&ack)) return false;
  ledger_.OnRevision(map.history, ack.revision(), asked);
  if (ack.has_committed_sequence()) ledger_.OnStored(map.history, kSession, ack.committed_sequence());
  if (ack.sequence() == sequence && ack.outcome() == v1::IntegrateFramesResponse::FUSED) return true;
  ledger_.Complain("frame " + std::to_string(sequence) + " was not fused: " + ack.ShortDebugString());
  return false;
}

bool FeedingClient::FinishMapping(const FedMap& map, Connection& server) {
  v1::FinishMappingRequest request;
  request.set_map(map.name);
  v1::FinishMappingResponse response;
  const Moment asked = ledger_.Now();
  const Outcome outcome = server.Ask("FinishMapping", {"TOO_MANY_EDITS"}, [&](grpc::ClientContext* context) {
    return server.mapping->FinishMapping(context, request, &response);
  });
  if (outcome.fate == Fate::kAnswered) ledger_.OnFinished(map.history, response.revision(), asked);
  return outcome.fate != Fate::kCut;
}

}  // namespace dhpmap::rig
