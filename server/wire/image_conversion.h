// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "dhpmap/v1/mapping_service.pb.h"
#include "mapping/base/result.h"
#include "mapping/labels/color.h"
#include "mapping/sensor/image_codec.h"

namespace dhpmap {

// Decodes images of requests, raw or as a file. Each must have exactly width * height pixels (1..16384 a side, checked
// by the caller) and a suitable type; else INVALID_ARGUMENT with a violation of `field` and reason BAD_IMAGE.

/// Metres; 0 = no return. Integer depth needs a positive scale_m.
Result<std::vector<float>> DepthFromProto(const v1::Image& image, int width_px, int height_px, std::string_view field);
Result<Image<Color>> ColorFromProto(const v1::Image& image, int width_px, int height_px, std::string_view field);
Result<Image<std::uint32_t>> SegmentsFromProto(const v1::Image& image, int width_px, int height_px,
                                               std::string_view field);

}  // namespace dhpmap
