// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace dhpmap::rig {

// Small image files that decode to many pixels, or say that they do.

/// 16-bit grey, all 0, packed; each row is the same bytes of the file. 70 kB for 2^26 pixels.
std::string SmallTiff(int width_px, int height_px);
/// Grey, in two bits for each 8 x 8 pixels. 260 kB for 2^26 pixels.
std::string SmallJpeg(int width_px, int height_px);
/// The same with a second frame header, which says `second_px` a side.
std::string JpegOfTwoSizes(int width_px, int height_px, int second_px);
/// 8-bit grey, all 0. 66 kB for 2^26 pixels.
std::string SmallPng(int width_px, int height_px);
/// A sound file but for its pixels, of which there are eight.
std::string EmptyPng(int width_px, int height_px);

}  // namespace dhpmap::rig
