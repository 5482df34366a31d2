// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/paced/feeding_robot.h"

#include <grpcpp/grpcpp.h>

#include <thread>

#include "dhpmap/v1/mapping_service.grpc.pb.h"

namespace dhpmap::rig {

void FeedingRobot::Run(std::chrono::steady_clock::time_point first, double period_s, const std::atomic<bool>& is_over) {
  grpc::ClientContext context;
  const auto stream = v1::MappingService::NewStub(channel_)->IntegrateFrames(&context);
  std::int64_t stored = 0;
  std::thread reader([&] {
    v1::IntegrateFramesResponse answer;
    while (stream->Read(&answer)) {
      if (answer.outcome() == v1::IntegrateFramesResponse::FUSED) ++num_fused_;
      if (answer.has_committed_sequence()) stored = answer.committed_sequence();
      if (answer.has_error() && complaint_.empty()) complaint_ = map_ + ": refused: " + answer.error().message();
    }
  });
  v1::IntegrateFramesRequest request;
  request.set_map(map_);
  request.set_session("robot");
  bool is_open = stream->Write(request);
  request.Clear();
  auto due = first;
  while (is_open && !is_over) {
    std::this_thread::sleep_until(due);
    due += std::chrono::microseconds(static_cast<std::int64_t>(period_s * 1e6));
    request.set_sequence(num_sent_ + 1);
    *request.mutable_frame() = corridor_.Frame(0, num_sent_ + 1);
    is_open = stream->Write(request);
    if (is_open) ++num_sent_;
  }
  stream->WritesDone();
  reader.join();
  const grpc::Status status = stream->Finish();
  if (!status.ok()) complaint_ = map_ + ": " + status.error_message();
  if (complaint_.empty() && stored != num_sent_) complaint_ = map_ + ": not all frames are stored";
}

}  // namespace dhpmap::rig
