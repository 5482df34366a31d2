// SPDX-License-Identifier: BSD-3-Clause
import type { ViewStore } from "../state/view";

/** About where a robot's sensors and corners are. */
const usualHeight_m = 0.4;

export const toggleSlice = (store: ViewStore): void =>
  store.set("slice_m", store.get("slice_m") === null ? usualHeight_m : null);
