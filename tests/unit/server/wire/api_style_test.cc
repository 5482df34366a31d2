// SPDX-License-Identifier: BSD-3-Clause
// Checks the naming rules of docs/api-style.md on the descriptors of the API's messages.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "dhpmap/v1/auth_service.pb.h"
#include "dhpmap/v1/edit_service.pb.h"
#include "dhpmap/v1/errors.pb.h"
#include "dhpmap/v1/fleet_service.pb.h"
#include "dhpmap/v1/map_service.pb.h"
#include "dhpmap/v1/mapping_service.pb.h"
#include "dhpmap/v1/query_service.pb.h"
#include "dhpmap/v1/server_service.pb.h"
#include "dhpmap/v1/submap_service.pb.h"
#include "dhpmap/v1/watch_service.pb.h"
#include "mapping/base/reason.h"

namespace dhpmap {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::FileDescriptor;

/// The files of the API: those that define services, and our files that they import.
std::set<const FileDescriptor*> Files() {
  std::set<const FileDescriptor*> files;
  const std::function<void(const FileDescriptor*)> add = [&](const FileDescriptor* file) {
    if (file->package() != "dhpmap.v1" || !files.insert(file).second) return;
    for (int i = 0; i < file->dependency_count(); ++i) add(file->dependency(i));
  };
  for (const Descriptor* message :
       {v1::ApplyEditsRequest::descriptor(), v1::Error::descriptor(), v1::CreateMapRequest::descriptor(),
        v1::IntegrateFramesRequest::descriptor(), v1::QueryPointsRequest::descriptor(),
        v1::GetSubmapRequest::descriptor(), v1::WatchMapRequest::descriptor(), v1::WhoAmIRequest::descriptor(),
        v1::GetServerStatusRequest::descriptor(), v1::GetFleetRequest::descriptor()}) {
    add(message->file());
  }
  return files;
}

void AddNested(const Descriptor& message, std::vector<const Descriptor*>& all) {
  all.push_back(&message);
  for (int i = 0; i < message.nested_type_count(); ++i) AddNested(*message.nested_type(i), all);
}

std::vector<const Descriptor*> Messages() {
  std::vector<const Descriptor*> all;
  for (const FileDescriptor* file : Files()) {
    for (int i = 0; i < file->message_type_count(); ++i) AddNested(*file->message_type(i), all);
  }
  return all;
}

std::vector<const FieldDescriptor*> Fields() {
  std::vector<const FieldDescriptor*> all;
  for (const Descriptor* message : Messages()) {
    for (int i = 0; i < message->field_count(); ++i) all.push_back(message->field(i));
  }
  return all;
}

bool EndsInOneOf(const std::string& name, std::initializer_list<const char*> endings) {
  return std::any_of(endings.begin(), endings.end(), [&name](const char* ending) { return name.ends_with(ending); });
}

TEST(ApiStyle, AllServicesAreChecked) {
  EXPECT_EQ(Files().size(), 16u);
  EXPECT_GT(Fields().size(), 400u);
}

TEST(ApiStyle, NumbersEndInTheirUnit) {
  // Without a dimension, or of several.
  const std::set<std::string> unitless = {"x",
                                          "y",
                                          "z",
                                          "w",
                                          "weight",
                                          "max_weight",
                                          "class_confidence",
                                          "instance_confidence",
                                          "gradient",
                                          "normal",
                                          "packed_directions",
                                          "fraction",
                                          "packed_attached_poses",
                                          "score",
                                          "min_score",
                                          "iou_threshold",
                                          "color",
                                          "image_from_lidar",
                                          "map_from_sensor_matrix",
                                          "support",
                                          "enclosure",
                                          "min_support",
                                          "min_enclosure",
                                          "memory_bytes_per_allocated_voxel"};
  std::set<std::string> met;
  for (const FieldDescriptor* field : Fields()) {
    const auto type = field->cpp_type();
    if (type != FieldDescriptor::CPPTYPE_DOUBLE && type != FieldDescriptor::CPPTYPE_FLOAT) continue;
    const bool has_unit = EndsInOneOf(field->name(), {"_m", "_s", "_rad", "_px", "_vox", "_fraction"});
    EXPECT_NE(has_unit, unitless.contains(field->name())) << field->full_name();
    if (!has_unit) met.insert(field->name());
  }
  EXPECT_EQ(met, unitless) << "no exception without a use";
}

TEST(ApiStyle, TimesAreTimestampsAndStampsAreOfSensors) {
  for (const FieldDescriptor* field : Fields()) {
    const bool is_timestamp =
        field->message_type() != nullptr && field->message_type()->full_name() == "google.protobuf.Timestamp";
    EXPECT_EQ(is_timestamp, field->name().ends_with("_time")) << field->full_name();
    const bool is_stamp = field->name() == "stamp_ns" || field->name().ends_with("_stamp_ns");
    EXPECT_EQ(is_stamp, field->name().ends_with("_ns")) << field->full_name();
  }
}

TEST(ApiStyle, EnumsLiveInMessagesAndZeroIsUnspecified) {
  for (const FileDescriptor* file : Files()) EXPECT_EQ(file->enum_type_count(), 0) << file->name();
  int num_enums = 0;
  for (const Descriptor* message : Messages()) {
    for (int i = 0; i < message->enum_type_count(); ++i, ++num_enums) {
      const auto* zero = message->enum_type(i)->FindValueByNumber(0);
      ASSERT_NE(zero, nullptr);
      EXPECT_TRUE(zero->name().ends_with("_UNSPECIFIED")) << zero->full_name();
    }
  }
  EXPECT_GT(num_enums, 20);
}

TEST(ApiStyle, ListsHavePages) {
  const std::set<std::string> lists_by_another_name = {"SearchSubmaps", "QueryRelations"};
  int num_lists = 0;
  for (const FileDescriptor* file : Files()) {
    for (int s = 0; s < file->service_count(); ++s) {
      for (int m = 0; m < file->service(s)->method_count(); ++m) {
        const auto* method = file->service(s)->method(m);
        if (!method->name().starts_with("List") && !lists_by_another_name.contains(method->name())) continue;
        ++num_lists;
        for (const char* field : {"page_size", "page_token"}) {
          EXPECT_NE(method->input_type()->FindFieldByName(field), nullptr) << method->full_name() << ": " << field;
        }
        EXPECT_NE(method->output_type()->FindFieldByName("next_page_token"), nullptr) << method->full_name();
      }
    }
  }
  EXPECT_EQ(num_lists, 9);
}

TEST(ApiStyle, FlagsAreAdjectivesAndClassZeroIsAClass) {
  for (const FieldDescriptor* field : Fields()) {
    const std::string& name = field->name();
    if (field->type() == FieldDescriptor::TYPE_BOOL) {
      EXPECT_FALSE(name.starts_with("is_") || name.starts_with("has_") || name.starts_with("with_"))
          << field->full_name();
    }
    // A field for a class marks a missing class; a score always exists.
    if (name == "class_id" && !field->is_repeated() && field->containing_type()->name() != "ClassScore") {
      EXPECT_TRUE(field->has_presence()) << field->full_name();
    }
    if (name == "class_id" || name == "class_ids") {
      EXPECT_EQ(field->type(), FieldDescriptor::TYPE_INT32) << field->full_name();
    }
  }
}

TEST(ApiStyle, EveryFileNamesItsPackagesForOtherLanguages) {
  for (const FileDescriptor* file : Files()) {
    EXPECT_TRUE(file->options().has_go_package() && file->options().has_java_package()) << file->name();
  }
}

TEST(ApiStyle, EveryReasonIsListedOnce) {
  std::set<std::string> listed, known;
  const EnumDescriptor* reasons = v1::Error::Reason_descriptor();
  for (int i = 0; i < reasons->value_count(); ++i) {
    if (reasons->value(i)->number() != 0) listed.insert(reasons->value(i)->name());
  }
  for (const ReasonRow& row : kReasonTable) known.emplace(row.name);
  EXPECT_EQ(listed, known);
}

}  // namespace
}  // namespace dhpmap
