// SPDX-License-Identifier: BSD-3-Clause
import {
  Box3,
  Color,
  GridHelper,
  Group,
  LineBasicMaterial,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
  type Object3D,
} from "three";
import type { Surface } from "../api/glb";
import type { AxisBox } from "../api/types";
import { Boxes } from "./boxes";
import { Camera } from "./camera";
import { Frames } from "./frames";
import { showLevels, showWhole } from "./levels";
import { ObjectMesh } from "./object_mesh";
import { Outline } from "./outline";
import { Pace, isWithoutGpu } from "./pace";
import { UnseenGround } from "./unseen";
import { inClipBox, setClipBox } from "./clip_box";
import { light } from "./surface_material";

export interface Hit {
  readonly id: string;
  readonly point: Vector3;
  readonly distance_m: number;
}

/** Without a GPU the whole picture takes longer than that: it waits until one has surely stopped. */
const rest_ms = 180;
const restWithoutGpu_ms = 400;

/** The canvas and all that is drawn on it. */
export class Renderer {
  readonly canvas: HTMLCanvasElement;
  readonly frames = new Frames((waited_ms) => this.draw(waited_ms));
  readonly camera: Camera;
  readonly boxes = new Boxes();
  readonly unseen = new UnseenGround();
  /** What tools show: not picked. */
  readonly tools = new Group();
  selected: ObjectMesh | null = null;
  hovered: ObjectMesh | null = null;
  private readonly objects = new Map<string, ObjectMesh>();
  private readonly scene = new Scene();
  private readonly surfaces = new Group();
  private readonly three: WebGLRenderer;
  private readonly outline = new Outline();
  private readonly grid = new GridHelper(60, 60);
  private readonly raycaster = new Raycaster();
  private readonly isWithoutGpu: boolean;
  private readonly pace: Pace;
  private numCalls = 0;
  private numDrawnTriangles = 0;
  private isMoving = false;
  private restTimer = 0;

  /** Throws an Error where there is no WebGL 2. */
  constructor(private readonly onCameraMoved: () => void) {
    this.three = new WebGLRenderer({ antialias: true, powerPreference: "high-performance" });
    this.canvas = this.three.domElement;
    this.isWithoutGpu = isWithoutGpu(this.three.getContext());
    this.pace = new Pace(this.isWithoutGpu);
    this.three.autoClear = false;
    this.three.localClippingEnabled = true; // of the outline
    this.camera = new Camera(this.frames, () => this.cameraMoved());
    this.raycaster.firstHitOnly = true;
    this.grid.rotation.x = Math.PI / 2;
    this.grid.position.z = -0.08;
    const lines = this.grid.material as LineBasicMaterial;
    lines.vertexColors = false;
    lines.transparent = true;
    lines.opacity = 0.5;
    this.scene.add(this.grid, this.unseen.mesh, this.surfaces, this.boxes.lines);
  }

  /** Nothing moves, and nothing is about to be drawn. */
  get isResting(): boolean {
    return !this.isMoving && this.frames.isIdle;
  }
  /** Of the scene, as it was last drawn. */
  get drawCalls(): number {
    return this.numCalls;
  }
  get drawnTriangles(): number {
    return this.numDrawnTriangles;
  }
  get geometries(): number {
    return this.three.info.memory.geometries;
  }
  get numTriangles(): number {
    return [...this.objects.values()].reduce((sum, object) => sum + object.numTriangles, 0);
  }
  get meshBytes(): number {
    return [...this.objects.values()].reduce((sum, object) => sum + object.bytes, 0);
  }
  meshOf(id: string | null): ObjectMesh | null {
    return id === null ? null : (this.objects.get(id) ?? null);
  }
  allMeshes(): Iterable<ObjectMesh> {
    return this.objects.values();
  }

  /** What hides and is hidden as surfaces are, but is not picked. */
  addToScene(part: Object3D): void {
    this.scene.add(part);
    this.frames.invalidate();
  }

  /** In place of what was there. An empty surface takes it away. */
  put(surface: Surface): ObjectMesh | null {
    this.drop(surface.id);
    if (surface.indices.length === 0) return null;
    const object = new ObjectMesh(surface, surface.id);
    this.objects.set(surface.id, object);
    this.surfaces.add(object.mesh);
    if (this.isWithoutGpu) this.moves(); // first coarse, then whole
    this.frames.invalidate();
    return object;
  }

  drop(id: string): void {
    const object = this.objects.get(id);
    if (!object) return;
    if (this.selected === object) this.selected = null;
    if (this.hovered === object) this.hovered = null;
    this.objects.delete(id);
    object.dispose();
    this.frames.invalidate();
  }

  clear(): void {
    for (const id of [...this.objects.keys()]) this.drop(id);
  }

