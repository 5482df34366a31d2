// SPDX-License-Identifier: BSD-3-Clause
// dhpmap-check-points: asks a map on a running server at measured points of which a data set's ground truth says what
// they are, and reports how often the answer is right and where the rest goes.
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "clients/datasets/dataset.h"
#include "clients/datasets/open_dataset.h"
#include "dhpmap/v1/map_service.grpc.pb.h"
#include "dhpmap/v1/query_service.grpc.pb.h"
#include "tests/bench/point_score.h"

namespace dhpmap {
namespace {

struct CheckOptions {
  std::string directory, map, server = "127.0.0.1:50051", classes;
  SampleOptions samples;
  std::int64_t min_voxels = 400;
  bool json = false;
};

/// Everything that the data set says, with a set of voxels with a measured point a thing.
struct Truth {
  std::vector<PointSample> samples;
  std::unordered_map<std::uint32_t, TruthObject> objects;
  std::unordered_map<std::uint32_t, std::unordered_set<std::uint64_t>> voxels;
};

Status ToStatus(const grpc::Status& status) {
  return status.ok() ? Status::Ok() : Status(static_cast<StatusCode>(status.error_code()), status.error_message());
}

std::uint64_t VoxelKey(const Eigen::Vector3f& p_map_m, double voxel_size_m) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    key = key << 21 | (static_cast<std::uint64_t>(std::llround(std::floor(p_map_m[axis] / voxel_size_m))) & 0x1fffff);
  }
  return key;
}

std::unordered_map<std::uint32_t, TruthObject> ObjectsOf(const PanopticFrame& frame,
                                                         const std::map<ClassId, Panoptic>& kinds,
                                                         const ClassMatch& match) {
  std::unordered_map<std::uint32_t, TruthObject> objects;
  for (const SegmentInfo& segment : frame.segments) {
    if (!segment.class_id || !match.contains(segment.class_id->value)) continue;
    objects[segment.id.value] = {segment.class_id->value, kinds.at(*segment.class_id)};
  }
  return objects;
}

Result<Truth> ReadTruth(Dataset& dataset, const ClassMatch& match, const CheckOptions& options,
                        const v1::MapConfig& config) {
  std::map<ClassId, Panoptic> kinds;
  for (const LabelClass& label_class : dataset.label_classes()) kinds[label_class.id] = label_class.panoptic;
  Truth truth;
  for (std::size_t i = 0; i < dataset.num_frames(); ++i) {
    DHPMAP_ASSIGN_OR_RETURN(const DatasetFrame raw, dataset.Read(i));
    DHPMAP_ASSIGN_OR_RETURN(const PanopticFrame frame, DecodeFrame(raw, true));
    truth.objects.merge(ObjectsOf(frame, kinds, match));
    for (const PointSample& sample : SamplePoints(frame, options.samples)) {
      if (truth.objects.contains(sample.segment)) truth.samples.push_back(sample);
    }
    SampleOptions all = options.samples;
    all.step = 1;
    all.edge_px = 0;
    for (const PointSample& sample : SamplePoints(frame, all)) {
      const auto object = truth.objects.find(sample.segment);
      if (sample.range_m >= config.integration().max_range_m()) continue;
      if (object == truth.objects.end() || object->second.kind != Panoptic::kThing) continue;
      truth.voxels[sample.segment].insert(VoxelKey(sample.p_map_m, config.voxel_size_m()));
    }
  }
  return truth;
}

Result<std::vector<PointAnswer>> Ask(const std::shared_ptr<grpc::Channel>& channel, const std::string& map,
                                     const std::vector<PointSample>& samples) {
  constexpr std::size_t kBatch = 200'000;
  const auto stub = v1::QueryService::NewStub(channel);
  std::vector<PointAnswer> answers;
  for (std::size_t begin = 0; begin < samples.size(); begin += kBatch) {
    const std::size_t end = std::min(begin + kBatch, samples.size());
    v1::QueryPointsRequest request;
    request.set_map("maps/" + map);
    request.set_packed(true);
    for (std::size_t i = begin; i < end; ++i) {
      for (int axis = 0; axis < 3; ++axis) request.add_packed_points_m(samples[i].p_map_m[axis]);
    }
    grpc::ClientContext context;
    v1::QueryPointsResponse response;
    DHPMAP_RETURN_IF_ERROR(ToStatus(stub->QueryPoints(&context, request, &response)));
    const v1::PackedPointResults& packed = response.packed();
    if (packed.near_surface_size() != static_cast<int>(end - begin)) return Internal("the answer has another length");
    for (int i = 0; i < packed.near_surface_size(); ++i) {
      answers.push_back({packed.near_surface(i), static_cast<Panoptic>(packed.kind()[static_cast<std::size_t>(i)]),
                         static_cast<std::uint32_t>(packed.instance_id(i)),
                         static_cast<std::uint32_t>(packed.class_id(i))});
    }
  }
  return answers;
}

