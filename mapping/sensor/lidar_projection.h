// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "mapping/sensor/frame.h"
#include "mapping/sensor/image_codec.h"

namespace dhpmap {

/// A camera next to a LiDAR: pixel = K * [R|t] * p_lidar, as one 3x4 matrix (KITTI: P2 * Tr).
struct LidarCamera {
  Eigen::Matrix<double, 3, 4> P_image_lidar = Eigen::Matrix<double, 3, 4>::Zero();
  int width_px = 0;
  int height_px = 0;
};

/// Gives LiDAR points colour (bilinear) and segment ids (nearest pixel) from the images of a camera. Removes points
/// behind the camera or outside the image, with their colour and ids. An empty image (0 x 0) changes nothing; an image
/// of another size than the camera's is INVALID_ARGUMENT. With ids from the image, `scan.is_hidden` marks points that
/// the camera does not see; their ids are those of occluders.
Status ProjectImagesOntoScan(const LidarCamera& camera, const Image<Color>& color, const Image<std::uint32_t>& segments,
                             LidarData& scan);

}  // namespace dhpmap
