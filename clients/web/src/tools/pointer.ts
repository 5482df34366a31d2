// SPDX-License-Identifier: BSD-3-Clause
// Mouse, pen and touch on the canvas: look around, point, select, drag.
import { Plane, Vector2, Vector3 } from "three";
import type { Hit, Renderer } from "../scene/renderer";
import type { ViewStore } from "../state/view";
import type { DraftTool } from "./draft";
import type { MoveTool } from "./move";
import type { PlaceTools } from "./place_tool";

const click_px = 4;
/** Wheels send many events for one turn of the hand: they share what is under the cursor. */
const sameAnchor_ms = 250;
const farAway_m = 8;

type Gesture = "orbit" | "pan" | "move" | "none";

export class Pointer {
  private readonly pointers = new Map<number, Vector2>();
  private gesture: Gesture = "none";
  private start = new Vector2();
  private anchor = new Vector3();
  private hit: Hit | null = null;
  private hasMoved = false;
  private wheelAnchor: { point: Vector3; at_ms: number } | null = null;
  private hoverAsked = false;
  private hoverAt = new Vector2();

  constructor(
    private readonly store: ViewStore,
    private readonly renderer: Renderer,
    private readonly moveTool: MoveTool,
    private readonly placeTools: PlaceTools,
    private readonly draftTool: DraftTool,
    private readonly label: HTMLElement,
    private readonly focusOn: (id: string) => void,
  ) {
    const { canvas } = renderer;
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.moved(event));
    canvas.addEventListener("pointerup", (event) => this.up(event));
    canvas.addEventListener("pointercancel", (event) => this.cancelled(event));
    canvas.addEventListener("pointerleave", () => this.unhover());
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("dblclick", () => {
      if (this.hit) this.focusOn(this.hit.id);
    });
  }

  /** What is under the cursor, else the floor there, else a place some way off. */
  private anchorAt(place: Vector2, hit: Hit | null): Vector3 {
    if (hit) return hit.point.clone();
    return this.floorAt(place) ?? this.renderer.camera.rayAt(place).at(farAway_m, new Vector3());
  }

  private floorAt(place: Vector2): Vector3 | null {
    const ray = this.renderer.camera.rayAt(place);
    const floor = ray.intersectPlane(new Plane(new Vector3(0, 0, 1), 0), new Vector3());
    return floor && floor.distanceTo(ray.origin) < 40 ? floor : null;
  }

  private placeOf(event: MouseEvent): Vector2 {
    const box = this.renderer.canvas.getBoundingClientRect();
    return new Vector2(
      ((event.clientX - box.left) / box.width) * 2 - 1,
      1 - ((event.clientY - box.top) / box.height) * 2,
    );
  }

  private down(event: PointerEvent): void {
    this.renderer.canvas.setPointerCapture(event.pointerId);
    this.renderer.canvas.focus({ preventScroll: true });
    this.pointers.set(event.pointerId, new Vector2(event.clientX, event.clientY));
    const place = this.placeOf(event);
    if (this.pointers.size > 1) {
      this.moveTool.cancel();
      this.gesture = "pan";
      this.hasMoved = true;
      return;
    }
    this.hit = this.renderer.pick(place);
    this.anchor = this.anchorAt(place, this.hit);
    this.start.set(event.clientX, event.clientY);
    this.hasMoved = false;
    const isPan = event.button !== 0 || event.shiftKey || event.ctrlKey || event.metaKey;
    const grip = isPan ? null : this.moveTool.gripAt(this.renderer.camera.rayAt(place), this.hit);
    this.gesture = isPan ? "pan" : grip ? "move" : "orbit";
  }

  private moved(event: PointerEvent): void {
    const before = this.pointers.get(event.pointerId);
    if (!before) return this.hover(event);
    const now = new Vector2(event.clientX, event.clientY);
    if (!this.hasMoved && now.distanceTo(this.start) < click_px) return;
    if (!this.hasMoved) this.begin();
    this.pointers.set(event.pointerId, now);
    if (this.pointers.size > 1) return this.pinch(event.pointerId, before, now);
    const { camera } = this.renderer;
    if (this.gesture === "orbit" && this.store.get("walks")) camera.look(now.x - before.x, now.y - before.y);
    else if (this.gesture === "orbit") camera.orbit(this.anchor, now.x - before.x, now.y - before.y);
    if (this.gesture === "pan") camera.pan(this.anchor, this.placeAt(before), this.placeAt(now));
    if (this.gesture === "move") this.moveTool.drags(camera.rayAt(this.placeAt(now)), event.shiftKey);
  }

  private begin(): void {
    this.hasMoved = true;
    this.unhover();
    if (this.gesture === "move") this.moveTool.begin(this.renderer.camera.rayAt(this.placeAt(this.start)), this.hit);
    this.renderer.canvas.dataset["grab"] = this.gesture;
  }

  private placeAt(client: Vector2): Vector2 {
    return this.placeOf({ clientX: client.x, clientY: client.y } as MouseEvent);
  }

  /** Two fingers: drag and zoom. */
  private pinch(id: number, before: Vector2, now: Vector2): void {
    const other = [...this.pointers.entries()].find(([each]) => each !== id)?.[1];
    if (!other) return;
    const middle = (a: Vector2) => this.placeAt(a.clone().add(other).multiplyScalar(0.5));
    this.renderer.camera.pan(this.anchor, middle(before), middle(now));
    const ratio = before.distanceTo(other) / Math.max(1, now.distanceTo(other));
    this.renderer.camera.zoom(this.anchor, Math.log(ratio) / Math.log(1.0015));
  }

  private up(event: PointerEvent): void {
    if (!this.pointers.delete(event.pointerId)) return;
    delete this.renderer.canvas.dataset["grab"];
    if (this.pointers.size > 0) return;
    if (this.gesture === "move" && this.hasMoved) void this.moveTool.end();
    if (!this.hasMoved && event.button === 0) this.click();
    this.gesture = "none";
  }

  private cancelled(event: PointerEvent): void {
    this.pointers.delete(event.pointerId);
    this.moveTool.cancel();
    this.gesture = "none";
  }

  private click(): void {
    const tool = this.store.get("tool");
    if (tool !== "select") return this.placeTools[tool].click(this.hit, this.floorAt(this.placeAt(this.start)));
    if (this.store.get("draft")?.is === "merge" && this.hit) return this.draftTool.choose(this.hit.id);
    const at = this.hit?.point;
    this.store.set("clicked", at && this.hit ? { id: this.hit.id, point_m: { x: at.x, y: at.y, z: at.z } } : null);
    this.store.set("selected", this.hit?.id ?? null);
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const now_ms = performance.now();
    if (!this.wheelAnchor || now_ms - this.wheelAnchor.at_ms > sameAnchor_ms) {
      const place = this.placeOf(event);
      this.wheelAnchor = { point: this.anchorAt(place, this.renderer.pick(place)), at_ms: now_ms };
    }
    this.wheelAnchor.at_ms = now_ms;
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 : 1;
    const pinch = event.ctrlKey ? 4 : 1;
    this.renderer.camera.zoom(this.wheelAnchor.point, Math.max(-400, Math.min(400, event.deltaY * lines * pinch)));
    this.unhover();
  }

  /** Once a frame at most, whatever the mouse sends. */
  private hover(event: PointerEvent): void {
    if (event.pointerType === "touch") return;
    this.hoverAt.set(event.clientX, event.clientY);
    if (this.hoverAsked) return;
    this.hoverAsked = true;
    requestAnimationFrame(() => {
      this.hoverAsked = false;
      if (this.pointers.size > 0) return;
      const place = this.placeAt(this.hoverAt);
      const hit = this.renderer.pick(place);
      this.store.set("hovered", hit?.id ?? null);
      const tool = this.store.get("tool");
      if (tool !== "select") this.placeTools[tool].hover?.(hit, this.floorAt(place));
      const grip = this.moveTool.gripAt(this.renderer.camera.rayAt(place), hit);
      this.renderer.canvas.dataset["over"] =
        tool !== "select" ? "probe" : (grip ?? (hit ? "object" : ""));
      this.label.style.transform = `translate(${this.hoverAt.x + 14}px, ${this.hoverAt.y + 16}px)`;
    });
  }

  private unhover(): void {
    this.store.set("hovered", null);
  }
}
