// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/mapping_conversion.h"

#include <google/protobuf/util/time_util.h>

#include <string>

#include "mapping/base/utf8.h"
#include "proto/types/pose_conversion.h"
#include "proto/types/resource_names.h"
#include "proto/types/status_conversion.h"
#include "server/wire/frame_conversion.h"

namespace dhpmap {
namespace {

v1::Refinement RefinementToProto(const RefinementReport& report) {
  v1::Refinement proto;
  proto.set_num_shared_voxels(report.management.num_shared_voxels);
  proto.set_num_moved_voxels(report.management.num_moved_voxels);
  proto.set_num_removed_submaps(report.management.num_removed_submaps);
  proto.set_num_skipped_submaps(report.management.num_skipped_submaps);
  proto.set_num_crf_voxels(report.crf.num_voxels);
  proto.set_num_changed_classes(report.crf.num_changed_classes);
  proto.set_num_changed_instances(report.crf.num_changed_instances);
  proto.set_num_dropped_bytes(report.num_bytes_dropped);
  proto.set_management_s(report.management_s);
  proto.set_crf_s(report.crf_s);
  return proto;
}

v1::FrameFit FitToProto(const FrameFit& fit) {
  v1::FrameFit proto;
  if (fit.agreeing_fraction) proto.set_agreeing_fraction(*fit.agreeing_fraction);
  if (fit.median_residual_m) proto.set_median_residual_m(*fit.median_residual_m);
  if (fit.valid_depth_fraction) proto.set_valid_depth_fraction(*fit.valid_depth_fraction);
  return proto;
}

void SetCheck(const FrameCheck& check, v1::IntegrateFramesResponse& ack) {
  if (check.fit) *ack.mutable_fit() = FitToProto(*check.fit);
  for (const FrameWarning& warning : check.warnings) *ack.add_warnings() = ToProto(warning);
}

}  // namespace

void SetProgress(const FeedProgress& progress, v1::IntegrateFramesResponse& answer) {
  answer.set_revision(progress.revision);
  if (progress.commit_status.ok()) answer.clear_commit_error();
  else *answer.mutable_commit_error() = ToProto(progress.commit_status);
  if (progress.committed_sequence) answer.set_committed_sequence(*progress.committed_sequence);
}

v1::IntegrateFramesResponse AnswerOf(std::int64_t sequence, const FeedProgress& progress) {
  v1::IntegrateFramesResponse answer;
  answer.set_sequence(sequence);
  SetProgress(progress, answer);
  return answer;
}

v1::IntegrateFramesResponse AckOf(std::int64_t sequence, const FrameOutcome& outcome) {
  v1::IntegrateFramesResponse ack = AnswerOf(sequence, {.revision = outcome.revision,
                                                        .committed_sequence = outcome.committed_sequence,
                                                        .commit_status = outcome.commit_status});
  ack.set_committed(outcome.is_committed);
  SetCheck(outcome.check, ack);
  if (!outcome.report.ok()) {
    ack.set_outcome(v1::IntegrateFramesResponse::REFUSED);
    *ack.mutable_error() = ToProto(InWireTerms(outcome.report.status()));
    return ack;
  }
  ack.set_outcome(outcome.is_duplicate ? v1::IntegrateFramesResponse::DUPLICATE : v1::IntegrateFramesResponse::FUSED);
  const FrameReport& report = *outcome.report;
  ack.set_num_points(report.num_points);
  ack.set_num_unknown_points(report.num_unknown_points);
  ack.set_num_segments(report.num_segments);
  ack.set_num_matched(report.num_matched);
  ack.set_num_created(report.num_created);
  ack.set_fusion_s(report.bundle_s + report.track_s + report.fuse_s);
  return ack;
}

v1::FeedSession ToProto(const SessionStatus& status, const std::string& map) {
  v1::FeedSession proto;
  if (!status.session.empty()) proto.set_name(SessionResourceName(map, status.session));
  proto.set_session(status.session);
  proto.set_feeding(status.is_feeding);
  proto.set_lease_s(status.lease_left_s);
  if (status.accepted_sequence) proto.set_accepted_sequence(*status.accepted_sequence);
  if (status.stored_sequence) proto.set_committed_sequence(*status.stored_sequence);
  const FeedCounts& counts = status.counts;
  proto.set_num_frames(counts.num_fused);
  proto.set_num_refused(counts.num_refused);
  proto.set_num_duplicates(counts.num_duplicates);
  proto.set_num_points(counts.num_points);
  proto.set_num_bytes(counts.num_bytes);
  if (counts.last_seen_ns != 0)
    *proto.mutable_last_message_time() = google::protobuf::util::TimeUtil::NanosecondsToTimestamp(counts.last_seen_ns);
  proto.set_frames_per_s(counts.frames_per_s);
  const auto places_m = status.path.places_m();
  if (!places_m.empty()) *proto.mutable_map_from_sensor() = ToProto(status.path.T_map_sensor());
  for (const Eigen::Vector3f& place_m : places_m) {
    for (const float coordinate : place_m) proto.add_packed_path_m(coordinate);
  }
  return proto;
}

v1::FinishProgress ToProto(const FinishProgress& progress) {
  v1::FinishProgress proto;
  proto.set_elapsed_s(progress.elapsed_s);
  switch (progress.stage) {
    case FinishStage::kWaiting: proto.set_stage(v1::FinishProgress::WAITING); break;
    case FinishStage::kRefining: proto.set_stage(v1::FinishProgress::REFINING); break;
    case FinishStage::kStoring: proto.set_stage(v1::FinishProgress::STORING); break;
  }
  return proto;
}

v1::FrameWarning ToProto(const FrameWarning& warning) {
  v1::FrameWarning proto;
  v1::FrameWarning::Fault fault = v1::FrameWarning::FAULT_UNSPECIFIED;
  (void)v1::FrameWarning::Fault_Parse(std::string(FaultName(warning.fault)), &fault);
  proto.set_fault(fault);
  proto.set_message(ToValidUtf8(warning.message));
  return proto;
}

v1::FinishMappingResponse ToProto(const FinishOutcome& outcome) {
  const MapSnapshot& snapshot = outcome.view->snapshot();
  v1::FinishMappingResponse proto;
  proto.set_revision(snapshot.revision());
  proto.set_num_frames(snapshot.info().num_frames);
  proto.set_num_submaps(static_cast<std::int64_t>(snapshot.submaps().size()));
  *proto.mutable_refinement() = RefinementToProto(outcome.refinement);
  return proto;
}

}  // namespace dhpmap
