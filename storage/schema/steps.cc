// SPDX-License-Identifier: BSD-3-Clause
#include "storage/schema/steps.h"

#include "storage/schema/bundle_blocks.h"

namespace dhpmap {

SchemaSteps ReleasedSteps() {
  static const SchemaStep steps[] = {
      {.sql = SchemaSql()[0]},                          // 0001_init.sql
      {.sql = SchemaSql()[1]},                          // 0002_checksum_versions.sql
      {.sql = SchemaSql()[2]},                          // 0003_sessions_and_history.sql
      {.sql = SchemaSql()[3]},                          // 0004_map_tiles.sql
      {.sql = SchemaSql()[4]},                          // 0005_gone.sql
      {.sql = SchemaSql()[5]},                          // 0006_objects.sql
      {.sql = SchemaSql()[6], .work = &kBundleBlocks},  // 0007_tiles_and_changes.sql
      {.sql = SchemaSql()[7]},                          // 0008_edits.sql
      {.sql = SchemaSql()[8]},                          // 0009_sightings.sql
      {.sql = SchemaSql()[9]},                          // 0010_locks_and_kept_clear.sql
      {.sql = SchemaSql()[10]},                         // 0011_tile_cells.sql
      {.sql = SchemaSql()[11]},                         // 0012_leaving.sql
      {.sql = SchemaSql()[12]},                         // 0013_tile_extents.sql
      {.sql = SchemaSql()[13]},                         // 0014_seen_time.sql
      {.sql = SchemaSql()[14]},                         // 0015_outlines.sql
  };
  return steps;
}

}  // namespace dhpmap
