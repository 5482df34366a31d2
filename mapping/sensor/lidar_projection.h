// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "mapping/sensor/frame.h"
#include "mapping/sensor/image_codec.h"

namespace dhpmap {

/// A camera beside a LiDAR: pixel = K * [R|t] * p_lidar, as one 3x4 matrix (KITTI: P2 * Tr).
struct LidarCamera {
  Eigen::Matrix<double, 3, 4> P_image_lidar = Eigen::Matrix<double, 3, 4>::Zero();
  int width_px = 0;
  int height_px = 0;
};

/// Gives LiDAR points colour (bilinear) and segment ids (nearest pixel) from the images of a camera. Points behind the
/// camera or outside the image are dropped, in place, with their colour and ids. Either image may be empty (0 x 0), and
/// then leaves what the points had; an image whose size is not the camera's is INVALID_ARGUMENT. Where ids come from
/// the image, `scan.is_hidden` says which points the camera does not see: their ids are those of what is before them.
Status ProjectImagesOntoScan(const LidarCamera& camera, const Image<Color>& color, const Image<std::uint32_t>& segments,
                             LidarData& scan);

}  // namespace dhpmap
