// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/io/occupancy_image.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <vector>

namespace dhpmap {
namespace {

struct Grey {
  int width = 0, height = 0;
  std::vector<unsigned char> pixels;  ///< from the top row on
};

/// As netpbm describes the raw form of PGM.
Grey ReadPgm(const std::string& file) {
  std::istringstream in(file);
  std::string magic;
  int most = 0;
  Grey image;
  in >> magic >> image.width >> image.height >> most;
  EXPECT_EQ(magic, "P5");
  EXPECT_EQ(most, 255);
  in.get();
  image.pixels.resize(static_cast<std::size_t>(image.width * image.height));
  in.read(reinterpret_cast<char*>(image.pixels.data()), static_cast<std::streamsize>(image.pixels.size()));
  EXPECT_EQ(in.gcount(), static_cast<std::streamsize>(image.pixels.size()));
  EXPECT_EQ(in.get(), std::istringstream::traits_type::eof());
  return image;
}

Grey ReadPng(const std::string& file) {
  const std::vector<unsigned char> bytes(file.begin(), file.end());
  const cv::Mat mat = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  EXPECT_EQ(mat.type(), CV_8UC1) << "no alpha, which the loader would take into its average";
  return {mat.cols, mat.rows, std::vector<unsigned char>(mat.begin<unsigned char>(), mat.end<unsigned char>())};
}

struct LoadedMap {
  std::string image;
  double resolution_m = 0;
  std::vector<double> origin;
  std::vector<int> cells;  ///< row by row from the lowest
};

/// By the rules of nav2_map_server's loader, map_io.cpp: which keys it needs and of what type, how it tells the three
/// values apart, and which row of the image is which.
LoadedMap LoadAsNav2(const std::string& yaml, const Grey& image) {
  const YAML::Node document = YAML::Load(yaml);
  LoadedMap map;
  map.image = document["image"].as<std::string>();
  EXPECT_FALSE(map.image.empty());
  map.resolution_m = document["resolution"].as<double>();
  map.origin = document["origin"].as<std::vector<double>>();
  EXPECT_EQ(map.origin.size(), 3u);
  const double free_thresh = document["free_thresh"].as<double>();
  const double occupied_thresh = document["occupied_thresh"].as<double>();
  EXPECT_LT(free_thresh, occupied_thresh);
  EXPECT_EQ(document["mode"].as<std::string>(), "trinary");
  const bool is_negated = document["negate"].as<int>() != 0;
  map.cells.resize(image.pixels.size());
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double shade = image.pixels[static_cast<std::size_t>(y * image.width + x)] / 255.0;
      const double occupied = is_negated ? shade : 1.0 - shade;
      int& cell = map.cells[static_cast<std::size_t>(image.width * (image.height - y - 1) + x)];
      cell = occupied_thresh < occupied ? 100 : occupied < free_thresh ? 0 : -1;
    }
  }
  return map;
}

const std::vector<std::int8_t>& Cells() {  // 4 x 3
  static const std::vector<std::int8_t> cells = {0, 100, -1, 0, 100, 100, 0, 0, -1, -1, -1, 100};
  return cells;
}

TEST(OccupancyImage, Nav2ReadsBackTheCellsWhereTheyAre) {
  const std::string yaml = MapYaml("a: 'strange' name #1.pgm", 0.05, {-12.3456789, 3e-7});
  const auto png = PngOf(Cells(), 4, 3);
  ASSERT_TRUE(png.ok());
  for (const Grey& image : {ReadPgm(PgmOf(Cells(), 4, 3)), ReadPng(*png)}) {
    ASSERT_EQ(image.width, 4);
    ASSERT_EQ(image.height, 3);
    const LoadedMap map = LoadAsNav2(yaml, image);
    EXPECT_EQ(map.cells, std::vector<int>(Cells().begin(), Cells().end()));
    EXPECT_EQ(map.image, "a: 'strange' name #1.pgm");
    EXPECT_EQ(map.resolution_m, 0.05);
    EXPECT_NEAR(map.origin[0], -12.3456789, 1e-9);
    EXPECT_NEAR(map.origin[1], 3e-7, 1e-9);
    EXPECT_EQ(map.origin[2], 0);
  }
}

TEST(OccupancyImage, ACellIsAPixelAlsoOfASingleRow) {
  EXPECT_EQ(LoadAsNav2(MapYaml("m.pgm", 1, {0, 0}), ReadPgm(PgmOf(std::span(Cells()).first(4), 4, 1))).cells,
            (std::vector<int>{0, 100, -1, 0}));
}

}  // namespace
}  // namespace dhpmap
