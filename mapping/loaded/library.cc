// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/loaded/library.h"

#include <dlfcn.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

/// Only ours: what lies in the working directory, or where the environment points to, is anybody's.
Result<void*> Load(const char* file) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  std::string why = error ? error.message() : std::string();
  for (const char* folder : {".", "../bin", "../lib/dhpmap"}) {
    if (error) break;
    const fs::path path = program.parent_path() / folder / file;
    std::error_code unreadable;
    if (!fs::exists(path, unreadable) && !unreadable) continue;
    if (void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) return library;
    why = dlerror();  // NOLINT(concurrency-mt-unsafe): glibc keeps one a thread
  }
  return Unavailable(std::string("cannot load ") + file + ": " + (why.empty() ? "it is not beside the program" : why));
}

}  // namespace

Result<void*> LoadSymbol(const char* file, const char* symbol) {
  DHPMAP_ASSIGN_OR_RETURN(void* library, Load(file));
  if (void* found = dlsym(library, symbol)) return found;
  return Internal(std::string(file) + " lacks " + symbol + ": it is of another version");
}

}  // namespace dhpmap
