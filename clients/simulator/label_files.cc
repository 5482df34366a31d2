// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/label_files.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "clients/simulator/random.h"

namespace dhpmap::simulator {
namespace {

// Keeps keys in the order of writing.
using Json = nlohmann::ordered_json;

constexpr const char* kColumns = "InstanceID,ClassID,PanopticID,R,G,B,Name,Size\n";

std::string Row(std::size_t id, ObjectClass object_class, const std::string& name) {
  const ObjectClassInfo& info = InfoOf(object_class);
  // Bright colours that differ between ids; none is black.
  const std::uint64_t bits = id == 0 ? 0 : MixBits(id);
  std::string color;
  for (int shift : {0, 16, 32}) color += std::to_string(id == 0 ? 0 : 48 + (bits >> shift) % 208) + ",";
  return std::to_string(id) + "," + std::to_string(static_cast<int>(object_class)) + "," +
         (info.is_thing ? "1," : "0,") + color + name + "," + info.size + "\n";
}

double Rounded(float score) { return std::round(static_cast<double>(score) * 1000) / 1000; }

Json ClassScores(const PredictedSegment& segment) {
  const auto key = [](ObjectClass c) { return std::to_string(static_cast<int>(c)); };
  Json scores{{key(segment.object_class), Rounded(segment.score)}};
  if (segment.second_score > 0) scores[key(segment.second_class)] = Rounded(segment.second_score);
  return scores;
}

}  // namespace

std::string GroundTruthTable(std::span<const Instance> instances) {
  std::string csv = kColumns;
  for (const Instance& instance : instances) csv += Row(instance.id, instance.object_class, instance.name);
  return csv;
}

std::string CategoryTable() {
  std::string csv = kColumns;
  for (const ObjectClassInfo& info : ObjectClasses()) {
    csv += Row(static_cast<std::size_t>(info.object_class), info.object_class, info.name);
  }
  return csv;
}

std::string SegmentsJson(std::span<const PredictedSegment> segments, bool has_class_scores) {
  Json list = Json::array();
  for (const PredictedSegment& segment : segments) {
    const bool is_thing = InfoOf(segment.object_class).is_thing;
    Json entry{{"id", segment.id}, {"isthing", is_thing}, {"category_id", static_cast<int>(segment.object_class)}};
    if (is_thing) {
      entry["instance_id"] = segment.id;
      entry["score"] = Rounded(segment.score);
      if (has_class_scores) entry["class_scores"] = ClassScores(segment);
    }
    list.push_back(std::move(entry));
  }
  return list.dump() + "\n";
}

}  // namespace dhpmap::simulator
