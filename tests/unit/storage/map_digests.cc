// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/storage/map_digests.h"

#include <map>
#include <sstream>
#include <vector>

namespace dhpmap::testing {
namespace {

using ClassNames = std::map<std::string, std::string>;  // by number

/// The lines of one section; the first is not indented.
using SectionLines = std::vector<std::string>;

std::string FirstWord(const std::string& line) { return line.substr(0, line.find(' ')); }

/// The word after the last `key`; empty where there is none.
std::string WordAfter(const std::string& line, const std::string& key) {
  const std::size_t at = line.rfind(key);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + key.size();
  return line.substr(begin, line.find(' ', begin) - begin);
}

/// Lists of one kind are one section; each map and each submap is one of its own.
bool BeginsSection(const std::string& line, const SectionLines& section) {
  if (line.starts_with(' ') || line.starts_with("create_time_ns ")) return false;
  return section.empty() || line.starts_with("map ") || line.starts_with("submap ") ||
         FirstWord(line) != FirstWord(section.front());
}

std::vector<SectionLines> SectionsOf(std::string_view map_text) {
  std::vector<SectionLines> sections;
  std::istringstream lines{std::string(map_text)};
  for (std::string line; std::getline(lines, line);) {
    if (sections.empty() || BeginsSection(line, sections.back())) sections.emplace_back();
    sections.back().push_back(line);
  }
  return sections;
}

ClassNames NamesIn(const SectionLines& classes) {
  ClassNames names;
  for (const std::string& line : classes) {
    const std::size_t begin = line.find('\'') + 1;
    names[WordAfter(line.substr(0, begin - 1), "class ")] = line.substr(begin, line.rfind("' panoptic ") - begin);
  }
  return names;
}

/// Of all its blocks.
long NumVoxels(const SectionLines& section, const std::string& layer) {
  long count = 0;
  for (const std::string& line : section) {
    if (line.starts_with("    " + layer + " ")) count += std::stol(WordAfter(line, layer + " "));
  }
  return count;
}

/// "submap 7 'seat' (chair): revision 21, voxels 812 tsdf 700 labels 3 gone".
std::string SubmapSummary(const SectionLines& section, const ClassNames& names) {
  const std::string& head = section.front();
  std::string text = head.substr(0, head.rfind(" panoptic "));
  const auto name = names.find(WordAfter(head, " class "));
  if (name != names.end()) text.append(" (").append(name->second).append(")");
  for (const std::string& line : section) {
    if (line.starts_with("  activity ")) text.append(": revision ").append(WordAfter(line, " revision "));
  }
  text += ", voxels";
  for (const char* layer : {"tsdf", "labels", "gone"}) {
    text.append(" ").append(std::to_string(NumVoxels(section, layer))).append(" ").append(layer);
  }
  return text;
}

std::string Summary(const SectionLines& section, const ClassNames& names) {
  const std::string& head = section.front();
  if (head.starts_with("map ")) return head;
  if (head.starts_with("submap ")) return SubmapSummary(section, names);
  return FirstWord(head) + ": " + std::to_string(section.size()) + " lines";
}

}  // namespace

std::string DigestOf(std::string_view text) {
  constexpr auto kPrime = (static_cast<unsigned __int128>(1) << 88) + 0x13B;
  auto hash = (static_cast<unsigned __int128>(0x6c62272e07bb0142) << 64) + 0x62b821756295c58d;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * kPrime;
  std::string digits(32, '0');
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, hash >>= 4) {
    *digit = "0123456789abcdef"[static_cast<unsigned>(hash & 15)];
  }
  return digits;
}

std::string DigestsOf(std::string_view map_text) {
  std::string digests;
  ClassNames names;
  for (const SectionLines& section : SectionsOf(map_text)) {
    if (section.front().starts_with("class ")) names = NamesIn(section);
    std::string text;
    for (const std::string& line : section) text += line + "\n";
    digests += DigestOf(text) + "  " + Summary(section, names) + "\n";
  }
  return digests;
}

}  // namespace dhpmap::testing
