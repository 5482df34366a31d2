// SPDX-License-Identifier: BSD-3-Clause
#include <csignal>
#include <cstdio>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "tests/rig/attacks/unread_loads.h"
#include "tests/rig/rig.h"

namespace dhpmap::rig {

void RunBulkClients(const Target& target, int num_clients) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::vector<std::unique_ptr<BulkCalls>> clients;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < num_clients; ++i) {
      BulkCalls& calls = *clients.emplace_back(std::make_unique<BulkCalls>(target));
      threads.emplace_back([&calls, i](const std::stop_token& stop) { calls.Run(i, stop); });
    }
    int signal = 0;
    sigwait(&signals, &signal);
  }
  int num_calls = 0, num_failures = 0;
  std::map<std::string, int> failures;
  for (const auto& client : clients) {
    num_calls += client->num_calls(), num_failures += client->num_failures();
    for (const auto& [what, count] : client->failures()) failures[what] += count;
  }
  std::printf("beside them: %d clients, %d bulk calls, %d not answered as they should\n", num_clients, num_calls,
              num_failures);
  for (const auto& [what, count] : failures) std::printf("        %d times %s\n", count, what.c_str());
}

namespace {

/// Calls that have begun; nothing reads their answers.
struct Stalled {
  struct Query {
    std::unique_ptr<grpc::ClientAsyncResponseReader<v1::QueryPointsResponse>> reader;
    v1::QueryPointsResponse response;
    grpc::Status status;
  };
  grpc::CompletionQueue queue;
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  std::vector<std::unique_ptr<Query>> points;
  std::vector<std::unique_ptr<grpc::ClientReader<v1::GetSubmapMeshResponse>>> meshes;
};

}  // namespace

void RunStalledClient(const Target& target, Stall stall, int num_calls) {
  if (stall == Stall::kQueryStreams) return HoldQueryStreams(target, num_calls);
  if (stall == Stall::kWatches) return HoldWatches(target, num_calls);
  constexpr int kPoints = 400'000, kCallsPerConnection = 16;
  const v1::QueryPointsRequest points = PointsEverywhere(target.map_id, kPoints);
  v1::GetSubmapMeshRequest mesh;
  mesh.set_name("maps/" + target.map_id);
  Stalled stalled;
  std::shared_ptr<grpc::Channel> channel;
  for (int i = 0; i < num_calls; ++i) {
    if (i % kCallsPerConnection == 0) channel = OwnChannel(target.grpc_address);
    stalled.contexts.push_back(std::make_unique<grpc::ClientContext>());
    grpc::ClientContext& context = *stalled.contexts.back();
    if (stall == Stall::kMeshes) {
      stalled.meshes.push_back(v1::SubmapService::NewStub(channel)->GetSubmapMesh(&context, mesh));
      v1::GetSubmapMeshResponse part;
      (void)stalled.meshes.back()->Read(&part);
    } else {
      Stalled::Query& query = *stalled.points.emplace_back(std::make_unique<Stalled::Query>());
      query.reader = v1::QueryService::NewStub(channel)->AsyncQueryPoints(&context, points, &stalled.queue);
      query.reader->Finish(&query.response, &query.status, &query);
    }
  }
  if (stall == Stall::kPoints) {  // until the first is answered, so that what they ask for is sent
    void* tag = nullptr;
    bool ok = false;
    (void)stalled.queue.Next(&tag, &ok);
  }
  raise(SIGSTOP);
}

}  // namespace dhpmap::rig
