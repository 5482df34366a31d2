// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "storage/files/map_taker.h"
#include "storage/store.h"

namespace dhpmap {

/// An import whose data are received into a new file at `place`, which is removed with it.
Result<std::unique_ptr<MapImport>> BeginMapImport(std::string place, MakeTaker make_taker);

}  // namespace dhpmap
