// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <regex>

#include "clients/evaluator/class_chart.h"
#include "clients/evaluator/html_text.h"
#include "clients/evaluator/markdown.h"
#include "clients/evaluator/score_bars.h"

namespace dhpmap::evaluator {
namespace {

int NumOf(const std::string& part, const std::string& text) {
  int num = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++num;
  return num;
}

constexpr int kSide_px = 200;

/// A square of floor, of which the system takes the right half for a thing.
class ReportTest : public ::testing::Test {
 protected:
  ReportTest() : truth_(Floor(), *ClassMap::Create(Classes()), ProtocolFor(0.04)) {
    LabelledSurface surface{.mesh = truth_.mesh(), .instance_scores = {}};
    for (std::size_t i = 0; i < surface.mesh.classes.size(); ++i) {
      if (surface.mesh.vertices_m[i].x() > 0.5f) surface.mesh.classes[i] = 2, surface.mesh.instances[i] = 7;
    }
    ThreadPool pool(1);
    scores_ = Evaluate(truth_, surface, true, pool, &labels_);
    scores_.system = "dhp";
    experiment_.directory = "/data/a&b";
    experiment_.classes = truth_.classes();
    experiment_.protocol = truth_.protocol();
    experiment_.systems = experiment_.on_points = {scores_};
  }
  static std::vector<EvaluatedClass> Classes() {
    return {{.name = "floor <1>", .is_thing = false, .truth_ids = {1}, .predicted_ids = {1}},
            {.name = "chair", .is_thing = true, .truth_ids = {2}, .predicted_ids = {2}}};
  }
  static Mesh Floor() {
    constexpr std::uint32_t kSide = 21;
    Mesh mesh;
    for (std::uint32_t y = 0; y < kSide; ++y) {
      for (std::uint32_t x = 0; x < kSide; ++x) {
        mesh.vertices_m.emplace_back(0.05f * static_cast<float>(x), 0.05f * static_cast<float>(y), 0);
        mesh.normals.emplace_back(0, 0, 1);
        mesh.colors.push_back({120, 80, 40});
        mesh.classes.push_back(1);
        mesh.instances.push_back(3);
        const std::uint32_t here = kSide * y + x;
        if (x + 1 == kSide || y + 1 == kSide) continue;
        mesh.triangles.push_back({here, here + 1, here + kSide + 1});
        mesh.triangles.push_back({here, here + kSide + 1, here + kSide});
      }
    }
    return mesh;
  }
  [[nodiscard]] std::string Page() const {
    ReportPictures pictures;
    pictures.Add(TruthPictures(truth_, kSide_px), scores_, labels_);
    return ReportPage(experiment_, pictures);
  }

