// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/attacks/lying_frames.h"

#include <atomic>
#include <chrono>
#include <cstdio>
#include <utility>

#include "dhpmap/v1/map_service.grpc.pb.h"
#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "mapping/base/reason.h"
#include "tests/rig/at_once.h"
#include "tests/rig/attacks/image_bombs.h"
#include "tests/rig/server_under_test.h"
#include "tests/support/status_reason.h"

namespace dhpmap::rig {
namespace {

constexpr char kLiesId[] = "lies", kLies[] = "maps/lies";
constexpr int kNumStreams = 8;
constexpr std::chrono::seconds kLongestStream{14};
constexpr int kWidth_px = 640, kHeight_px = 480;  ///< of an ordinary camera
constexpr int kHuge_px = 8192;                    ///< 2^26 pixels
constexpr int kLarge_px = 4096, kTall_px = 4000;  ///< that still fit into what frames may take decoded: 250 MiB
constexpr int kNoisy_px = 1280, kNoisyTall_px = 960;
constexpr int kNumRows = 1'000'000;

void Set(v1::Image& image, v1::Image::Encoding encoding, std::string data) {
  image.set_encoding(encoding);
  image.set_data(std::move(data));
  image.set_scale_m(0.001);
}

std::string Zeros(std::size_t count) { return std::string(count, '\0'); }

/// Of a camera at the origin, with depth images of the size that it says, without returns.
LyingFrame FrameOf(std::string what, int width_px, int height_px) {
  LyingFrame lie{.what = std::move(what)};
  v1::Frame& frame = *lie.request.mutable_frame();
  for (int i = 0; i < 16; ++i) frame.add_map_from_sensor_matrix(i % 5 == 0 ? 1 : 0);
  v1::PinholeCamera& camera = *frame.mutable_depth_camera()->mutable_camera();
  camera.set_width_px(width_px);
  camera.set_height_px(height_px);
  camera.set_fx_px(width_px);
  camera.set_fy_px(width_px);
  camera.set_cx_px(0.5 * width_px);
  camera.set_cy_px(0.5 * height_px);
  frame.set_allow_unlisted_ids(true);
  return lie;
}

v1::DepthCameraFrame& Images(LyingFrame& lie) { return *lie.request.mutable_frame()->mutable_depth_camera(); }

LyingFrame OrdinaryFrame(std::string what) {
  LyingFrame lie = FrameOf(std::move(what), kWidth_px, kHeight_px);
  Set(*Images(lie).mutable_depth(), v1::Image::RAW_U16, Zeros(std::size_t{2} * kWidth_px * kHeight_px));
  return lie;
}

LyingFrame WithColor(std::string what, std::string file) {
  LyingFrame lie = OrdinaryFrame(std::move(what));
  Set(*Images(lie).mutable_color(), v1::Image::FILE, std::move(file));
  return lie;
}

/// 2^26 pixels of everything, where the camera says so, too.
LyingFrame Huge() {
  LyingFrame lie = FrameOf("all images of 2^26 pixels", kHuge_px, kHuge_px);
  Set(*Images(lie).mutable_depth(), v1::Image::FILE, SmallTiff(kHuge_px, kHuge_px));
  Set(*Images(lie).mutable_color(), v1::Image::FILE, SmallJpeg(kHuge_px, kHuge_px));
  Set(*Images(lie).mutable_segments(), v1::Image::FILE, SmallPng(kHuge_px, kHuge_px));
  return lie;
}

/// As large as is taken, and only the last image is not as it should be.
LyingFrame LargeButForTheLast() {
  LyingFrame lie = FrameOf("images of 2^24 pixels, and one that is not", kLarge_px, kTall_px);
  Set(*Images(lie).mutable_depth(), v1::Image::FILE, SmallTiff(kLarge_px, kTall_px));
  Set(*Images(lie).mutable_color(), v1::Image::FILE, SmallJpeg(kLarge_px, kTall_px));
  Set(*Images(lie).mutable_segments(), v1::Image::RAW_U8, Zeros(1));
  return lie;
}

LyingFrame RawImages(std::string what, v1::Image::Encoding encoding, std::size_t num_bytes) {
  LyingFrame lie = OrdinaryFrame(std::move(what));
  Set(*Images(lie).mutable_depth(), encoding, Zeros(num_bytes));
  return lie;
}

/// Each row is wrong.
LyingFrame Table(std::string what, bool is_one_id, std::uint32_t class_id) {
  LyingFrame lie = OrdinaryFrame(std::move(what));
  auto& rows = *lie.request.mutable_frame()->mutable_segments();
  rows.Reserve(kNumRows);
  for (int i = 1; i <= kNumRows; ++i) {
    v1::Segment* row = rows.Add();
    row->set_id(is_one_id ? 1 : static_cast<std::uint32_t>(i));
    row->set_class_id(class_id);
    row->set_score(0.5f);
  }
  return lie;
}

/// Neighbouring pixels are metres apart: each meets blocks of its own.
LyingFrame Noise() {
  constexpr std::uint64_t kNearest_mm = 500, kRange_mm = 4400;
  LyingFrame lie = FrameOf("noise", kNoisy_px, kNoisyTall_px);
  std::string depth;
  depth.reserve(std::size_t{2} * kNoisy_px * kNoisyTall_px);
  std::uint64_t random = 1;
  for (int i = 0; i < kNoisy_px * kNoisyTall_px; ++i) {
    random = random * 6364136223846793005 + 1442695040888963407;
    const std::uint64_t depth_mm = kNearest_mm + (random >> 33) % kRange_mm;
    depth += static_cast<char>(depth_mm & 0xFF);
    depth += static_cast<char>(depth_mm >> 8);
  }
  Set(*Images(lie).mutable_depth(), v1::Image::RAW_U16, std::move(depth));
  return lie;
}

bool MakeMap(v1::MapService::Stub& maps) {
  v1::CreateMapRequest request;
  request.set_map_id(kLiesId);
  request.mutable_config()->set_voxel_size_m(0.005);
  request.mutable_config()->set_truncation_m(0.02);
  v1::LabelClass* label = request.add_label_classes();
  label->set_id(1);
  label->set_name("chair");
  label->set_kind(v1::LabelClass::THING);
  grpc::ClientContext context;
  v1::CreateMapResponse response;
  const grpc::Status made = maps.CreateMap(&context, request, &response);
  if (!made.ok()) std::printf("FAILED: a map for lies: %s\n", made.error_message().c_str());
  return made.ok();
}

bool IsTyped(const v1::IntegrateFramesResponse& answer) {
  return answer.outcome() == v1::IntegrateFramesResponse::REFUSED &&
         !Reason::Find(testing::ReasonOf(answer.error())).empty();
}

/// How many were not refused as they should be.
int SendOverOneStream(const Target& target, const std::vector<LyingFrame>& lies, int number) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kLongestStream);
  const auto stream = v1::MappingService::NewStub(OwnChannel(target.grpc_address))->IntegrateFrames(&context);
  v1::IntegrateFramesRequest opening;
  opening.set_map(kLies);
  opening.set_session("liar-" + std::to_string(number));
  v1::IntegrateFramesResponse answer;
  std::size_t num_refused = 0;
  bool goes_on = stream->Write(opening) && stream->Read(&answer);
  for (std::size_t i = 0; goes_on && i < lies.size(); ++i) {
    goes_on = stream->Write(lies[i].request) && stream->Read(&answer);
    if (goes_on && IsTyped(answer)) ++num_refused;
    else std::printf("        %s: %s\n", lies[i].what.c_str(), answer.ShortDebugString().substr(0, 300).c_str());
  }
  if (!goes_on) context.TryCancel();
  stream->WritesDone();
  while (stream->Read(&answer)) {
  }
  const grpc::Status ended = stream->Finish();
  if (!ended.ok()) std::printf("        the stream ended: %s\n", ended.error_message().c_str());
  return static_cast<int>(lies.size() - num_refused) + (ended.ok() ? 0 : 1);
}

}  // namespace

