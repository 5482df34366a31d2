// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/ack_summary.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <nlohmann/json.hpp>

#include "clients/cli/text_table.h"
#include "proto/types/status_conversion.h"

namespace dhpmap {

bool AckSummary::Count(Kinds& kinds, const std::string& reason, const std::string& message) {
  std::string key = reason + ": " + message;
  std::erase_if(key, [](unsigned char c) { return std::isdigit(c) != 0; });
  Kind& entry = kinds[key];
  if (entry.count++ > 0) return false;
  entry.reason = reason;
  entry.first_message = message;
  return true;
}

bool AckSummary::AddSkipped(const Status& why) {
  const MutexLock lock(mutex_);
  ++num_skipped_;
  const std::string kind(why.reason().empty() ? StatusCodeName(why.code()) : why.reason().name());
  return Count(skipped_, kind, why.message());
}

bool AckSummary::AddAck(const v1::IntegrateFramesResponse& ack) {
  const MutexLock lock(mutex_);
  revision_ = std::max(revision_, ack.revision());
  if (ack.has_committed_sequence()) committed_ = ack.committed_sequence();
  if (ack.has_error()) {
    ++num_refused_;
    const std::string code(StatusCodeName(static_cast<StatusCode>(ack.error().code())));
    const std::string reason = ReadErrorDetails(ack.error().SerializeAsString()).reason;
    return Count(refused_, reason.empty() ? code : reason, ack.error().message());
  }
  const bool is_new = taken_.insert(ack.sequence()).second;
  if (ack.outcome() == v1::IntegrateFramesResponse::DUPLICATE && is_new) ++num_duplicates_;
  if (ack.outcome() == v1::IntegrateFramesResponse::DUPLICATE ||
      (ack.outcome() == v1::IntegrateFramesResponse::FUSED && !is_new))
    return false;
  ++num_fused_;
  num_created_ += static_cast<std::size_t>(ack.num_created());
  num_points_ += ack.num_points();
  num_unknown_points_ += ack.num_unknown_points();
  fuse_s_ += ack.fusion_s();
  return false;
}

std::vector<std::string> AckSummary::AddWarnings(const v1::IntegrateFramesResponse& ack) {
  std::vector<std::string> fresh;
  if (ack.outcome() != v1::IntegrateFramesResponse::FUSED || ack.warnings().empty()) return fresh;
  const MutexLock lock(mutex_);
  ++num_doubtful_;
  for (const v1::FrameWarning& warning : ack.warnings()) {
    Kind& kind = doubtful_[v1::FrameWarning::Fault_Name(warning.fault())];
    if (kind.count++ > 0) continue;
    kind.reason = v1::FrameWarning::Fault_Name(warning.fault());
    kind.first_message = warning.message();
    fresh.push_back(warning.message());
  }
  return fresh;
}

void AckSummary::AddProgress(const v1::IntegrateFramesResponse& answer) {
  const MutexLock lock(mutex_);
  revision_ = std::max(revision_, answer.revision());
  if (answer.has_committed_sequence()) committed_ = answer.committed_sequence();
}

void AckSummary::SetStoredBefore(std::size_t num_frames) {
  const MutexLock lock(mutex_);
  num_stored_before_ = num_frames;
}

void AckSummary::SetAllStored() {
  const MutexLock lock(mutex_);
  if (!taken_.empty()) committed_ = *taken_.rbegin();
}

std::size_t AckSummary::NumStored() const {
  if (!committed_) return num_stored_before_;
  return num_stored_before_ + static_cast<std::size_t>(std::distance(taken_.begin(), taken_.upper_bound(*committed_)));
}

std::size_t AckSummary::num_stored() const {
  const MutexLock lock(mutex_);
  return NumStored();
}
std::size_t AckSummary::num_done() const {
  const MutexLock lock(mutex_);
  return num_fused_ + num_duplicates_ + num_stored_before_ + num_refused_ + num_skipped_;
}
std::size_t AckSummary::num_fused() const {
  const MutexLock lock(mutex_);
  return num_fused_;
}
std::size_t AckSummary::num_refused() const {
  const MutexLock lock(mutex_);
  return num_refused_;
}
std::size_t AckSummary::num_created() const {
  const MutexLock lock(mutex_);
  return num_created_;
}

void AckSummary::PrintKinds(std::ostream& out, const Kinds& kinds, const char* what) {
  for (const auto& [key, kind] : kinds) {
    out << kind.count << " " << what << ", " << kind.reason << ": " << kind.first_message
        << (kind.count > 1 ? ", ..." : "") << "\n";
  }
}

void AckSummary::Print(std::ostream& out, double elapsed_s) const {
  const MutexLock lock(mutex_);
  out << num_fused_ << " frames fused";
  if (num_fused_ > 0) {
    const auto num_frames = static_cast<double>(num_fused_);
    out << " in " << Fixed(elapsed_s, 1) << " s (" << Fixed(num_frames / elapsed_s, 1) << " frames/s; "
        << Fixed(1e3 * fuse_s_ / num_frames, 1) << " ms a frame in the server's pipeline)";
  }
  out << "\n";
  if (!taken_.empty() || num_stored_before_ > 0) {
    out << NumStored() << " frames stored";
    if (num_stored_before_ > 0) out << ", " << num_stored_before_ << " of them before";
    out << "\n";
  }
  if (num_points_ > 0) {
    out << num_points_ << " points, "
        << Fixed(100.0 * static_cast<double>(num_unknown_points_) / static_cast<double>(num_points_), 1)
        << " % of them of unknown objects\n";
  }
  PrintKinds(out, skipped_, "skipped");
  PrintKinds(out, refused_, "refused");
  PrintKinds(out, doubtful_, "fused with a warning");
}

std::string AckSummary::Json(const v1::Map& map, double elapsed_s) const {
  const MutexLock lock(mutex_);
  const auto kinds = [](const Kinds& in) {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& [key, kind] : in) {
      list.push_back({{"reason", kind.reason}, {"count", kind.count}, {"firstMessage", kind.first_message}});
    }
    return list;
  };
  const nlohmann::json summary{{"map", map.name()},
                               {"revision", std::max(revision_, map.revision())},
                               {"numSubmaps", map.num_submaps()},
                               {"numFused", num_fused_},
                               {"numStored", NumStored()},
                               {"numSkipped", num_skipped_},
                               {"numRefused", num_refused_},
                               {"numDoubtful", num_doubtful_},
                               {"numPoints", num_points_},
                               {"numUnknownPoints", num_unknown_points_},
                               {"elapsedS", elapsed_s},
                               {"fuseS", fuse_s_},
                               {"skipped", kinds(skipped_)},
                               {"refused", kinds(refused_)},
                               {"doubtful", kinds(doubtful_)}};
  return summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace dhpmap
