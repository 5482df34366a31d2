// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/output.h"

#include <filesystem>
#include <fstream>

namespace dhpmap::evaluator {

Result<std::vector<std::pair<std::string, std::string>>> ParseSettings(const std::vector<std::string>& settings) {
  std::vector<std::pair<std::string, std::string>> parsed;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) return InvalidArgument("'" + setting + "' is not key=value");
    parsed.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
  }
  return parsed;
}

std::string DatasetName(const std::string& directory) {
  std::error_code ignored;
  std::filesystem::path path = std::filesystem::absolute(directory, ignored).lexically_normal();
  if (path.filename().empty()) path = path.parent_path();
  const std::filesystem::path parent = path.parent_path();
  if (parent.filename() != "sequences") return path.filename().string();
  return parent.parent_path().filename().string() + " " + path.filename().string();
}

Status WriteText(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  return out.good() ? Status::Ok() : Unavailable("cannot write " + path);
}

Status CheckWritable(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    if (path.empty()) continue;
    std::error_code ignored;
    const std::filesystem::path folder = std::filesystem::absolute(path, ignored).parent_path();
    if (!std::filesystem::is_directory(folder, ignored)) return Unavailable("there is no folder " + folder.string());
  }
  return Status::Ok();
}

}  // namespace dhpmap::evaluator
