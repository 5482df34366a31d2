// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <utility>

#include "mapping/base/result.h"
#include "mapping/sensor/pinhole_camera.h"

namespace dhpmap {

/// camera.txt, our addition to layouts with fixed intrinsics: `width height fx fy cx cy` in pixels; '#' starts a
/// comment. Searches `folders` in order; empty if none has one. INVALID_ARGUMENT for an invalid camera.
Result<std::optional<PinholeCamera>> FindCameraFile(std::span<const std::filesystem::path> folders);

/// Width and height from the header of a PNG file, without decoding it. INVALID_ARGUMENT, reason BAD_IMAGE, for other
/// files.
Result<std::pair<int, int>> PngSize(std::span<const std::byte> file);

}  // namespace dhpmap
