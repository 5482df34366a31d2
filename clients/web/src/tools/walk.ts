// SPDX-License-Identifier: BSD-3-Clause
// Through the map at the height of the eyes: arrow keys walk, a drag looks around.
import { Vector2, Vector3 } from "three";
import type { Renderer } from "../scene/renderer";
import { floorOf_m } from "../scene/unseen";
import type { CameraView, ViewStore } from "../state/view";

const eye_m = 1.6;
const speed_mps = 1.5;
const fast = 2.5;
/** A browser that was busy does not make one jump. */
const longestStep_s = 0.2;
const tiltDown = -0.12;

const ways: { readonly [key: string]: readonly [number, number] } = {
  ArrowUp: [1, 0],
  ArrowDown: [-1, 0],
  ArrowLeft: [0, -1],
  ArrowRight: [0, 1],
};

export class WalkTool {
  private readonly held = new Set<string>();
  private before: CameraView | null = null;
  private last_ms = 0;
  private isFast = false;

  constructor(
    private readonly store: ViewStore,
    private readonly renderer: Renderer,
  ) {
    store.follow(["walks"], () => (store.get("walks") ? this.begin() : this.end()));
    store.follow(["map"], () => store.set("walks", false));
    addEventListener("keyup", (event) => this.held.delete(event.key));
    addEventListener("blur", () => this.held.clear());
  }

  /** Whether the key walks; it does until it is let go. */
  press(event: KeyboardEvent): boolean {
    if (!this.store.get("walks") || !(event.key in ways) || event.altKey) return false;
    this.isFast = event.shiftKey;
    if (this.held.has(event.key)) return true;
    if (this.held.size === 0) {
      this.last_ms = performance.now();
      this.renderer.frames.animate((now_ms) => this.step(now_ms));
    }
    this.held.add(event.key);
    return true;
  }

  private step(now_ms: number): boolean {
    const time_s = Math.min(longestStep_s, Math.max(0, (now_ms - this.last_ms) / 1000));
    this.last_ms = now_ms;
    let [ahead, aside] = [0, 0];
    for (const key of this.held) {
      ahead += ways[key]?.[0] ?? 0;
      aside += ways[key]?.[1] ?? 0;
    }
    const length_m = speed_mps * (this.isFast ? fast : 1) * time_s;
    if (ahead !== 0 || aside !== 0) this.renderer.camera.walk(ahead * length_m, aside * length_m);
    return this.held.size > 0 && this.store.get("walks");
  }

  /** Where one looked at, on the floor there. */
  private begin(): void {
    const { camera } = this.renderer;
    this.before = camera.view;
    const hit = this.renderer.pick(new Vector2(0, 0));
    const at = hit?.point ?? this.renderer.bounds().getCenter(new Vector3());
    const z = floorOf_m(this.store.get("objects").values()) + eye_m;
    camera.flyTo({ position_m: { x: at.x, y: at.y, z }, yaw: camera.yaw, pitch: tiltDown }, false);
  }

  private end(): void {
    this.held.clear();
    if (this.before && this.store.get("map")) this.renderer.camera.flyTo(this.before, false);
    this.before = null;
  }
}
