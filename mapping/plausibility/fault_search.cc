// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/plausibility/fault_search.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace dhpmap {
namespace {

// Shares of the sample. Frames of real and rendered recordings have agreed with their maps by .88 at least, and .02 of
// their points at most lay before what an earlier view had seen; with one of the mistakes these are .7 and .1 to .6,
// and corrected .95 and 0.
constexpr double kDoubtfulAgreement = 0.8;   ///< with the map; below it, other explanations are tried
constexpr double kLeastKnown = 0.2;          ///< of the frame, or the map says nothing
constexpr double kDoubtfulBefore = 0.08;     ///< of an earlier view
constexpr double kExplainedAgreement = 0.9;  ///< of what is seen, once a mistake is corrected
constexpr double kExplainedSeen = 0.5;
constexpr double kGain = 0.25;           ///< of agreement over the frame as it is
constexpr double kLead = 0.1;            ///< over the next best explanation
constexpr double kWrongAgreement = 0.6;  ///< with the map: the frame alone is wrong; a road agrees wherever it is
constexpr std::size_t kFewPoints = 40;   ///< with fewer, no mistake is reported
// Where no mistake explains it. What comes before a camera hides surfaces, and shows none behind; floors and ceilings
// agree wherever the camera is.
constexpr double kUnexplainedAgreement = 0.7;
constexpr double kUnexplainedKnown = 0.3;
constexpr double kUnexplainedSeenThrough = 0.2;

/// Nobody moves so far from frame to frame, in metres and in ranges of the sensor.
constexpr double kJump_m = 20, kJump_ranges = 4;

/// How much of the sample agrees.
struct Explanation {
  FrameFault fault = FrameFault::kDisagrees;
  double agreeing = 0;
};

/// The best so far, and by how much.
struct Explanations {
  Explanation best;
  double next = 0;

