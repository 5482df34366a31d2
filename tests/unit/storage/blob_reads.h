// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace dhpmap::testing {

/// How long stored blobs take to read, without decoding, in microseconds a blob: the median of several runs.
struct BlobReads {
  double one_by_one_us = 0;  ///< each by its key
  double by_64_us = 0;       ///< 64 keys at a time; 0: not measured
  double by_map_us = 0;      ///< all of a map at once; 0: not measured
};

/// Both read at most some thousand blobs.
BlobReads ReadSqliteBlobs(const std::filesystem::path& file);
BlobReads ReadPostgresBlobs(const std::string& url, const std::string& schema);

/// The most round trips that a commit of 1, 50 or 500 tiles, or an edit, takes in a database.
int CountTripsOfCommits(const std::string& url, const std::string& schema);

}  // namespace dhpmap::testing
