// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/takeovers/paced_robot.h"

#include <grpcpp/grpcpp.h>

#include <thread>

#include "dhpmap/v1/map_service.grpc.pb.h"
#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "proto/types/metadata_keys.h"
#include "tests/support/status_reason.h"

namespace dhpmap::rig {
namespace {

using namespace std::chrono_literals;

std::shared_ptr<grpc::Channel> ConnectTo(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 200);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 50);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 200);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

std::chrono::microseconds Micros(double seconds) {
  return std::chrono::microseconds(static_cast<std::int64_t>(seconds * 1e6));
}

/// A UUID, as the servers want it.
std::string RequestId(std::int64_t number) {
  std::string digits = std::to_string(number);
  return "00000000-0000-4000-8000-" + std::string(12 - digits.size(), '0') + digits;
}

}  // namespace

void Doors::Set(std::size_t server, const std::string& address) {
  const MutexLock lock(mutex_);
  channels_[server] = {address, ConnectTo(address)};
}

std::shared_ptr<grpc::Channel> Doors::ChannelTo(std::size_t server) const {
  const MutexLock lock(mutex_);
  return channels_[server].channel;
}

std::size_t Doors::Find(const std::string& address, std::size_t otherwise) const {
  const MutexLock lock(mutex_);
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].address == address) return i;
  }
  return otherwise;
}

void PacedRobot::Run(double period_s, double timeout_s, const std::atomic<bool>& is_over) {
  constexpr std::int64_t kFramesAnEdit = 4;
  auto due = Clock::now();
  for (std::int64_t sequence = 1; !is_over; ++sequence) {
    std::this_thread::sleep_until(due);
    while (!is_over && !Send(sequence, timeout_s)) std::this_thread::sleep_for(50ms);
    const std::int64_t edit = sequence / kFramesAnEdit;
    while (!is_over && sequence % kFramesAnEdit == 0 && !Edit(edit, timeout_s)) std::this_thread::sleep_for(50ms);
    due = std::max(due + Micros(period_s), Clock::now() - Micros(period_s));
  }
}

bool PacedRobot::Send(std::int64_t sequence, double timeout_s) {
  const auto mapping = v1::MappingService::NewStub(doors_.ChannelTo(server_));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + Micros(timeout_s));
  const auto stream = mapping->IntegrateFrames(&context);
  v1::IntegrateFramesRequest request;
  request.set_map(map_);
  request.set_session("robot");
  request.set_take_over(true);
  request.set_sequence(sequence);
  *request.mutable_frame() = corridor_.Frame(0, sequence);
  v1::IntegrateFramesResponse answer, last;
  if (stream->Write(request)) stream->WritesDone();
  while (stream->Read(&answer)) last = answer;
  const grpc::Status status = stream->Finish();
  if (!status.ok()) return OnFailure(status), false;
  NoteOwner(context);
  const MutexLock lock(mutex_);
  if (last.committed_sequence() < sequence) {
    complaints_.push_back(map_ + ": ended well, and is not stored: " + last.ShortDebugString());
    return false;
  }
  last_stored_ = sequence;
  acknowledged_.push_back({sequence, Clock::now(), server_});
  return true;
}

bool PacedRobot::Edit(std::int64_t number, double timeout_s) {
  const std::string name = "edit-" + std::to_string(number);
  v1::UpdateMapRequest request;
  request.mutable_map()->set_name(map_);
  request.mutable_map()->set_display_name(name);
  request.mutable_update_mask()->add_paths("display_name");
  request.set_author(name);
  request.set_request_id(RequestId(number));
  v1::UpdateMapResponse response;
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + Micros(timeout_s));
  const auto maps = v1::MapService::NewStub(doors_.ChannelTo(server_));
  const grpc::Status status = maps->UpdateMap(&context, request, &response);
  if (!status.ok()) return OnFailure(status), false;
  NoteOwner(context);
  const MutexLock lock(mutex_);
  edit_revisions_.push_back(response.map().revision());
  acknowledged_.push_back({last_stored_, Clock::now(), server_});
  return true;
}

void PacedRobot::NoteOwner(const grpc::ClientContext& context) {
  const auto& metadata = context.GetServerInitialMetadata();
  const auto owner = metadata.find(kOwnerKey);
  if (owner == metadata.end()) return;
  const std::string text(owner->second.data(), owner->second.size());
  server_ = doors_.Find(text.substr(0, text.find(' ')), server_);
}

void PacedRobot::OnFailure(const grpc::Status& status) {
  const auto info = testing::ErrorInfoOf(status);
  const auto owner = info.metadata().find("owner");
  const std::size_t next = (server_ + step_) % doors_.size();
  if (info.reason() == "NOT_OWNER" && owner != info.metadata().end()) {
    ++num_sent_on_;
    const std::size_t to = doors_.Find(owner->second, next);
    server_ = to == server_ ? next : to;
    return;
  }
  ++num_failed_;
  if (status.error_code() != grpc::StatusCode::UNAVAILABLE &&
      status.error_code() != grpc::StatusCode::DEADLINE_EXCEEDED) {
    const MutexLock lock(mutex_);
    complaints_.push_back(map_ + ": " + std::to_string(status.error_code()) + " " + info.reason() + " " +
                          status.error_message());
  }
  server_ = next;
}

std::vector<PacedRobot::Acknowledged> PacedRobot::acknowledged() const {
  const MutexLock lock(mutex_);
  return acknowledged_;
}

std::vector<std::int64_t> PacedRobot::edit_revisions() const {
  const MutexLock lock(mutex_);
  return edit_revisions_;
}

std::vector<std::string> PacedRobot::complaints() const {
  const MutexLock lock(mutex_);
  return complaints_;
}

}  // namespace dhpmap::rig
