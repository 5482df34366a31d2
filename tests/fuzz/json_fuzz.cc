// SPDX-License-Identifier: BSD-3-Clause
// proto3 JSON: what is read can be written, and is then read as the same message.
#include <string_view>

#include "dhpmap/v1/map_service.pb.h"
#include "dhpmap/v1/mapping_service.pb.h"
#include "server/json/reader.h"
#include "server/json/writer.h"
#include "tests/fuzz/fuzz_target.h"

namespace dhpmap {
namespace {

std::string Written(const google::protobuf::Message& message) {
  std::string text;
  json::Append(message, &text);
  return text;
}

template <typename Message>
void ReadWriteRead(std::string_view text) {
  Message message;
  json::Paths paths;
  if (!json::Read(text, &message, &paths).ok()) return;
  const std::string written = Written(message);
  Message again;
  fuzz::Require(json::Read(written, &again).ok());
  fuzz::Require(Written(again) == written);
}

}  // namespace

std::vector<std::string> fuzz::Seeds() {
  return {
      R"({"map":{"display_name":"R\u00e4ume \ud83d\ude00","config":{"voxel_size_m":0.04}},"map_id":"a"})",
      R"({"map":"maps/a","sequence":"9007199254740993","frame":{"stampNs":"-1","lidar":{"packedPointsM":[1,2.5e-1,-0],)"
      R"("segmentIds":[1,2],"rgb":"AQID_-=="},"segments":[{"id":7,"classId":1,"score":0.5}]}})",
      R"({"frame":{"mapFromSensorMatrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],"depthCamera":{"depth":)"
      R"({"encoding":"RAW_F32","data":"AAAA","scaleM":"NaN"}},"hasPersistentIds":true}})",
      "{ }", R"({"sequence":1e2,"frame":null})"};
}

}  // namespace dhpmap

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  dhpmap::ReadWriteRead<dhpmap::v1::IntegrateFramesRequest>(text);
  dhpmap::ReadWriteRead<dhpmap::v1::CreateMapRequest>(text);
  return 0;
}
