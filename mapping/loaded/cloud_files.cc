// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/loaded/cloud_files.h"

#include <atomic>

#include "mapping/loaded/library.h"

namespace dhpmap {

Result<const CloudFiles*> LoadCloudFiles() {
  static std::atomic<const CloudFiles*> loaded = nullptr;
  const CloudFiles* known = loaded.load(std::memory_order_acquire);
  if (known != nullptr) return known;
  DHPMAP_ASSIGN_OR_RETURN(const void* symbol, LoadSymbol("libdhpmap_pcl.so", "dhpmap_cloud_files"));
  known = static_cast<const CloudFiles*>(symbol);
  loaded.store(known, std::memory_order_release);
  return known;
}

}  // namespace dhpmap