  void Add(const Explanation& other) {
    next = std::max(next, std::min(other.agreeing, best.agreeing));
    if (other.agreeing > best.agreeing) best = other;
  }
};

std::string Percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

FrameWarning WarningOf(const Explanation& explanation, double agreeing_now, const char* with) {
  return {explanation.fault, std::string(FaultText(explanation.fault)) + "; " + Percent(agreeing_now) +
                                 " of what the frame shows agrees with " + with + ", corrected " +
                                 Percent(explanation.agreeing)};
}

/// Whether the translation is that of one who sends millimetres.
bool IsJump(const Transform& from, const Transform& to, const Map& map) {
  const double far_m = std::max(kJump_m, kJump_ranges * map.info().config.integration.max_range_m);
  return (from.translation() - to.translation()).norm() > far_m;
}

bool IsDoubtful(const MapFit& fit) {
  return fit.num_points >= kFewPoints && fit.KnownFraction() >= kLeastKnown &&
         fit.AgreeingFraction() < kDoubtfulAgreement;
}

/// Both frames are corrected.
std::optional<FrameWarning> FindShared(const FrameEvidence& evidence, const EarlierView& view) {
  const SensorClaim& claim = evidence.claim;
  const ViewFit now = view.FitOf(evidence.points_m, claim.T_map_sensor, view.claim());
  const double agreeing_now = Share(now.num_agreeing, now.num_points);
  const bool is_jump = IsJump(view.claim().T_map_sensor, claim.T_map_sensor, evidence.map);
  const bool is_doubtful = IsDoubtful(evidence.fit) || Share(now.num_before, now.num_points) >= kDoubtfulBefore;
  if (!is_doubtful && !is_jump) return std::nullopt;
  Explanations found;
  for (const FrameFault fault : GeometricFaults(claim)) {
    if (fault == FrameFault::kTranslationInMillimetres ? !is_jump : !is_doubtful) continue;
    const SensorClaim right = Corrected(claim, fault);
    const auto right_points_m = evidence.sample.PointsInRange(right, evidence.map.info().config.integration);
    if (right_points_m.size() < kFewPoints) continue;
    const ViewFit fit = view.FitOf(right_points_m, right.T_map_sensor, Corrected(view.claim(), fault));
    const bool explains = Share(fit.num_seen(), fit.num_points) >= kExplainedSeen &&
                          Share(fit.num_agreeing, fit.num_seen()) >= kExplainedAgreement;
    found.Add({explains ? fault : FrameFault::kDisagrees, Share(fit.num_agreeing, fit.num_points)});
  }
  const Explanation& best = found.best;
  if (best.fault == FrameFault::kDisagrees || best.agreeing < agreeing_now + kGain) return std::nullopt;
  if (best.agreeing < found.next + kLead) return std::nullopt;
  return WarningOf(best, agreeing_now, "a frame before it");
}

/// The map is right.
std::optional<FrameWarning> FindOwn(const FrameEvidence& evidence) {
  const MapFit& now = evidence.fit;
  const SensorClaim& claim = evidence.claim;
  const bool is_wrong = IsDoubtful(now) && now.AgreeingFraction() < kWrongAgreement;
  const SensorClaim in_metres = Corrected(claim, FrameFault::kTranslationInMillimetres);
  const bool is_far = now.num_known() == 0 && IsJump(in_metres.T_map_sensor, claim.T_map_sensor, evidence.map);
  if (!is_wrong && !is_far) return std::nullopt;
  Explanations found;
  for (const FrameFault fault : GeometricFaults(claim)) {
    if (fault == FrameFault::kTranslationInMillimetres ? !is_far : !is_wrong) continue;
    const SensorClaim right = Corrected(claim, fault);
    const auto points_m = evidence.sample.PointsInRange(right, evidence.map.info().config.integration);
    if (points_m.size() < kFewPoints) continue;
    const MapFit fit = FitToMap(points_m, right.T_map_sensor, evidence.map);
    const bool explains = fit.KnownFraction() >= kExplainedSeen && fit.AgreeingFraction() >= kDoubtfulAgreement;
    found.Add({explains ? fault : FrameFault::kDisagrees, Share(fit.num_agreeing, fit.num_points)});
  }
  const Explanation& best = found.best;
  if (best.fault == FrameFault::kDisagrees || best.agreeing < found.next + kLead) return std::nullopt;
  const double agreeing_now = Share(now.num_agreeing, now.num_points);
  if (best.agreeing < agreeing_now + kGain) return std::nullopt;
  return WarningOf(best, agreeing_now, "the map");
}

/// No mistake explains it, and it cannot be that something new stands before the camera.
std::optional<FrameWarning> FindUnexplained(const FrameEvidence& evidence) {
  const MapFit& fit = evidence.fit;
  const bool is_wrong =
      IsDoubtful(fit) && fit.AgreeingFraction() < kUnexplainedAgreement && fit.KnownFraction() >= kUnexplainedKnown;
  if (!is_wrong) return std::nullopt;
  const double seen_through = SeenThroughFraction(evidence.points_m, evidence.claim.T_map_sensor, evidence.map);
  if (seen_through < kUnexplainedSeenThrough) return std::nullopt;
  return FrameWarning{FrameFault::kDisagrees, std::string(FaultText(FrameFault::kDisagrees)) + "; " +
                                                  Percent(fit.AgreeingFraction()) + " of what it shows agrees, and " +
                                                  Percent(seen_through) + " lies behind surfaces"};
}

}  // namespace

std::optional<FrameWarning> FindFault(const FrameEvidence& evidence) {
  if (evidence.claim.camera && evidence.points_m.size() >= kFewPoints) {
    for (auto view = evidence.views.rbegin(); view != evidence.views.rend(); ++view) {
      if (auto shared = FindShared(evidence, *view)) return shared;
    }
  }
  if (auto own = FindOwn(evidence)) return own;
  return FindUnexplained(evidence);
}

}  // namespace dhpmap
