// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/io/glb.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace dhpmap {
namespace {

static_assert(std::endian::native == std::endian::little, "records are copied as they are in memory");

constexpr std::size_t kGlbVertexBytes = 20;
constexpr std::size_t kNormalOffset = 8, kColorOffset = 12;
constexpr double kSteps = 65535;
// Constants of glTF.
constexpr int kByte = 5120, kShort = 5123, kInt = 5125, kArrayBuffer = 34962, kElementBuffer = 34963;

struct Quantisation {
  Eigen::Vector3d min_m = Eigen::Vector3d::Zero();
  double side_m = 1;
  std::array<std::uint16_t, 3> low{}, high{};  ///< bounds of the written positions

  explicit Quantisation(const Mesh& mesh) {
    if (mesh.vertices_m.empty()) return;
    Eigen::Vector3f min = mesh.vertices_m[0], max = min;
    for (const Eigen::Vector3f& vertex : mesh.vertices_m) {
      min = min.cwiseMin(vertex);
      max = max.cwiseMax(vertex);
    }
    min_m = min.cast<double>();
    side_m = std::max(1e-6, static_cast<double>((max - min).maxCoeff()));
    low = At(min);
    high = At(max);
  }

  [[nodiscard]] std::array<std::uint16_t, 3> At(const Eigen::Vector3f& vertex) const {
    std::array<std::uint16_t, 3> steps;
    for (int i = 0; i < 3; ++i) {
      const double step = (static_cast<double>(vertex[i]) - min_m[i]) / side_m * kSteps;
      steps[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(std::lround(std::clamp(step, 0.0, kSteps)));
    }
    return steps;
  }
};

/// sRGB to linear light.
const std::array<std::uint16_t, 256>& LinearSteps() {
  static const auto table = [] {
    std::array<std::uint16_t, 256> steps{};
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const double c = static_cast<double>(i) / 255;
      const double linear = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
      steps[i] = static_cast<std::uint16_t>(std::lround(linear * kSteps));
    }
    return steps;
  }();
  return table;
}

template <typename T, std::size_t N>
void PutGlb(const std::array<T, N>& values, char* out) {
  std::memcpy(out, values.data(), sizeof values);
}

void AppendGlbVertices(const Mesh& mesh, const Quantisation& quantisation, std::string& bytes) {
  const auto& linear = LinearSteps();
  const std::size_t begin = bytes.size();
  bytes.resize(begin + mesh.vertices_m.size() * kGlbVertexBytes);
  char* out = bytes.data() + begin;
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i, out += kGlbVertexBytes) {
    PutGlb(quantisation.At(mesh.vertices_m[i]), out);
    std::array<std::int8_t, 3> normal;
    for (int k = 0; k < 3; ++k) {
      normal[static_cast<std::size_t>(k)] =
          static_cast<std::int8_t>(std::lround(std::clamp(mesh.normals[i][k], -1.0f, 1.0f) * 127));
    }
    PutGlb(normal, out + kNormalOffset);
    const Color color = mesh.colors[i];
    PutGlb(std::array<std::uint16_t, 3>{linear[color.r], linear[color.g], linear[color.b]}, out + kColorOffset);
  }
}

bool HasShortIndices(const Mesh& mesh) { return mesh.vertices_m.size() <= 65535; }

void AppendGlbTriangles(const Mesh& mesh, std::string& bytes) {
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::size_t at = bytes.size();
    if (HasShortIndices(mesh)) {
      bytes.resize(at + 6);
      PutGlb(std::array<std::uint16_t, 3>{static_cast<std::uint16_t>(a), static_cast<std::uint16_t>(b),
                                          static_cast<std::uint16_t>(c)},
             bytes.data() + at);
    } else {
      bytes.resize(at + 12);
      PutGlb(std::array<std::uint32_t, 3>{a, b, c}, bytes.data() + at);
    }
  }
  bytes.resize((bytes.size() + 3) & ~std::size_t{3}, '\0');
}

std::string NumberText(double number) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

template <typename Values>
std::string List(const Values& values) {
  std::string out = "[";
  for (const auto value : values) {
    if (out.size() > 1) out += ',';
    out += NumberText(static_cast<double>(value));
  }
  return out + "]";
}

/// Builds the lists of the file's JSON.
class GlbBuilder {
 public:
  void Add(const GlbObject& object) {
    const Mesh& mesh = *object.mesh;
    const bool is_empty = mesh.triangles.empty();
    const int node = num_nodes_;
    num_nodes_ += is_empty ? 1 : 2;
    Append(scene_, std::to_string(node));
    const Eigen::Quaterniond q(object.T_file_object.linear());
    const Eigen::Vector3d t = object.T_file_object.translation();
    std::string text = R"({"name":")" + object.name + R"(","translation":)" + List(t) + R"(,"rotation":)" +
                       List(std::array{q.x(), q.y(), q.z(), q.w()});
    if (!object.extras.empty()) text += R"(,"extras":)" + object.extras;
    if (!is_empty) text += R"(,"children":[)" + std::to_string(node + 1) + "]";
    Append(nodes_, text + "}");
    if (!is_empty) AddMesh(mesh);
  }

