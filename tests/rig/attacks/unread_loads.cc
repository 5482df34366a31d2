// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/attacks/unread_loads.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>
#include <vector>

#include "dhpmap/v1/edit_service.grpc.pb.h"
#include "dhpmap/v1/watch_service.grpc.pb.h"
#include "tests/rig/at_once.h"
#include "tests/rig/server_under_test.h"
#include "tests/unit/server/http/http_client.h"

namespace dhpmap::rig {
namespace {

constexpr int kStreamsPerConnection = 16;
constexpr std::size_t kName_bytes = 256;  // as long as a name may be
constexpr std::chrono::milliseconds kBetweenEdits{50};

std::vector<std::shared_ptr<grpc::Channel>> ChannelsFor(const Target& target, int num_streams) {
  std::vector<std::shared_ptr<grpc::Channel>> channels(
      static_cast<std::size_t>((num_streams + kStreamsPerConnection - 1) / kStreamsPerConnection));
  for (auto& channel : channels) channel = OwnChannel(target.grpc_address);
  return channels;
}

/// Renames all things and stuff of the map, as one edit.
v1::ApplyEditsRequest RenameAll(const v1::ListSubmapsResponse& all, const std::string& map, const std::string& name) {
  v1::ApplyEditsRequest request;
  request.set_map(map);
  for (const v1::Submap& submap : all.submaps()) {
    if (submap.instance_id() == 0) continue;
    v1::Edit* edit = request.add_edits();
    edit->set_submap(submap.name());
    edit->mutable_rename()->set_display_name(name);
  }
  return request;
}

std::unique_ptr<http::HttpClient> WatchOverRest(const Target& target) {
  auto watcher = std::make_unique<http::HttpClient>(target.http_port);
  watcher->SendRaw("GET /v1/maps/" + target.map_id +
                   ":watch?start_revision=1 HTTP/1.1\r\nHost: localhost\r\nAccept: text/event-stream\r\n\r\n");
  return watcher;
}

}  // namespace

void HoldQueryStreams(const Target& target, int num_streams) {
  constexpr int kPointsAQuery = 200'000;
  const auto channels = ChannelsFor(target, num_streams);
  v1::StreamQueriesRequest pin, query;
  pin.mutable_pin()->set_map("maps/" + target.map_id);
  *query.mutable_query_points() = PointsEverywhere(target.map_id, kPointsAQuery);
  AtOnce(num_streams, [&](int i) {
    grpc::ClientContext context;
    const auto stub = v1::QueryService::NewStub(channels[static_cast<std::size_t>(i / kStreamsPerConnection)]);
    const auto stream = stub->StreamQueries(&context);
    bool goes_on = stream->Write(pin);
    while (goes_on) goes_on = stream->Write(query);  // stands still where the server takes no more
  });
}

void HoldWatches(const Target& target, int num_watches) {
  const auto channels = ChannelsFor(target, num_watches);
  v1::WatchMapRequest request;
  request.set_map("maps/" + target.map_id);
  request.set_start_revision(1);
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  std::vector<std::unique_ptr<grpc::ClientReader<v1::WatchMapResponse>>> watches;
  contexts.reserve(static_cast<std::size_t>(num_watches));
  watches.reserve(static_cast<std::size_t>(num_watches));
  for (int i = 0; i < num_watches; ++i) {
    contexts.push_back(std::make_unique<grpc::ClientContext>());
    const auto stub = v1::WatchService::NewStub(channels[static_cast<std::size_t>(i / kStreamsPerConnection)]);
    watches.push_back(stub->WatchMap(contexts.back().get(), request));
  }
  pause();
}

bool EditWhileNobodyReads(const Target& target, int num_watches, double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  std::vector<std::unique_ptr<http::HttpClient>> watchers;
  watchers.reserve(static_cast<std::size_t>(num_watches));
  for (int i = 0; i < num_watches; ++i) watchers.push_back(WatchOverRest(target));
  const auto channel = OwnChannel(target.grpc_address);
  v1::ListSubmapsRequest list;
  list.set_parent("maps/" + target.map_id);
  v1::ListSubmapsResponse all;
  grpc::ClientContext context;
  grpc::Status status = v1::SubmapService::NewStub(channel)->ListSubmaps(&context, list, &all);
  const auto edits = v1::EditService::NewStub(channel);
  int num_edits = 0;
  for (; status.ok() && std::chrono::steady_clock::now() < end; ++num_edits) {
    grpc::ClientContext editing;
    v1::ApplyEditsResponse edited;
    const std::string name(kName_bytes, num_edits % 2 == 0 ? 'a' : 'b');
    status = edits->ApplyEdits(&editing, RenameAll(all, list.parent(), name), &edited);
    std::this_thread::sleep_for(kBetweenEdits);
  }
  std::printf("        %d edits of %d objects each meanwhile\n", num_edits, all.submaps_size());
  if (!status.ok()) std::printf("FAILED: an edit: %s\n", status.error_message().c_str());
  return status.ok();
}

}  // namespace dhpmap::rig
