// SPDX-License-Identifier: BSD-3-Clause
// A camera with z up that turns about, goes to and drags what is under the cursor.
import { MathUtils, PerspectiveCamera, Quaternion, Ray, Vector2, Vector3 } from "three";
import type { CameraView } from "../state/view";
import type { Frames } from "./frames";

const up = new Vector3(0, 0, 1);
const mostPitch = MathUtils.degToRad(89.9);
const flight_ms = 350;
const turn_perPixel = 0.0055;

/** The direction of a turn about the vertical and a tilt; 0, 0 looks along x. */
function directionOf(yaw: number, pitch: number): Vector3 {
  return new Vector3(Math.cos(pitch) * Math.cos(yaw), Math.cos(pitch) * Math.sin(yaw), Math.sin(pitch));
}

export class Camera {
  readonly three = new PerspectiveCamera(50, 1, 0.05, 400);
  yaw = 0;
  pitch = 0;
  /** How much of the right a panel hides from what is gone to. In pixels. */
  covered_px = 0;
  private height_px = 1;
  private flight: ((now_ms: number) => boolean) | null = null;

  /** `onMoved` is called after each change. */
  constructor(
    private readonly frames: Frames,
    private readonly onMoved: () => void,
  ) {
    this.apply();
  }

  get view(): CameraView {
    const { x, y, z } = this.three.position;
    return { position_m: { x, y, z }, yaw: this.yaw, pitch: this.pitch };
  }

  setView(view: CameraView): void {
    this.three.position.set(view.position_m.x, view.position_m.y, view.position_m.z);
    this.yaw = view.yaw;
    this.pitch = MathUtils.clamp(view.pitch, -mostPitch, mostPitch);
    this.apply();
  }

  /** `covered`: how much of the left a panel hides; the middle of the view is that of the rest. In pixels. */
  resize(width: number, height: number, covered: number): void {
    this.height_px = Math.max(1, height);
    this.three.aspect = width / this.height_px;
    this.three.setViewOffset(width, height, -covered / 2, 0, width, height);
    this.three.updateProjectionMatrix();
    this.frames.invalidate();
  }

  /** From the eye through a place of the canvas, -1 to 1. */
  rayAt(place: Vector2): Ray {
    const origin = this.three.position.clone();
    return new Ray(origin, new Vector3(place.x, place.y, 0.5).unproject(this.three).sub(origin).normalize());
  }

  /** Turns about `pivot`, which stays where it is on the screen. In pixels. */
  orbit(pivot: Vector3, dx: number, dy: number): void {
    this.stopFlight();
    const before = directionOf(this.yaw, this.pitch);
    const right = new Vector3().crossVectors(before, up).normalize();
    const pitch = MathUtils.clamp(this.pitch - dy * turn_perPixel, -mostPitch, mostPitch);
    const tilt = new Quaternion().setFromAxisAngle(right, pitch - this.pitch);
    const turn = new Quaternion().setFromAxisAngle(up, -dx * turn_perPixel);
    const arm = this.three.position.clone().sub(pivot).applyQuaternion(tilt).applyQuaternion(turn);
    this.three.position.copy(pivot).add(arm);
    this.yaw -= dx * turn_perPixel;
    this.pitch = pitch;
    this.apply();
  }

  /** Turns on the spot, so that what is under the cursor goes along with it. In pixels. */
  look(dx: number, dy: number): void {
    this.stopFlight();
    const perPixel = (2 * Math.tan(MathUtils.degToRad(this.three.fov / 2))) / this.height_px;
    this.yaw += dx * perPixel;
    this.pitch = MathUtils.clamp(this.pitch + dy * perPixel, -mostPitch, mostPitch);
    this.apply();
  }

  /** Over the floor: ahead, and to the right. */
  walk(ahead_m: number, right_m: number): void {
    this.stopFlight();
    const [sin, cos] = [Math.sin(this.yaw), Math.cos(this.yaw)];
    this.three.position.x += ahead_m * cos + right_m * sin;
    this.three.position.y += ahead_m * sin - right_m * cos;
    this.apply();
  }

  /** Moves so that what was under `from` at the distance of `anchor` is under `to`. */
  pan(anchor: Vector3, from: Vector2, to: Vector2): void {
    this.stopFlight();
    const depth = anchor.clone().sub(this.three.position).dot(directionOf(this.yaw, this.pitch));
    const at = (place: Vector2) => {
      const ray = this.rayAt(place);
      return ray.at(Math.max(0.2, depth) / ray.direction.dot(directionOf(this.yaw, this.pitch)), new Vector3());
    };
    this.three.position.add(at(from).sub(at(to)));
    this.apply();
  }

  /** Goes towards `anchor`, or away from it, by a share of the distance; never through it. */
  zoom(anchor: Vector3, steps: number): void {
    this.stopFlight();
    const arm = this.three.position.clone().sub(anchor);
    const length = MathUtils.clamp(arm.length() * 1.0015 ** steps, 0.15, 150);
    this.three.position.copy(anchor).add(arm.setLength(length));
    this.apply();
  }

  /** A ball in the middle of what is free of panels, seen from where one looks now or from `yaw` and `pitch`. */
  frame(center: Vector3, radius_m: number, angles: { yaw: number; pitch: number } | null, isAtOnce: boolean): void {
    const { yaw, pitch } = angles ?? this;
    const halfAngle = MathUtils.degToRad(this.three.fov / 2);
    const narrow = Math.min(halfAngle, Math.atan(Math.tan(halfAngle) * this.three.aspect));
    const distance = Math.max(radius_m, 0.15) / Math.sin(narrow);
    const ahead = directionOf(yaw, pitch);
    const right = new Vector3(Math.sin(yaw), -Math.cos(yaw), 0);
    const aside = ((this.covered_px / 2) * 2 * distance * Math.tan(halfAngle)) / this.height_px;
    const position = center.clone().addScaledVector(ahead, -distance).addScaledVector(right, aside);
    this.flyTo({ position_m: position, yaw, pitch }, isAtOnce);
  }

  flyTo(target: CameraView, isAtOnce: boolean): void {
    this.stopFlight();
    if (isAtOnce || matchMedia("(prefers-reduced-motion: reduce)").matches) return this.setView(target);
    const from = this.view;
    const start_ms = performance.now();
    const turn = MathUtils.euclideanModulo(target.yaw - from.yaw + Math.PI, 2 * Math.PI) - Math.PI;
    this.flight = (now_ms) => {
      const share = MathUtils.clamp((now_ms - start_ms) / flight_ms, 0, 1);
      const eased = 1 - (1 - share) ** 3;
      const mix = (a: number, b: number) => a + (b - a) * eased;
      this.setView({
        position_m: {
          x: mix(from.position_m.x, target.position_m.x),
          y: mix(from.position_m.y, target.position_m.y),
          z: mix(from.position_m.z, target.position_m.z),
        },
        yaw: from.yaw + turn * eased,
        pitch: mix(from.pitch, target.pitch),
      });
      return share < 1;
    };
    this.frames.animate(this.flight);
  }

  private stopFlight(): void {
    if (this.flight) this.frames.stop(this.flight);
    this.flight = null;
  }

  private apply(): void {
    const ahead = directionOf(this.yaw, this.pitch);
    this.three.up.copy(up);
    this.three.lookAt(this.three.position.clone().add(ahead));
    this.three.updateMatrixWorld();
    this.onMoved();
    this.frames.invalidate();
  }
}
