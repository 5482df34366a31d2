// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/replay_streams.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "clients/cpp/calls/error.h"

namespace dhpmap {
namespace {

constexpr int kMaxUnanswered = 4;
/// A server accepts 16 at once by default, and other clients may feed other maps.
constexpr std::size_t kMaxStreams = 8;

}  // namespace

ReplayStreams::ReplayStreams(std::shared_ptr<client::Caller> caller, std::string map, OnAnswer on_answer)
    : caller_(std::move(caller)), map_(std::move(map)), on_answer_(std::move(on_answer)) {}

ReplayStreams::~ReplayStreams() {
  for (auto& [session, stream] : streams_) {
    stream->context.TryCancel();
    (void)stream->calls->Finish();
  }
}

client::Status ReplayStreams::Send(const std::string& session, std::int64_t sequence,
                                   v1::IntegrateFramesRequest request) {
  const auto found = streams_.find(session);
  if (found == streams_.end() || found->second.get() != last_) {
    if (client::Status status = Drain(); !status.ok()) return status;
  }
  const bool is_new = found == streams_.end();
  if (is_new) {
    if (client::Status status = MakeRoomFor(session); !status.ok()) return status;
    auto stream = std::make_unique<Stream>();
    caller_->Introduce(stream->context);
    stream->calls = caller_->stub<v1::MappingService::Stub>().IntegrateFrames(&stream->context);
    streams_.emplace(session, std::move(stream));
  }
  Stream& stream = *streams_.at(session);
  last_ = &stream;
  stream.last_used = ++num_sent_;
  request.set_map(is_new ? map_ : "");
  request.set_session(is_new ? session : "");
  request.set_take_over(false);
  request.set_refuse_implausible(false);  // frames that were refused then are not sent
  request.set_sequence(sequence);
  ++stream.num_unanswered;
  if (!stream.calls->Write(request)) return Hear(stream);  // the stream has ended with a status
  while (stream.num_unanswered >= kMaxUnanswered) {
    if (client::Status status = Hear(stream); !status.ok()) return status;
  }
  return {};
}

client::Status ReplayStreams::Hear(Stream& stream) {
  v1::IntegrateFramesResponse answer;
  while (stream.calls->Read(&answer)) {
    if (answer.outcome() == v1::IntegrateFramesResponse::FRAME_OUTCOME_UNSPECIFIED) continue;
    --stream.num_unanswered;
    on_answer_(answer);
    return {};
  }
  client::Status status = caller_->StatusOf(stream.calls->Finish());
  const auto is_it = [&stream](const auto& entry) { return entry.second.get() == &stream; };
  if (last_ == &stream) last_ = nullptr;
  streams_.erase(std::find_if(streams_.begin(), streams_.end(), is_it));
  if (status.ok()) {
    status = client::Error(client::StatusCode::kInternal, "the server has ended the stream before its last answer");
  }
  return status;
}

client::Status ReplayStreams::Drain() {
  while (last_ != nullptr && last_->num_unanswered > 0) {
    if (client::Status status = Hear(*last_); !status.ok()) return status;
  }
  return {};
}

/// A stream without a session must be the only one; of the others the least recently used is closed.
client::Status ReplayStreams::MakeRoomFor(const std::string& session) {
  std::vector<std::string> in_the_way;
  for (const auto& [name, stream] : streams_) {
    if (name.empty() || session.empty()) in_the_way.push_back(name);
  }
  if (in_the_way.empty() && streams_.size() >= kMaxStreams) {
    const auto oldest = std::min_element(streams_.begin(), streams_.end(), [](const auto& a, const auto& b) {
      return a.second->last_used < b.second->last_used;
    });
    in_the_way.push_back(oldest->first);
  }
  for (const std::string& name : in_the_way) {
    if (client::Status status = CloseOne(name); !status.ok()) return status;
  }
  return {};
}

client::Status ReplayStreams::CloseOne(const std::string& session) {
  const auto stream = std::move(streams_.extract(session).mapped());
  if (last_ == stream.get()) last_ = nullptr;
  stream->calls->WritesDone();
  v1::IntegrateFramesResponse answer;
  while (stream->calls->Read(&answer)) {
    if (answer.outcome() != v1::IntegrateFramesResponse::FRAME_OUTCOME_UNSPECIFIED) on_answer_(answer);
  }
  return caller_->StatusOf(stream->calls->Finish());
}

client::Status ReplayStreams::Close() {
  client::Status status = Drain();
  while (status.ok() && !streams_.empty()) status = CloseOne(streams_.begin()->first);
  return status;
}

}  // namespace dhpmap
