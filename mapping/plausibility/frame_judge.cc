// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/plausibility/frame_judge.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "mapping/plausibility/fault_search.h"
#include "mapping/plausibility/frame_sample.h"
#include "mapping/plausibility/map_fit.h"

namespace dhpmap {
namespace {

constexpr std::size_t kMostSessions = 16;
constexpr std::size_t kMostViews = 4;
/// Views nearer to each other tell no more than one of them.
constexpr double kApart_m = 0.15, kApart_rad = 0.14;

/// Fewer tell nothing.
constexpr std::size_t kLeastPoints = 20;
/// Depth in millimetres: next to no return is in range, and most are if they are taken for that.
constexpr double kNearlyNone = 0.02, kMost = 0.5;

bool AreApart(const Transform& a, const Transform& b) {
  const Transform between = a.inverse() * b;
  return between.translation().norm() > kApart_m || Eigen::AngleAxisd(between.linear()).angle() > kApart_rad;
}

FrameFit ToFrameFit(MapFit& fit, std::size_t num_returns) {
  FrameFit out;
  if (num_returns > 0) out.valid_depth_fraction = Share(fit.num_points, num_returns);
  if (fit.num_known() >= kLeastPoints) out.agreeing_fraction = fit.AgreeingFraction();
  if (fit.residuals_m.size() >= kLeastPoints) {
    const auto middle = fit.residuals_m.begin() + static_cast<std::ptrdiff_t>(fit.residuals_m.size() / 2);
    std::nth_element(fit.residuals_m.begin(), middle, fit.residuals_m.end());
    out.median_residual_m = *middle;
  }
  return out;
}

bool IsDepthInMillimetres(const FrameSample& sample, const SensorClaim& claim, std::size_t num_in_range,
                          const IntegrationConfig& config) {
  if (sample.num_returns() < kLeastPoints || Share(num_in_range, sample.num_returns()) > kNearlyNone) return false;
  const SensorClaim right = Corrected(claim, FrameFault::kDepthInMillimetres);
  return Share(sample.PointsInRange(right, config).size(), sample.num_returns()) >= kMost;
}

void Warn(FrameFault fault, FrameCheck& check) { check.warnings.push_back({fault, std::string(FaultText(fault))}); }

}  // namespace

void FrameJudge::Session::Remember(const PanopticFrame& frame) {
  if (!frame.camera) return;
  const std::size_t n = views.size();
  if (n >= 2 && !AreApart(views[n - 1].claim().T_map_sensor, views[n - 2].claim().T_map_sensor)) views.pop_back();
  views.emplace_back(frame);
  if (views.size() > kMostViews) views.pop_front();
}

FrameJudge::Session& FrameJudge::SessionOf(const std::string& name) {
  const auto found =
      std::find_if(sessions_.begin(), sessions_.end(), [&](const Session& session) { return session.name == name; });
  if (found != sessions_.end()) {
    sessions_.splice(sessions_.begin(), sessions_, found);
  } else {
    sessions_.push_front({.name = name});
    if (sessions_.size() > kMostSessions) sessions_.pop_back();
  }
  return sessions_.front();
}

FrameCheck FrameJudge::Judge(const PanopticFrame& frame, const Map& map) {
  const IntegrationConfig& config = map.info().config.integration;
  Session& session = SessionOf(frame.session);
  const SensorClaim claim = SensorClaim::Of(frame);
  const FrameSample sample(frame);
  const auto points_m = sample.PointsInRange(claim, config);
  MapFit fit = FitToMap(points_m, claim.T_map_sensor, map);
  FrameCheck check{.fit = ToFrameFit(fit, sample.num_returns())};
  if (auto fault = FindFault({sample, claim, points_m, session.views, map, fit}))
    check.warnings.push_back(*std::move(fault));
  if (IsDepthInMillimetres(sample, claim, points_m.size(), config)) Warn(FrameFault::kDepthInMillimetres, check);
  const std::int64_t last_ns = session.last_stamp_ns.value_or(std::numeric_limits<std::int64_t>::min());
  if (session.last_stamp_ns && frame.stamp_ns == last_ns) Warn(FrameFault::kStampRepeated, check);
  else if (frame.stamp_ns < last_ns) Warn(FrameFault::kStampWentBack, check);
  session.Remember(frame);
  return check;
}

void FrameJudge::NoteFused(const PanopticFrame& frame) { SessionOf(frame.session).last_stamp_ns = frame.stamp_ns; }

void FrameJudge::ForgetStamp(const std::string& session) { SessionOf(session).last_stamp_ns.reset(); }

}  // namespace dhpmap
