// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/map_config.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <type_traits>
#include <unordered_map>

namespace dhpmap {
namespace {

constexpr std::array<std::string_view, 3> kWeightingNames = {"CONSTANT", "INVERSE_DEPTH_SQUARED",
                                                             "INVERSE_RANGE_SQUARED"};
constexpr double kMaxTruncationVox = 8.0;

constexpr std::array kRetiredFields = {
    RetiredField{.key = "tracking.weigh_scores", .default_text = "false"},  // up to 0.2.0
    // Carving no longer improved any answer once free space was a layer and gone surfaces were left out.
    RetiredField{.key = "integration.carving", .default_text = "false", .is_left_out = true},
};

Status BadField(const std::string& message, std::string_view key, const std::string& violation) {
  return InvalidArgument(message).WithReason("BAD_CONFIG").WithViolation(std::string(key), violation);
}

Status CheckRetired(const RetiredField& field, std::string_view text) {
  if (text == field.default_text) return Status::Ok();
  const std::string violation = "is retired: it can only be " + std::string(field.default_text);
  return BadField("config key " + std::string(field.key) + " " + violation, field.key, violation);
}

std::string FormatDouble(double value) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::string FormatField(double value) { return FormatDouble(value); }
std::string FormatField(int value) { return std::to_string(value); }
std::string FormatField(bool value) { return value ? "true" : "false"; }
std::string FormatField(Weighting value) { return std::string(WeightingName(value)); }

template <typename Number>
bool ParseField(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}
bool ParseField(std::string_view text, bool& value) {
  value = text == "true";
  return text == "true" || text == "false";
}
bool ParseField(std::string_view text, Weighting& value) {
  for (std::size_t i = 0; i < kWeightingNames.size(); ++i) {
    if (text == kWeightingNames[i]) {
      value = static_cast<Weighting>(i);
      return true;
    }
  }
  return false;
}

/// Of a key, in the order of VisitFields.
std::optional<int> NumberOfField(std::string_view key) {
  static const std::unordered_map<std::string_view, int> numbers = [] {
    std::unordered_map<std::string_view, int> by_key;
    const MapConfig config;
    VisitFields(config, [&by_key](const char* its, const auto&, double, double, const char*) {
      by_key.emplace(its, static_cast<int>(by_key.size()));
    });
    return by_key;
  }();
  const auto found = numbers.find(key);
  return found == numbers.end() ? std::nullopt : std::optional<int>(found->second);
}

}  // namespace

std::string_view WeightingName(Weighting weighting) {
  const auto number = static_cast<std::size_t>(weighting);
  return number < kWeightingNames.size() ? kWeightingNames[number] : "UNKNOWN";
}

Status MapConfig::Validate() const {
  Status bad = InvalidArgument("the map config is not usable").WithReason("BAD_CONFIG");
  VisitFields(*this, [&bad](const char* key, const auto& value, double least, double most, const char*) {
    const auto number = static_cast<double>(value);
    if (!(number >= least && number <= most)) {  // also catches NaN
      bad.AddViolation(key,
                       FormatField(value) + " is not within " + FormatDouble(least) + " and " + FormatDouble(most));
    }
  });
  const double truncation_vox = truncation_m / voxel_size_m;
  if (voxel_size_m > 0 && (truncation_vox < 1.0 - 1e-9 || truncation_vox > kMaxTruncationVox + 1e-9)) {
    bad.AddViolation("truncation_m", FormatDouble(truncation_m) + " is not 1 to 8 voxels");
  }
  if (integration.min_range_m >= integration.max_range_m) {
    bad.AddViolation("integration.min_range_m", "is not below integration.max_range_m");
  }
  return bad.violations().empty() ? Status::Ok() : bad;
}

MapConfig IndoorConfig() { return {}; }

MapConfig OutdoorLidarConfig() {
  MapConfig config;
  config.voxel_size_m = 0.1;
  config.truncation_m = 0.6;
  config.integration.min_range_m = 1.0;
  config.integration.max_range_m = 30.0;
  config.integration.weighting = Weighting::kConstant;
  config.tracking.iou_threshold = 0.1;
  config.tracking.min_points_stuff = 100;
  // In two KITTI excerpts, segments with lower scores are almost all wrong. In a rendered house, whose scores mean
  // less, the limit would cost one point of PQ.
  config.tracking.min_score = 0.6;
  config.tracking.split_gap_vox = 3;
  config.tracking.min_points_small = 20;
  config.tracking.min_points_medium = 40;
  config.tracking.min_points_large = 100;
  config.activity.required_reobservations = 2;
  config.refinement.every_frames = 200;
  config.refinement.evidence_radius_m = 0.4;
  config.refinement.smoothness = {.position_m = 0.25, .color = 0, .weight = 3.0};
  config.refinement.appearance = {.position_m = 0.5, .color = 10.0, .weight = 4.0};
  return config;
}

Status ApplyPreset(std::string_view preset, MapConfig& config) {
  if (preset == "indoor") {
    config = IndoorConfig();
  } else if (preset == "outdoor_lidar") {
    config = OutdoorLidarConfig();
  } else {
    return InvalidArgument("there is no preset '" + std::string(preset) + "'")
        .WithReason("BAD_CONFIG")
        .WithViolation("preset", "must be indoor or outdoor_lidar");
  }
  return Status::Ok();
}

std::vector<std::pair<std::string, std::string>> ConfigToText(const MapConfig& config) {
  std::vector<std::pair<std::string, std::string>> text;
  VisitFields(config, [&text](const char* key, const auto& value, double, double, const char*) {
    text.emplace_back(key, FormatField(value));
  });
  return text;
}

std::span<const RetiredField> RetiredFields() { return kRetiredFields; }

const RetiredField* FindRetiredField(std::string_view key) {
  const auto found = std::find_if(kRetiredFields.begin(), kRetiredFields.end(),
                                  [key](const RetiredField& field) { return field.key == key; });
  return found == kRetiredFields.end() ? nullptr : &*found;
}

Status SetField(MapConfig& config, std::string_view wanted, std::string_view text) {
  if (const RetiredField* retired = FindRetiredField(wanted)) return CheckRetired(*retired, text);
  const std::optional<int> number = NumberOfField(wanted);
  bool parsed = false;
  VisitFields(config, [&, n = 0](const char*, auto& value, double, double, const char*) mutable {
    if (n++ != number) return;
    std::remove_reference_t<decltype(value)> candidate = value;
    parsed = ParseField(text, candidate);
    if (parsed) value = candidate;
  });
  if (parsed) return Status::Ok();
  const std::string key(wanted);
  if (!number) return BadField("unknown config key " + key, key, "unknown key");
  const std::string cannot = "cannot be '" + std::string(text) + "'";
  return BadField("config key " + key + " " + cannot, key, cannot);
}

}  // namespace dhpmap