  Truth truth_;
  Scores scores_;
  std::vector<ElementLabel> labels_;
  Experiment experiment_;
};

TEST_F(ReportTest, ShowsErrorsWhereTheyAre) {
  const Picture errors = TruthPictures(truth_, kSide_px).Errors(scores_, labels_).above;
  const Color left = errors.at(errors.width_px / 4, errors.height_px / 2);
  const Color right = errors.at(3 * errors.width_px / 4, errors.height_px / 2);
  EXPECT_LT(std::abs(left.r - left.b), 12) << "grey: right";
  EXPECT_GT(right.r, right.b + 60) << "red: wrong class";
  const Picture seen = TruthPictures(truth_, kSide_px).Seen().above;
  EXPECT_GT(seen.at(seen.width_px / 2, seen.height_px / 2).r, seen.at(seen.width_px / 2, seen.height_px / 2).b + 30);
}

TEST_F(ReportTest, WhatMatchesTheTruthHasItsColour) {
  std::vector<ElementLabel> all_right = truth_.labels();
  for (ElementLabel& label : all_right) label.instance = 99;
  Scores scores = scores_;
  scores.panoptics.matches = {{truth_.labels().front(), all_right.front()}};
  const TruthPictures pictures(truth_, kSide_px);
  EXPECT_EQ(pictures.Labels(scores, all_right).above.pixels, pictures.TruthLabels().above.pixels);
  scores.panoptics.matches.clear();
  EXPECT_NE(pictures.Labels(scores, all_right).above.pixels, pictures.TruthLabels().above.pixels);
}

TEST_F(ReportTest, IsOnePageThatNeedsNothingElse) {
  const std::string page = Page();
  EXPECT_EQ(NumOf("<img ", page), 7) << "the camera's, and from each side truth, map and errors";
  EXPECT_EQ(NumOf("src=\"", page), NumOf("src=\"data:image/jpeg;base64,", page));
  for (const char* elsewhere : {"http:", "https:", "<script", "<link", "@import", "url(", "href"}) {
    EXPECT_EQ(page.find(elsewhere), std::string::npos) << elsewhere;
  }
  for (const char* tag :
       {"section", "table", "tr", "td", "th", "details", "svg", "text", "figure", "label", "ul", "li"}) {
    const std::string name = tag;
    const auto num_open = NumOf("<" + name + ">", page) + NumOf("<" + name + " ", page);
    EXPECT_EQ(num_open, NumOf("</" + name + ">", page)) << tag;
  }
}

TEST_F(ReportTest, TellsScoresByNameWithMarkupAsText) {
  const std::string page = Page();
  EXPECT_NE(page.find("<h1>a&amp;b</h1>"), std::string::npos);
  EXPECT_NE(page.find("floor &lt;1&gt;"), std::string::npos);
  EXPECT_EQ(page.find("floor <1>"), std::string::npos);
  EXPECT_NE(page.find("<b>" + Decimals(scores_.panoptics.all.pq, 3) + "</b>"), std::string::npos);
}

TEST_F(ReportTest, HoldsThePicturesThatWereTaken) {
  const Picture picture(3, 2, {10, 200, 30});
  const std::string bytes = Encode(picture, PictureFormat::kPng);
  const cv::Mat read = cv::imdecode(std::vector<unsigned char>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
  ASSERT_EQ(read.cols, 3);
  ASSERT_EQ(read.rows, 2);
  EXPECT_EQ(read.at<cv::Vec3b>(1, 2), cv::Vec3b(30, 200, 10));
}

TEST_F(ReportTest, TheBestOfAColumnIsBold) {
  Scores worse = scores_;
  worse.system = "votes";
  worse.panoptics.all.pq = scores_.panoptics.all.pq / 2;
  const std::string table = ScoreBars(experiment_, {&scores_, &worse});
  const std::string best = Decimals(scores_.panoptics.all.pq, 3), other = Decimals(worse.panoptics.all.pq, 3);
  EXPECT_TRUE(std::regex_search(table, std::regex("class=\"n bar best\"[^>]*>" + best))) << table;
  EXPECT_FALSE(std::regex_search(table, std::regex("best\"[^>]*>" + other))) << table;
}

TEST(ClassChart, HasADotForEachValueThatThereIs) {
  const ClassChart chart{.measures = {"PQ", "IoU"},
                         .systems = {"a", "b"},
                         .colors = {"red", "blue"},
                         .rows = {{"sofa", {{0.5, 0.25}, {1.0, 0.0}}}, {"bed", {{std::nullopt, 0.75}, {0.1, 0.1}}}}};
  const std::string svg = SvgOf(chart);
  EXPECT_EQ(NumOf("<circle", svg), 7);
  EXPECT_EQ(NumOf("fill=\"blue\"", svg), 4);
  EXPECT_NE(svg.find("<title>sofa, PQ of b: 0.250</title>"), std::string::npos);
  EXPECT_EQ(NumOf("class=\"span\"", svg), 2) << "where systems differ";
}

TEST(HtmlOfTable, TakesMarkdown) {
  MarkdownTable table({"system", "PQ"});
  table.Add({"a<b", "0.5"});
  EXPECT_EQ(HtmlOfTable(table.Text()),
            "<div class=\"scroll\"><table><tr><th>system</th><th class=\"n\">PQ</th></tr>\n"
            "<tr><td>a&lt;b</td><td class=\"n\">0.5</td></tr>\n</table></div>\n");
}

TEST(Base64, IsThatOfRfc4648) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(Base64("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace dhpmap::evaluator