nlohmann::json ToJson(const PointScore::Wrong& wrong, std::int64_t total) {
  const auto percent = [total](std::int64_t count) {
    return 100.0 * static_cast<double>(count) / static_cast<double>(total);
  };
  return {{"unobserved", percent(wrong.unobserved)},
          {"out_of_range", percent(wrong.out_of_range)},
          {"unknown_object", percent(wrong.unknown_object)},
          {"at_edge", percent(wrong.at_edge)},
          {"other", percent(wrong.other)}};
}

nlohmann::json Report(const PointScore& score, const CheckOptions& options,
                      const std::map<std::uint32_t, std::string>& truth_names,
                      const std::map<std::uint32_t, std::string>& map_names) {
  const std::int64_t total = std::max<std::int64_t>(score.num_samples, 1);
  const auto percent = [total](std::int64_t count) {
    return 100.0 * static_cast<double>(count) / static_cast<double>(total);
  };
  const auto name = [](const std::map<std::uint32_t, std::string>& names, std::uint32_t id) {
    const auto it = names.find(id);
    return it == names.end() ? "class " + std::to_string(id) : it->second;
  };
  nlohmann::json things = nlohmann::json::array();
  int num_large = 0, num_large_with_one = 0;
  for (const PointScore::Thing& thing : score.things) {
    const bool is_large = thing.num_voxels >= options.min_voxels;
    num_large += is_large ? 1 : 0;
    num_large_with_one += is_large && thing.submaps.size() == 1 ? 1 : 0;
    things.push_back({{"segment", thing.segment},
                      {"class", name(truth_names, thing.class_id)},
                      {"voxels", thing.num_voxels},
                      {"submaps", thing.submaps},
                      {"samples", thing.num_samples},
                      {"right", thing.num_right}});
  }
  std::vector<std::pair<std::int64_t, std::string>> confusions;
  for (const auto& [pair, count] : score.confusions) {
    confusions.emplace_back(count, name(truth_names, pair.first) + " -> " + name(map_names, pair.second));
  }
  std::sort(confusions.rbegin(), confusions.rend());
  confusions.resize(std::min<std::size_t>(confusions.size(), 10));
  nlohmann::json top = nlohmann::json::array();
  for (const auto& [count, text] : confusions) top.push_back({{"confusion", text}, {"percent", percent(count)}});
  return {{"samples", score.num_samples},
          {"observed_percent", percent(score.num_observed)},
          {"right_class_percent", percent(score.num_right_class)},
          {"right_instance_percent", percent(score.num_right_instance)},
          {"wrong_class_percent", ToJson(score.wrong_class, total)},
          {"wrong_instance_percent", ToJson(score.wrong_instance, total)},
          {"large_things", num_large},
          {"large_things_with_one_submap", num_large_with_one},
          {"min_voxels", options.min_voxels},
          {"things", things},
          {"top_confusions_away_from_edges", top}};
}

void PrintTable(const nlohmann::json& report) {
  const auto wrong = [&report](const char* what) {
    const nlohmann::json& w = report[what];
    std::printf(
        "  %-22s beyond the range of fusion %.2f %%, unobserved %.2f %%, unknown object %.2f %%, at an edge %.2f %%, "
        "other %.2f %%\n",
        what, w["out_of_range"].get<double>(), w["unobserved"].get<double>(), w["unknown_object"].get<double>(),
        w["at_edge"].get<double>(), w["other"].get<double>());
  };
  std::printf("%lld points: %.2f %% observed, %.2f %% right class, %.2f %% right instance\n",
              static_cast<long long>(report["samples"].get<std::int64_t>()), report["observed_percent"].get<double>(),
              report["right_class_percent"].get<double>(), report["right_instance_percent"].get<double>());
  wrong("wrong_class_percent");
  wrong("wrong_instance_percent");
  std::printf("%d things with >= %d voxels, of these %d with exactly one submap; the others:\n",
              report["large_things"].get<int>(), report["min_voxels"].get<int>(),
              report["large_things_with_one_submap"].get<int>());
  for (const nlohmann::json& thing : report["things"]) {
    if (thing["voxels"] < report["min_voxels"] || thing["submaps"].size() == 1) continue;
    std::printf("  %s %u: %d voxels, submaps %s\n", thing["class"].get<std::string>().c_str(),
                thing["segment"].get<unsigned>(), thing["voxels"].get<int>(), thing["submaps"].dump().c_str());
  }
  std::printf("most common confusions away from edges:\n");
  for (const nlohmann::json& row : report["top_confusions_away_from_edges"]) {
    std::printf("  %6.3f %%  %s\n", row["percent"].get<double>(), row["confusion"].get<std::string>().c_str());
  }
}

