// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <utility>

#include "mapping/base/result.h"
#include "mapping/sensor/pinhole_camera.h"

namespace dhpmap {

/// camera.txt, our addition to layouts whose intrinsics are fixed: `width height fx fy cx cy` in pixels, '#' comments.
/// Looks in each of `folders` in turn; empty where none has one. INVALID_ARGUMENT for a file that is no usable camera.
Result<std::optional<PinholeCamera>> FindCameraFile(std::span<const std::filesystem::path> folders);

/// Width and height in a PNG file's header, without decoding it. INVALID_ARGUMENT, reason BAD_IMAGE, if it is no PNG.
Result<std::pair<int, int>> PngSize(std::span<const std::byte> file);

}  // namespace dhpmap