  [[nodiscard]] std::string File() && {
    std::string json = R"({"asset":{"version":"2.0","generator":"dhpmap"},"extensionsUsed":["KHR_mesh_quantization"],)"
                       R"("extensionsRequired":["KHR_mesh_quantization"],"scene":0,"scenes":[{)";
    json += scene_.empty() ? "}]" : R"("nodes":[)" + scene_ + "]}]";
    if (num_nodes_ > 0) json += R"(,"nodes":[)" + nodes_ + "]";
    if (num_meshes_ > 0) {
      json += R"(,"materials":[{"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":1}}],"meshes":[)" +
              meshes_ + R"(],"accessors":[)" + accessors_ + R"(],"bufferViews":[)" + views_ +
              R"(],"buffers":[{"byteLength":)" + std::to_string(bytes_.size()) + "}]";
    }
    json += "}";
    json.resize((json.size() + 3) & ~std::size_t{3}, ' ');
    return Framed(json);
  }

 private:
  static void Append(std::string& list, const std::string& item) {
    if (!list.empty()) list += ',';
    list += item;
  }

  void AddMesh(const Mesh& mesh) {
    const Quantisation quantisation(mesh);
    Append(nodes_, R"({"mesh":)" + std::to_string(num_meshes_) + R"(,"translation":)" + List(quantisation.min_m) +
                       R"(,"scale":)" +
                       List(std::array{quantisation.side_m, quantisation.side_m, quantisation.side_m}) + "}");
    const std::size_t vertices_at = bytes_.size();
    AppendGlbVertices(mesh, quantisation, bytes_);
    const std::size_t triangles_at = bytes_.size();
    AppendGlbTriangles(mesh, bytes_);
    const int view = 2 * num_meshes_, accessor = 4 * num_meshes_;
    AddView(vertices_at, triangles_at, kArrayBuffer, R"(,"byteStride":)" + std::to_string(kGlbVertexBytes));
    AddView(triangles_at, bytes_.size(), kElementBuffer, "");
    const std::size_t n = mesh.vertices_m.size();
    AddAccessor(view, 0, kShort, n, "VEC3", true,
                R"(,"min":)" + List(quantisation.low) + R"(,"max":)" + List(quantisation.high));
    AddAccessor(view, kNormalOffset, kByte, n, "VEC3", true, "");
    AddAccessor(view, kColorOffset, kShort, n, "VEC3", true, "");
    AddAccessor(view + 1, 0, HasShortIndices(mesh) ? kShort : kInt, 3 * mesh.triangles.size(), "SCALAR", false, "");
    const auto number = [accessor](int i) { return std::to_string(accessor + i); };
    Append(meshes_, R"({"primitives":[{"attributes":{"POSITION":)" + number(0) + R"(,"NORMAL":)" + number(1) +
                        R"(,"COLOR_0":)" + number(2) + R"(},"indices":)" + number(3) + R"(,"material":0}]})");
    ++num_meshes_;
  }

  void AddView(std::size_t begin, std::size_t end, int target, const std::string& more) {
    Append(views_, R"({"buffer":0,"byteOffset":)" + std::to_string(begin) + R"(,"byteLength":)" +
                       std::to_string(end - begin) + R"(,"target":)" + std::to_string(target) + more + "}");
  }

  void AddAccessor(int view, std::size_t offset, int type, std::size_t count, const char* shape, bool is_normalized,
                   const std::string& more) {
    Append(accessors_, R"({"bufferView":)" + std::to_string(view) + R"(,"byteOffset":)" + std::to_string(offset) +
                           R"(,"componentType":)" + std::to_string(type) + R"(,"count":)" + std::to_string(count) +
                           R"(,"type":")" + shape + R"(")" + (is_normalized ? R"(,"normalized":true)" : "") + more +
                           "}");
  }

  [[nodiscard]] std::string Framed(const std::string& json) const {
    constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;
    const auto append = [](std::string& out, std::uint32_t number) {
      out.append(reinterpret_cast<const char*>(&number), sizeof number);
    };
    const std::size_t size = 20 + json.size() + (bytes_.empty() ? 0 : 8 + bytes_.size());
    std::string file;
    file.reserve(size);
    for (const std::uint32_t number :
         {kMagic, kVersion, static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(json.size()), kJsonChunk}) {
      append(file, number);
    }
    file += json;
    if (bytes_.empty()) return file;
    append(file, static_cast<std::uint32_t>(bytes_.size()));
    append(file, kBinChunk);
    return file += bytes_;
  }

  int num_nodes_ = 0, num_meshes_ = 0;
  std::string scene_, nodes_, meshes_, accessors_, views_, bytes_;
};

}  // namespace

std::string WriteGlb(std::span<const GlbObject> objects) {
  GlbBuilder builder;
  for (const GlbObject& object : objects) builder.Add(object);
  return std::move(builder).File();
}

}  // namespace dhpmap
