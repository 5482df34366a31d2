// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include <cstdint>
#include <optional>

#include "dhpmap/v1/types.pb.h"
#include "mapping/base/ids.h"
#include "mapping/base/result.h"
#include "mapping/labels/label_set.h"

namespace dhpmap {

v1::LabelClass::Kind ToProto(Panoptic panoptic);
v1::Color ToProto(Color color);
v1::LabelClass ToProto(const LabelClass& label_class);

/// Nothing for a number outside the range of class ids.
std::optional<ClassId> ClassIdFromProto(std::int64_t id);

/// INVALID_ARGUMENT naming every bad class.
Result<LabelSet> LabelSetFromProto(const google::protobuf::RepeatedPtrField<v1::LabelClass>& classes);

}  // namespace dhpmap