Status Run(CheckOptions options, bool has_depth_range) {
  DHPMAP_ASSIGN_OR_RETURN(const auto dataset, OpenDataset(options.directory, kAnyFormat, LabelSource::kGroundTruth));
  if (!has_depth_range && dataset->preset() == "outdoor_lidar") {
    options.samples.min_depth_m = 1.0;
    options.samples.max_depth_m = 30.0;
  }
  const auto channel = grpc::CreateCustomChannel(options.server, grpc::InsecureChannelCredentials(), [] {
    grpc::ChannelArguments arguments;
    arguments.SetMaxReceiveMessageSize(-1);
    return arguments;
  }());
  grpc::ClientContext context;
  v1::GetMapRequest request;
  request.set_name("maps/" + options.map);
  v1::GetMapResponse response;
  DHPMAP_RETURN_IF_ERROR(ToStatus(v1::MapService::NewStub(channel)->GetMap(&context, request, &response)));
  const v1::Map& map = response.map();
  if (options.classes.empty()) options.classes = options.directory + "/evaluation_classes.csv";
  DHPMAP_ASSIGN_OR_RETURN(const ClassMatch match, MatchClasses(map, dataset->label_classes(), options.classes));
  DHPMAP_ASSIGN_OR_RETURN(const Truth truth, ReadTruth(*dataset, match, options, map.config()));
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<PointAnswer> answers, Ask(channel, options.map, truth.samples));
  PointScore score = Score(truth.samples, answers, truth.objects, match, map.config().integration().max_range_m());
  for (PointScore::Thing& thing : score.things) {
    const auto it = truth.voxels.find(thing.segment);
    thing.num_voxels = it == truth.voxels.end() ? 0 : static_cast<std::int64_t>(it->second.size());
  }
  std::map<std::uint32_t, std::string> truth_names, map_names;
  for (const LabelClass& label_class : dataset->label_classes()) truth_names[label_class.id.value] = label_class.name;
  for (const v1::LabelClass& label_class : map.label_classes()) map_names[label_class.id()] = label_class.name();
  const nlohmann::json report = Report(score, options, truth_names, map_names);
  if (options.json) std::cout << report.dump(2) << "\n";
  else PrintTable(report);
  return Status::Ok();
}

}  // namespace
}  // namespace dhpmap

int main(int argc, char** argv) {
  dhpmap::CheckOptions options;
  CLI::App app("Checks a map's answers against a data set's ground truth", "dhpmap-check-points");
  app.add_option("directory", options.directory, "Data set with ground truth")->required();
  app.add_option("--map", options.map, "Name of the map")->required();
  app.add_option("--server", options.server)->envname("DHPMAP_SERVER")->capture_default_str();
  app.add_option("--classes", options.classes, "evaluation_classes.csv; default: the data set's, where it has one");
  app.add_option("--step", options.samples.step, "Every so many pixels in u and v")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI::Option* min = app.add_option("--min-depth", options.samples.min_depth_m, "Metres; default 0.3, of scans 1");
  CLI::Option* max = app.add_option("--max-depth", options.samples.max_depth_m, "Metres; default 4, of scans 30");
  app.add_option("--edge-px", options.samples.edge_px, "So near another object's pixel is at an edge")
      ->capture_default_str();
  app.add_option("--min-voxels", options.min_voxels, "Things of so many voxels count as large")->capture_default_str();
  app.add_flag("--json", options.json);
  CLI11_PARSE(app, argc, argv);
  const dhpmap::Status status = dhpmap::Run(options, min->count() + max->count() > 0);
  if (!status.ok()) std::cerr << "dhpmap-check-points: " << status.ToString() << "\n";
  return status.ok() ? 0 : 1;
}