  /** Red in place of blue: what is held would touch something. */
  setTouching(isTouching: boolean): void {
    this.outline.setSelectionColour(isTouching ? "#FF5A5F" : "#4C9AFF");
  }

  setColours(ground: string, line: string, hover: string, unseen: string, hatch: string): void {
    const colour = new Color(ground);
    this.three.setClearColor(colour, 1);
    light.ground.value.set(colour.r, colour.g, colour.b);
    (this.grid.material as LineBasicMaterial).color.set(line);
    this.outline.setHoverColour(hover);
    this.unseen.setColours(unseen, hatch);
    this.frames.invalidate();
  }

  resize(width: number, height: number, covered: number): void {
    this.size.set(Math.max(1, width), Math.max(1, height));
    this.three.setPixelRatio(this.pixelRatio);
    this.three.setSize(this.size.x, this.size.y);
    this.camera.resize(this.size.x, this.size.y, covered);
  }

  /** The first shown surface under a place of the canvas, -1 to 1. */
  pick(place: Vector2, isPicked: (id: string) => boolean = () => true): Hit | null {
    this.raycaster.setFromCamera(place, this.camera.three);
    const range = inClipBox(this.raycaster.ray);
    if (!range) return null;
    [this.raycaster.near, this.raycaster.far] = range;
    const meshes: Object3D[] = [];
    for (const object of this.objects.values()) {
      if (object.mesh.visible && isPicked(object.id)) meshes.push(object.mesh);
    }
    const hit = this.raycaster.intersectObjects(meshes, false)[0];
    return hit ? { id: hit.object.name, point: hit.point, distance_m: hit.distance } : null;
  }

  /** Surfaces beyond it are neither drawn nor picked; null: all are. */
  setClip(box: AxisBox | null): void {
    this.outline.setClip(setClipBox(box));
    this.frames.invalidate();
  }

  /** Around all that is shown, in the map frame. */
  bounds(): Box3 {
    const box = new Box3();
    for (const object of this.objects.values()) {
      if (!object.mesh.visible) continue;
      object.mesh.updateMatrixWorld(true);
      const sphere = object.mesh.geometry.boundingSphere!.clone().applyMatrix4(object.mesh.matrixWorld);
      const half = new Vector3(1, 1, 1).multiplyScalar(sphere.radius / Math.sqrt(3));
      box.union(new Box3(sphere.center.clone().sub(half), sphere.center.clone().add(half)));
    }
    return box;
  }

  private readonly size = new Vector2(1, 1);
  private get pixelRatio(): number {
    return Math.min(2, devicePixelRatio) * (this.isMoving ? this.pace.detail.pixelShare : 1);
  }

  private cameraMoved(): void {
    this.onCameraMoved();
    this.moves();
  }

  /** Coarser from here on where that is needed, until nothing has moved for a while. */
  moves(): void {
    if (!this.isMoving) {
      this.isMoving = true;
      this.fitPixels();
    }
    this.waitForRest();
  }

  /** From the last movement on, and from the last frame of it on: slow frames are no rest. */
  private waitForRest(): void {
    clearTimeout(this.restTimer);
    this.restTimer = window.setTimeout(() => this.rests(), this.isWithoutGpu ? restWithoutGpu_ms : rest_ms);
  }

  private rests(): void {
    if (!this.frames.isIdle) return this.waitForRest();
    this.isMoving = false;
    this.pace.rests();
    this.fitPixels();
    this.frames.invalidate();
  }

  /** All of what is shown, drawn at once: to be read before the page goes on. */
  snapshot(): HTMLCanvasElement {
    const wasMoving = this.isMoving;
    this.isMoving = false;
    this.fitPixels();
    this.draw(0);
    this.isMoving = wasMoving;
    return this.canvas;
  }

  private fitPixels(): void {
    if (this.three.getPixelRatio() !== this.pixelRatio) this.three.setPixelRatio(this.pixelRatio);
  }

  private draw(waited_ms: number): void {
    if (this.isMoving && this.pace.drew(waited_ms)) this.fitPixels();
    const mostTriangles = this.isMoving ? this.pace.detail.mostTriangles : Infinity;
    showLevels(this.objects.values(), this.camera.three, this.size.y * this.three.getPixelRatio(), mostTriangles);
    this.three.clear();
    this.three.render(this.scene, this.camera.three);
    this.numCalls = this.three.info.render.calls;
    this.numDrawnTriangles = this.three.info.render.triangles;
    this.outline.draw(this.three, this.camera.three, this.selected, this.hovered);
    if (this.tools.children.length > 0) {
      this.three.clearDepth();
      this.three.render(this.tools, this.camera.three);
    }
    showWhole(this.objects.values());
    if (this.isMoving) this.waitForRest();
  }
}
