// SPDX-License-Identifier: BSD-3-Clause
import type { Tool, ViewStore } from "../state/view";

/** Takes a tool in hand, or puts it away. */
export const toggleTool = (store: ViewStore, tool: Tool): void =>
  store.set("tool", store.get("tool") === tool ? "select" : tool);