std::vector<LyingFrame> LyingFrames() {
  constexpr std::uint32_t kNoClass = 70'000;  // the highest there can be is 65534
  std::vector<LyingFrame> lies;
  lies.push_back(WithColor("a PNG without its pixels", EmptyPng(kWidth_px, kHeight_px)));
  lies.push_back(WithColor("a PNG of 2^26 pixels", SmallPng(kHuge_px, kHuge_px)));
  lies.push_back(WithColor("a JPEG of 2^26 pixels", SmallJpeg(kHuge_px, kHuge_px)));
  lies.push_back(WithColor("a TIFF of 2^26 pixels", SmallTiff(kHuge_px, kHuge_px)));
  lies.push_back(WithColor("a JPEG of two sizes", JpegOfTwoSizes(kWidth_px, kHeight_px, kHuge_px)));
  lies.push_back(Huge());
  lies.push_back(LargeButForTheLast());
  lies.push_back(RawImages("a raw image of one pixel", v1::Image::RAW_U16, 2));
  lies.push_back(RawImages("a raw image of 32 MiB", v1::Image::RAW_F32, std::size_t{32} << 20));
  lies.push_back(Table("10^6 rows of one id", true, 1));
  lies.push_back(Table("10^6 rows of classes that cannot be", false, kNoClass));
  lies.push_back(Noise());
  return lies;
}

bool SendLyingFrames(const Target& target) {
  const auto maps = v1::MapService::NewStub(OwnChannel(target.grpc_address));
  if (!MakeMap(*maps)) return false;
  const std::vector<LyingFrame> lies = LyingFrames();
  std::atomic<int> num_wrong = 0;
  AtOnce(kNumStreams, [&](int number) { num_wrong += SendOverOneStream(target, lies, number); });
  bool held = Expect("lies not refused with a reason", num_wrong, 0, "");
  grpc::ClientContext asking, deleting;
  v1::GetMapRequest get;
  get.set_name(kLies);
  v1::GetMapResponse map;
  v1::DeleteMapRequest remove;
  remove.set_name(kLies);
  v1::DeleteMapResponse removed;
  held &= maps->GetMap(&asking, get, &map).ok();
  held &= Expect("lies that the map has taken", static_cast<double>(map.map().num_frames()), 0, "");
  const grpc::Status status = maps->DeleteMap(&deleting, remove, &removed);
  if (!status.ok()) std::printf("FAILED: deleting the map of lies: %s\n", status.error_message().c_str());
  return held && status.ok();
}

}  // namespace dhpmap::rig
