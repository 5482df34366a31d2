// SPDX-License-Identifier: BSD-3-Clause
#include "clients/datasets/dataset.h"
#include "mapping/sensor/image_codec.h"
#include "mapping/sensor/lidar_projection.h"

namespace dhpmap {
namespace {

/// Adds the name to errors; a missing file gives an empty image.
template <typename Pixel, typename Decoder>
Result<Image<Pixel>> DecodeIfThere(const ImageFile& file, const char* what, Decoder decode) {
  if (file.bytes.empty()) return Image<Pixel>();
  Result<Image<Pixel>> image = decode(file.bytes);
  if (image.ok()) return image;
  return Status(image.status().code(), std::string(what) + " image: " + image.status().message())
      .WithReason(image.status().reason());
}

Status CheckSize(const PinholeCamera& camera, const char* what, int width_px, int height_px) {
  if (width_px == 0 || (width_px == camera.width_px && height_px == camera.height_px)) return Status::Ok();
  return InvalidArgument(std::string(what) + " image is " + std::to_string(width_px) + " x " +
                         std::to_string(height_px) + ", the camera " + std::to_string(camera.width_px) + " x " +
                         std::to_string(camera.height_px));
}

Result<DepthCameraData> DecodeCamera(const DatasetFrame::DepthCamera& in) {
  DepthCameraData out;
  out.camera = in.camera;
  DHPMAP_ASSIGN_OR_RETURN(Image<float> depth, DecodeIfThere<float>(in.depth, "depth", [&in](const auto& bytes) {
                            return DecodeDepth(bytes, in.depth.scale_m);
                          }));
  DHPMAP_ASSIGN_OR_RETURN(Image<Color> color, DecodeIfThere<Color>(in.color, "colour", DecodeColor));
  DHPMAP_ASSIGN_OR_RETURN(Image<std::uint32_t> segments,
                          DecodeIfThere<std::uint32_t>(in.segments, "segment", DecodeSegments));
  DHPMAP_RETURN_IF_ERROR(CheckSize(in.camera, "depth", depth.width_px, depth.height_px));
  DHPMAP_RETURN_IF_ERROR(CheckSize(in.camera, "colour", color.width_px, color.height_px));
  DHPMAP_RETURN_IF_ERROR(CheckSize(in.camera, "segment", segments.width_px, segments.height_px));
  out.depth_m = std::move(depth.pixels);
  out.color = std::move(color.pixels);
  out.segments = std::move(segments.pixels);
  return out;
}

Result<LidarData> DecodeLidar(const DatasetFrame::Lidar& in) {
  LidarData out;
  out.points_m = in.points_m;
  out.segments = in.segments;
  if (in.image_width_px == 0) return out;
  DHPMAP_ASSIGN_OR_RETURN(const Image<Color> color, DecodeIfThere<Color>(in.color, "colour", DecodeColor));
  DHPMAP_ASSIGN_OR_RETURN(const Image<std::uint32_t> segments,
                          DecodeIfThere<std::uint32_t>(in.segment_image, "segment", DecodeSegments));
  const LidarCamera camera{in.P_image_lidar, in.image_width_px, in.image_height_px};
  DHPMAP_RETURN_IF_ERROR(ProjectImagesOntoScan(camera, color, segments, out));
  return out;
}

}  // namespace

Result<PanopticFrame> DecodeFrame(const DatasetFrame& frame, bool has_persistent_ids) {
  PanopticFrame out;
  out.stamp_ns = frame.stamp_ns;
  DHPMAP_ASSIGN_OR_RETURN(out.T_map_sensor, TransformFromMatrix(frame.T_map_sensor, "pose of frame " + frame.id));
  out.segments = frame.segments;
  out.has_persistent_ids = has_persistent_ids;
  out.unlisted_ids_are_unknown = true;
  if (frame.camera) {
    DHPMAP_ASSIGN_OR_RETURN(out.camera, DecodeCamera(*frame.camera));
  }
  if (frame.lidar) {
    DHPMAP_ASSIGN_OR_RETURN(out.lidar, DecodeLidar(*frame.lidar));
  }
  return out;
}

}  // namespace dhpmap
