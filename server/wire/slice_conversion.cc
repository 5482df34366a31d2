// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/slice_conversion.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "proto/types/pose_conversion.h"
#include "proto/types/resource_names.h"
#include "server/wire/query_options.h"

namespace dhpmap {
namespace {

constexpr std::size_t kMostPath = 500;

Status BadSlice(const std::string& field, const std::string& what) {
  return InvalidArgument("the slice cannot be made").WithReason("BAD_POINTS").WithViolation(field, what);
}

bool IsInReach(double value_m) { return std::abs(value_m) <= kReach_m; }  // false for NaN

Result<Eigen::AlignedBox2d> AreaFromProto(const v1::SliceArea& area) {
  const std::pair<const char*, double> values[] = {{"area.min_x_m", area.min_x_m()},
                                                   {"area.min_y_m", area.min_y_m()},
                                                   {"area.max_x_m", area.max_x_m()},
                                                   {"area.max_y_m", area.max_y_m()}};
  for (const auto& [field, value_m] : values) {
    if (!IsInReach(value_m)) return BadSlice(field, "is not within 1,000,000 m");
  }
  if (!(area.min_x_m() < area.max_x_m())) return BadSlice("area.max_x_m", "is not above min_x_m");
  if (!(area.min_y_m() < area.max_y_m())) return BadSlice("area.max_y_m", "is not above min_y_m");
  return Eigen::AlignedBox2d(Eigen::Vector2d(area.min_x_m(), area.min_y_m()),
                             Eigen::Vector2d(area.max_x_m(), area.max_y_m()));
}

Status CheckPath(const std::string& image) {
  if (image.size() > kMostPath) return BadSlice("yaml_image_path", "is longer than 500 bytes");
  const bool has_controls =
      std::any_of(image.begin(), image.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
  if (has_controls) return BadSlice("yaml_image_path", "has control characters");
  return Status::Ok();
}

Status CheckBand(const v1::QueryOccupancySliceRequest& request) {
  if (!IsInReach(request.min_z_m())) return BadSlice("min_z_m", "is not within 1,000,000 m");
  if (!IsInReach(request.max_z_m())) return BadSlice("max_z_m", "is not within 1,000,000 m");
  if (!(request.min_z_m() < request.max_z_m())) return BadSlice("max_z_m", "is not above min_z_m");
  return Status::Ok();
}

std::int8_t UnknownCellOf(v1::QueryOptions::UnknownPolicy policy) {
  if (policy == v1::QueryOptions::FREE) return kFreeCell;
  return policy == v1::QueryOptions::OCCUPIED ? kOccupiedCell : kUnknownCell;
}

Result<SliceFormat> FormatFromProto(v1::QueryOccupancySliceRequest::Format format) {
  switch (format) {
    case v1::QueryOccupancySliceRequest::SLICE_FORMAT_UNSPECIFIED:
    case v1::QueryOccupancySliceRequest::CELLS: return SliceFormat::kCells;
    case v1::QueryOccupancySliceRequest::PGM: return SliceFormat::kPgm;
    case v1::QueryOccupancySliceRequest::PNG: return SliceFormat::kPng;
    case v1::QueryOccupancySliceRequest::YAML: return SliceFormat::kYaml;
    default: return BadSlice("format", "is none of those there are");
  }
}

const char* ContentType(SliceFormat format) {
  switch (format) {
    case SliceFormat::kCells: return "";
    case SliceFormat::kPgm: return "image/x-portable-graymap";
    case SliceFormat::kPng: return "image/png";
    case SliceFormat::kYaml: return "application/yaml";
  }
  return "";
}

v1::SliceObject ObjectToProto(const SubmapInfo& object, const MapInfo& map) {
  v1::SliceObject proto;
  proto.set_instance_id(object.id.value);
  proto.set_submap(SubmapResourceName(map.name, object.id));
  if (object.panoptic == Panoptic::kUnknown) return proto;
  proto.set_class_id(object.class_id.value);
  if (const LabelClass* c = map.label_set->Find(object.class_id)) proto.set_class_name(c->name);
  return proto;
}

void AddObjects(const std::vector<const SubmapInfo*>& objects, const MapInfo& map,
                v1::QueryOccupancySliceResponse& response) {
  std::unordered_map<const SubmapInfo*, std::uint32_t> numbers = {{nullptr, 0}};
  response.mutable_object_indices()->Reserve(static_cast<int>(objects.size()));
  for (const SubmapInfo* object : objects) {
    const auto [known, is_new] = numbers.emplace(object, static_cast<std::uint32_t>(numbers.size()));
    if (is_new) *response.add_objects() = ObjectToProto(*object, map);
    response.add_object_indices(known->second);
  }
}

}  // namespace

Result<SliceRequest> SliceRequestFromProto(const v1::QueryOccupancySliceRequest& request, const MapSnapshot& map) {
  SliceRequest slice;
  DHPMAP_RETURN_IF_ERROR(CheckBand(request));
  slice.options.min_z_m = request.min_z_m();
  slice.options.max_z_m = request.max_z_m();
  if (request.has_area()) {
    DHPMAP_ASSIGN_OR_RETURN(slice.area_m, AreaFromProto(request.area()));
  }
  if (request.has_resolution_m()) {
    slice.options.resolution_m = request.resolution_m();
    if (!(request.resolution_m() >= kLeastResolution_m && request.resolution_m() <= kMostResolution_m)) {
      return BadSlice("resolution_m", "is not from 0.001 to 100");
    }
  }
  if (request.has_min_free_fraction()) {
    slice.options.free_share = request.min_free_fraction();
    if (!(request.min_free_fraction() > 0 && request.min_free_fraction() <= 1)) {
      return BadSlice("min_free_fraction", "is not above 0 and up to 1");
    }
  }
  slice.options.with_objects = request.include_objects();
  DHPMAP_ASSIGN_OR_RETURN(slice.format, FormatFromProto(request.format()));
  DHPMAP_RETURN_IF_ERROR(CheckPath(request.yaml_image_path()));
  slice.image = request.yaml_image_path();
  v1::QueryOptions options = request.options();
  if (options.unknown_policy() == v1::QueryOptions::OCCUPIED) options.clear_unknown_policy();
  DHPMAP_ASSIGN_OR_RETURN(const auto question, QueryOptionsFromProto(options, map, kRayOptions));
  slice.options.unknown = UnknownCellOf(request.options().unknown_policy());
  slice.options.T_map_query = question.T_map_query;
  slice.options.max_distance_m = question.options.max_distance_m;
  slice.options.scope = question.options.scope;
  return slice;
}

std::size_t BytesOfAnswers(const v1::QueryOccupancySliceRequest& request) {
  double num_cells = static_cast<double>(kMostSliceCells);
  if (request.has_area() && request.has_resolution_m() && request.resolution_m() > 0) {
    const v1::SliceArea& area = request.area();
    const double asked = ((area.max_x_m() - area.min_x_m()) / request.resolution_m() + 1) *
                         ((area.max_y_m() - area.min_y_m()) / request.resolution_m() + 1);
    if (asked >= 0) num_cells = std::min(num_cells, asked);
  }
  // Bytes of a cell: the cell, its pixel, and its byte in the file, in the message and in the encoding. With objects: a
  // pointer, a number and its encoding.
  const std::size_t each = 5 + (request.include_objects() ? 8 + 4 + 3 : 0);
  return static_cast<std::size_t>(num_cells) * each;
}

void ToProto(const SliceRequest& request, const MapInfo& map, SliceAnswer answer,
             v1::QueryOccupancySliceResponse& response) {
  response.set_revision(map.revision);
  const SliceOptions& options = answer.options;
  response.set_width(options.width);
  response.set_height(options.height);
  response.set_resolution_m(options.resolution_m);
  *response.mutable_origin_m() = ToProto(Eigen::Vector3d(options.min_m.x(), options.min_m.y(), options.min_z_m));
  if (request.format == SliceFormat::kCells) {
    response.set_cells(std::string(answer.cells.begin(), answer.cells.end()));
  }
  AddObjects(answer.objects, map, response);
  response.set_content_type(ContentType(request.format));
  if (request.format == SliceFormat::kYaml) {
    response.set_data(std::move(answer.yaml));
    return;
  }
  response.set_data(std::move(answer.picture));
  response.set_yaml(std::move(answer.yaml));
}

}  // namespace dhpmap
