// SPDX-License-Identifier: BSD-3-Clause
#include "clients/datasets/label_table.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>

#include "clients/datasets/file_reader.h"

namespace dhpmap {
namespace {

constexpr std::size_t kShortestCommonName = 3;

/// Cells of one row by column name.
class NamedCells {
 public:
  NamedCells(const std::vector<std::string>& header, const TextRow& row) : header_(header), row_(row) {}
  /// Empty if the column is missing or the cell is empty.
  [[nodiscard]] std::string Text(const char* column) const {
    const auto it = std::find(header_.begin(), header_.end(), column);
    const auto index = static_cast<std::size_t>(it - header_.begin());
    return index < row_.cells.size() ? row_.cells[index] : std::string();
  }
  [[nodiscard]] Result<std::int64_t> Integer(const char* column, std::int64_t fallback, std::int64_t max) const {
    const std::string text = Text(column);
    if (text.empty()) return fallback;
    Result<std::int64_t> value = ParseInteger(text);
    if (!value.ok() || *value < 0 || *value > max) {
      return InvalidArgument(std::string(column) + " must be 0 to " + std::to_string(max) + ", not '" + text + "'");
    }
    return value;
  }

 private:
  const std::vector<std::string>& header_;
  const TextRow& row_;
};

SizeClass SizeOf(const std::string& text) {
  return text == "S" ? SizeClass::kSmall : text == "L" ? SizeClass::kLarge : SizeClass::kMedium;
}

Result<LabelRow> ParseRow(const NamedCells& cells, std::int64_t instance_id) {
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t class_id, cells.Integer("ClassID", instance_id, 65534));
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t panoptic, cells.Integer("PanopticID", 1, 65534));
  const Color made_up = PaletteColor(static_cast<std::uint32_t>(class_id));
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t r, cells.Integer("R", made_up.r, 255));
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t g, cells.Integer("G", made_up.g, 255));
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t b, cells.Integer("B", made_up.b, 255));
  LabelRow row;
  row.instance_id = instance_id;
  row.label_class = {
      .id = ClassId(static_cast<std::uint16_t>(class_id)),
      .name = cells.Text("Name"),
      .panoptic = panoptic == 0 ? Panoptic::kStuff : Panoptic::kThing,
      .size = SizeOf(cells.Text("Size")),
      .color = {static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(b)}};
  const std::string name = ToLower(row.label_class.name);
  row.is_unknown = name == "unknown" || name == "things";
  return row;
}

/// The most frequent value; the smallest on ties.
template <typename Value, typename Getter>
Value MostCommon(const std::vector<const LabelRow*>& rows, Getter get) {
  std::map<Value, int> votes;
  for (const LabelRow* row : rows) ++votes[get(*row)];
  return std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

LabelClass ClassOf(const std::vector<const LabelRow*>& rows, RowNames row_names) {
  LabelClass result = rows.front()->label_class;
  result.panoptic = MostCommon<Panoptic>(rows, [](const LabelRow& row) { return row.label_class.panoptic; });
  result.size = MostCommon<SizeClass>(rows, [](const LabelRow& row) { return row.label_class.size; });
  if (row_names == RowNames::kInstances) {
    std::vector<std::string> names;
    for (const LabelRow* row : rows) names.push_back(ClassNameOfInstance(row->label_class.name));
    result.name = CommonName(names);
  }
  if (result.name.empty()) result.name = "class " + std::to_string(result.id.value);
  return result;
}

}  // namespace

Result<LabelTable> LabelTable::Read(const std::filesystem::path& path, RowNames names) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<TextRow> rows, ReadRows(path, ','));
  if (rows.empty() || std::find(rows[0].cells.begin(), rows[0].cells.end(), "InstanceID") == rows[0].cells.end()) {
    return BadFile(path, "the first line must name the columns, InstanceID among them");
  }
  LabelTable table;
  std::map<ClassId, std::vector<const LabelRow*>> rows_of_class;
  table.rows_.reserve(rows.size());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const NamedCells cells(rows[0].cells, rows[i]);
    if (cells.Text("InstanceID").empty()) continue;
    const std::string where = "line " + std::to_string(rows[i].line) + ": ";
    Result<std::int64_t> id = cells.Integer("InstanceID", 0, 0xffffffff);
    if (!id.ok()) return BadFile(path, where + id.status().message());
    Result<LabelRow> row = ParseRow(cells, *id);
    if (!row.ok()) return BadFile(path, where + row.status().message());
    if (!table.row_of_.emplace(*id, table.rows_.size()).second) {
      return BadFile(path, where + "InstanceID " + std::to_string(*id) + " is there twice");
    }
    table.rows_.push_back(std::move(*row));
  }
  for (const LabelRow& row : table.rows_) {
    if (!row.is_unknown) rows_of_class[row.label_class.id].push_back(&row);
  }
  for (const auto& [id, class_rows] : rows_of_class) table.classes_.push_back(ClassOf(class_rows, names));
  return table;
}

const LabelRow* LabelTable::Find(std::int64_t instance_id) const {
  const auto it = row_of_.find(instance_id);
  return it == row_of_.end() ? nullptr : &rows_[it->second];
}

std::vector<SegmentInfo> LabelTable::AllSegments() const {
  std::vector<SegmentInfo> segments;
  for (const LabelRow& row : rows_) {
    if (row.instance_id == 0) continue;  // no label
    SegmentInfo& segment = segments.emplace_back();
    segment.id = SegmentId(static_cast<std::uint32_t>(row.instance_id));
    if (!row.is_unknown) segment.class_id = row.label_class.id;
    segment.score = 1.0f;
  }
  return segments;
}

std::string ClassNameOfInstance(const std::string& instance_name) {
  std::string name = instance_name;
  while (true) {
    const std::size_t bar = name.find_last_of('_');
    if (bar == std::string::npos || bar == 0 || bar + 1 == name.size()) break;
    if (name.find_first_not_of("0123456789", bar + 1) != std::string::npos) break;
    name.resize(bar);
  }
  const auto is = [&name](std::size_t from_end, int (*test)(int)) {
    return name.size() > from_end && test(static_cast<unsigned char>(name[name.size() - 1 - from_end])) != 0;
  };
  if (is(0, std::isupper) && is(1, std::islower)) name.pop_back();
  return name;
}

std::string CommonName(const std::vector<std::string>& names) {
  if (names.empty()) return {};
  std::string prefix = names.front(), suffix = names.front();
  for (const std::string& name : names) {
    const auto front = std::mismatch(prefix.begin(), prefix.end(), name.begin(), name.end());
    prefix.erase(front.first, prefix.end());
    const auto back = std::mismatch(suffix.rbegin(), suffix.rend(), name.rbegin(), name.rend());
    suffix.erase(suffix.begin(), back.first.base());
  }
  if (prefix.size() >= kShortestCommonName) return prefix;
  if (suffix.size() >= kShortestCommonName) return suffix;
  return names.front();
}

Color PaletteColor(std::uint32_t id) {
  constexpr double kGoldenRatio = 0.6180339887498949;
  const double hue = std::fmod(id * kGoldenRatio, 1.0) * 6.0;
  const auto channel = [hue](double shift) {
    const double k = std::fmod(hue + shift, 6.0);
    return static_cast<std::uint8_t>(std::lround(230.0 - 150.0 * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0)));
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

}  // namespace dhpmap
