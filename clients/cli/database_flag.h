// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace dhpmap {

/// Adds --db: the database of servers that share one. A password belongs in ~/.pgpass, not in the URL.
inline CLI::Option* AddDatabaseFlag(CLI::App& command, std::string& url) {
  const auto check = [](const std::string& text) {
    const bool is_url = text.starts_with("postgresql://") || text.starts_with("postgres://");
    return is_url ? std::string() : std::string("it must be postgresql://USER@HOST/NAME");
  };
  return command
      .add_option("--db", url,
                  "The PostgreSQL database of servers that share one: as their --db; password in ~/.pgpass")
      ->type_name("URL")
      ->check(CLI::Validator(check, ""));
}

}  // namespace dhpmap
