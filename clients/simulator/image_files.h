// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "clients/simulator/shading.h"
#include "mapping/base/status.h"

// Row-major images of a given width; the height follows. UNAVAILABLE, naming the file, if it cannot be written.
namespace dhpmap::simulator {

Status WriteColorPng(const std::filesystem::path& path, int width_px, std::span<const Rgb> pixels);
/// 8 bit, one channel.
Status WriteIdPng(const std::filesystem::path& path, int width_px, std::span<const std::uint8_t> ids);
/// 32-bit float, uncompressed, because noise does not compress.
Status WriteDepthTiff(const std::filesystem::path& path, int width_px, std::span<const float> depth_m);

}  // namespace dhpmap::simulator
