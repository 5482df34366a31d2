// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "clients/simulator/renderer.h"

namespace dhpmap::simulator {

/// The apartment from above without ceiling, with the camera's path drawn in; 4:3.
RenderedFrame RenderPlan(int width_px);

}  // namespace dhpmap::simulator
