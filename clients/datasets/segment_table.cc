// SPDX-License-Identifier: BSD-3-Clause
#include "clients/datasets/segment_table.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "clients/datasets/file_reader.h"

namespace dhpmap {
namespace {

using Json = nlohmann::json;

/// A non-negative integer; -1 if the key is missing or has another value.
std::int64_t WholeNumber(const Json& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_number_unsigned() ? it->get<std::int64_t>() : -1;
}

std::optional<float> ScoreOf(const Json& object) {
  const auto it = object.find("score");
  if (it == object.end() || !it->is_number()) return std::nullopt;
  return std::clamp(it->get<float>(), 0.0f, 1.0f);
}

/// The most likely scores, up to the limit of a frame.
std::vector<ClassScore> Likeliest(const std::map<ClassId, float>& by_class) {
  std::vector<ClassScore> scores;
  scores.reserve(by_class.size());
  for (const auto& [class_id, score] : by_class) scores.push_back({class_id, std::min(score, 1.0f)});
  if (scores.size() <= kMostClassScores) return scores;
  std::stable_sort(scores.begin(), scores.end(),
                   [](const ClassScore& a, const ClassScore& b) { return a.score > b.score; });
  scores.resize(kMostClassScores);
  return scores;
}

/// "class_scores": {"category_id": score, ...}; unknown categories are ignored, scores of the same class are added.
Result<std::vector<ClassScore>> ClassScoresOf(const Json& object, const LabelTable& table) {
  std::map<ClassId, float> by_class;
  const auto it = object.find("class_scores");
  if (it == object.end()) return std::vector<ClassScore>{};
  if (!it->is_object()) return InvalidArgument("has class_scores that are not an object");
  for (const auto& [key, value] : it->items()) {
    const bool is_number = !key.empty() && key.size() < 10 &&
                           std::all_of(key.begin(), key.end(), [](char c) { return c >= '0' && c <= '9'; });
    const LabelRow* row = is_number ? table.Find(std::stoll(key)) : nullptr;
    if (row == nullptr) {
      return InvalidArgument("has class_scores of category_id " + key + ", which the label table does not list");
    }
    if (!value.is_number()) return InvalidArgument("has class_scores that are not numbers");
    if (!row->is_unknown) by_class[row->label_class.id] += std::clamp(value.get<float>(), 0.0f, 1.0f);
  }
  return Likeliest(by_class);
}

Result<SegmentInfo> ParseSegment(const Json& object, const LabelTable& table) {
  if (!object.is_object()) return InvalidArgument("is not an object");
  const std::int64_t id = WholeNumber(object, "id");
  const std::int64_t category = WholeNumber(object, "category_id");
  if (id < 0 || id > 0xffffffff) return InvalidArgument("has no id");
  if (category < 0) return InvalidArgument("has no category_id");
  const LabelRow* row = table.Find(category);
  if (row == nullptr) {
    return InvalidArgument("has category_id " + std::to_string(category) + ", which the label table does not list");
  }
  SegmentInfo segment;
  segment.id = SegmentId(static_cast<std::uint32_t>(id));
  if (!row->is_unknown) segment.class_id = row->label_class.id;
  segment.score = ScoreOf(object);
  DHPMAP_ASSIGN_OR_RETURN(std::vector<ClassScore> class_scores, ClassScoresOf(object, table));
  if (segment.class_id) segment.class_scores = std::move(class_scores);
  return segment;
}

}  // namespace

Result<std::vector<SegmentInfo>> ReadSegmentTable(const std::filesystem::path& path, const LabelTable& table) {
  DHPMAP_ASSIGN_OR_RETURN(const std::string text, ReadText(path));
  const Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!json.is_array()) return BadFile(path, "is not a JSON list of segments").WithReason("BAD_LABELS");
  std::vector<SegmentInfo> segments;
  for (std::size_t i = 0; i < json.size(); ++i) {
    Result<SegmentInfo> segment = ParseSegment(json[i], table);
    if (!segment.ok()) {
      return BadFile(path, "entry " + std::to_string(i) + " " + segment.status().message()).WithReason("BAD_LABELS");
    }
    if (segment->id != kNoSegment) segments.push_back(*std::move(segment));
  }
  return segments;
}

}  // namespace dhpmap
