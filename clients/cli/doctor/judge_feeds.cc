// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <optional>
#include <string_view>

#include "clients/cli/doctor/judge.h"
#include "clients/cli/text_table.h"

namespace dhpmap {
namespace {

constexpr double kSilence_s = 5;
constexpr double kRefusedShare = 0.05;
/// A robot that is mended is well after so many frames without a warning, ten seconds of most.
constexpr std::int64_t kWellAgain = 100;

struct Cure {
  std::string_view fault, advice;
};
/// By the names of FrameWarning.Fault; what the client of the robot is to change.
constexpr std::array kCures = {
    Cure{"POSE_INVERTED", "send map_from_sensor, the inverse of what is sent now"},
    Cure{"OPENGL_AXES", "turn the camera's axes before sending: z forward, y down (docs/frames.md)"},
    Cure{"BODY_AXES", "send the camera's pose, not the body's: z forward, y down (docs/frames.md)"},
    Cure{"TRANSLATION_IN_MILLIMETRES", "divide the pose's translation by 1,000: it is in metres"},
    Cure{"INTRINSICS_OF_HALF_SIZE", "double the intrinsics, or send the images that they are of"},
    Cure{"INTRINSICS_OF_DOUBLE_SIZE", "halve the intrinsics, or send the images that they are of"},
    Cure{"DEPTH_IN_MILLIMETRES", "set the depth image's scale_m to 0.001: nothing is fused as it is"},
    Cure{"STAMP_REPEATED", "send each frame once, with the time at which it was taken"},
    Cure{"STAMP_WENT_BACK", "send frames in the order of their stamps; is the robot's clock set back?"},
};

std::string_view CureOf(std::string_view fault) {
  for (const Cure& cure : kCures) {
    if (cure.fault == fault) return cure.advice;
  }
  return "is the robot lost, or its calibration wrong? Compare its poses with the map: `dhpmap sessions list`";
}

std::string NameOf(const client::ActiveFeed& feed) {
  return feed.map + (feed.session.empty() ? ", of no session" : ", session " + feed.session);
}

/// The first of what is wrong with a feed: one that is silent is told of nothing else.
std::optional<Finding> JudgeFeed(const client::ActiveFeed& feed) {
  Finding finding{.health = Health::kWarn, .what = "feed", .text = NameOf(feed) + ": "};
  const auto num_all = static_cast<double>(feed.num_frames + feed.num_refused);
  if (feed.silent_s > kSilence_s) {
    finding.text += "silent for " + Fixed(feed.silent_s, 0) + " s";
    finding.advice = "does the robot stand still, or has it lost its connection?";
  } else if (!feed.last_fault.empty() && feed.num_plausible_since < kWellAgain) {
    finding.text += std::to_string(feed.num_implausible) + " of " + Fixed(num_all, 0) +
                    " frames came with a warning, the last: " + feed.last_warning;
    finding.advice = CureOf(feed.last_fault);
  } else if (static_cast<double>(feed.num_refused) > kRefusedShare * num_all) {
    finding.text += std::to_string(feed.num_refused) + " of " + Fixed(num_all, 0) + " frames were refused";
    finding.advice = "the acknowledgements say why; `dhpmap sessions list` has more";
  } else {
    return std::nullopt;
  }
  return finding;
}

}  // namespace

std::vector<Finding> JudgeFeeds(const std::vector<client::ActiveFeed>& feeds) {
  std::vector<Finding> findings;
  double frames_per_s = 0;
  for (const client::ActiveFeed& feed : feeds) {
    frames_per_s += feed.frames_per_s;
    if (auto finding = JudgeFeed(feed)) findings.push_back(*std::move(finding));
  }
  if (!findings.empty()) return findings;
  if (feeds.empty()) return {{.what = "feeds", .text = "none is active"}};
  return {{.what = "feeds",
           .text = std::to_string(feeds.size()) + (feeds.size() == 1 ? " is" : " are") + " active, " +
                   Fixed(frames_per_s, 1) + " frames/s"}};
}

}  // namespace dhpmap
