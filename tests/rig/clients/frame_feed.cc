// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/clients/frame_feed.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "clients/cli/frame_message.h"
#include "clients/cli/new_map.h"
#include "clients/datasets/dataset.h"
#include "clients/datasets/open_dataset.h"
#include "dhpmap/v1/map_service.grpc.pb.h"

namespace dhpmap::rig {

Result<std::vector<v1::Frame>> ReadFrames(const std::string& directory) {
  DHPMAP_ASSIGN_OR_RETURN(const auto dataset, OpenDataset(directory, kAnyFormat, LabelSource::kPredicted));
  std::vector<v1::Frame> frames;
  for (std::size_t i = 0; i < dataset->num_frames(); ++i) {
    DHPMAP_ASSIGN_OR_RETURN(const DatasetFrame frame, dataset->Read(i));
    frames.push_back(ToMessage(frame, dataset->has_persistent_ids()));
  }
  return frames;
}

grpc::Status FeedUntil(v1::MappingService::Stub& stub, const std::string& map_id, const std::vector<v1::Frame>& frames,
                       double rate_hz, const std::stop_token& stop, Latencies& gaps) {
  grpc::ClientContext context;
  const auto stream = stub.IntegrateFrames(&context);
  std::thread sender([&] {
    const std::chrono::duration<double> period(rate_hz > 0 ? 1 / rate_hz : 0);
    auto next = std::chrono::steady_clock::now();
    v1::IntegrateFramesRequest request;
    request.set_map("maps/" + map_id);
    for (std::size_t i = 0; !stop.stop_requested(); ++i) {
      request.set_sequence(static_cast<std::int64_t>(i));
      *request.mutable_frame() = frames[i % frames.size()];
      if (!stream->Write(request)) break;
      next = std::max(next + std::chrono::duration_cast<std::chrono::steady_clock::duration>(period),
                      std::chrono::steady_clock::now() - std::chrono::seconds(1));  // one that was late is no flood
      std::this_thread::sleep_until(next);
    }
    stream->WritesDone();
  });
  v1::IntegrateFramesResponse answer;
  auto last = std::chrono::steady_clock::now();
  bool is_first = true;
  while (stream->Read(&answer)) {
    if (answer.outcome() == v1::IntegrateFramesResponse::FRAME_OUTCOME_UNSPECIFIED) continue;
    if (answer.outcome() == v1::IntegrateFramesResponse::REFUSED) gaps.AddFailure();
    const auto now = std::chrono::steady_clock::now();
    if (!std::exchange(is_first, false)) gaps.Add(std::chrono::duration<double>(now - last).count());
    last = now;
  }
  sender.join();
  return stream->Finish();
}

FeedOutcome FeedOnce(v1::MappingService::Stub& stub, const std::string& map_id, const std::string& session,
                     const std::vector<const v1::Frame*>& frames) {
  FeedOutcome outcome;
  grpc::ClientContext context;
  const auto stream = stub.IntegrateFrames(&context);
  const auto begin = std::chrono::steady_clock::now();
  std::thread sender([&] {
    v1::IntegrateFramesRequest request;
    request.set_map("maps/" + map_id);
    request.set_session(session);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      request.set_sequence(static_cast<std::int64_t>(i));
      *request.mutable_frame() = *frames[i];
      if (!stream->Write(request)) break;
    }
    stream->WritesDone();
  });
  v1::IntegrateFramesResponse answer;
  while (stream->Read(&answer)) {
    if (answer.outcome() == v1::IntegrateFramesResponse::FRAME_OUTCOME_UNSPECIFIED) continue;
    ++(answer.outcome() == v1::IntegrateFramesResponse::FUSED ? outcome.num_fused : outcome.num_others);
    outcome.fuse_s += answer.fusion_s();
  }
  outcome.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  sender.join();
  outcome.status = stream->Finish();
  return outcome;
}

Status CreateMapFor(const std::string& directory, const std::string& map_id,
                    const std::shared_ptr<grpc::Channel>& channel) {
  DHPMAP_ASSIGN_OR_RETURN(const auto dataset, OpenDataset(directory, kAnyFormat, LabelSource::kPredicted));
  NewMap map;
  map.name = map_id;
  DHPMAP_ASSIGN_OR_RETURN(const v1::CreateMapRequest request, ToRequest(map, dataset.get()));
  grpc::ClientContext context;
  v1::CreateMapResponse response;
  const grpc::Status status = v1::MapService::NewStub(channel)->CreateMap(&context, request, &response);
  return status.ok() ? Status::Ok() : FailedPrecondition("CreateMap: " + status.error_message());
}

}  // namespace dhpmap::rig
