// SPDX-License-Identifier: BSD-3-Clause
import {
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  Group,
  Line,
  LineBasicMaterial,
  Mesh,
  MeshBasicMaterial,
  SphereGeometry,
  Sprite,
  SpriteMaterial,
  Vector3,
} from "three";

export const markColours = { plain: "#E6E9EF", amber: "#F2B84B" } as const;
export type MarkColour = keyof typeof markColours;

const text_px = 26;
const onScreen = 0.036; // height of a text, of the height of the picture

/** Points, lines between them and texts that tools show: in front of all, about as large wherever they are. */
export class Marks {
  readonly group = new Group();

  clear(): void {
    for (const part of [...this.group.children]) {
      part.removeFromParent();
      const { geometry, material } = part as Mesh<BufferGeometry, MeshBasicMaterial>;
      if (!(part instanceof Sprite)) geometry.dispose();
      material.map?.dispose();
      material.dispose();
    }
  }

  /** `eye`: where it is seen from. */
  point(at: Vector3, colour: MarkColour, eye: Vector3): void {
    const material = new MeshBasicMaterial({ color: markColours[colour], depthTest: false });
    const ball = new Mesh(new SphereGeometry(1, 16, 12), material);
    ball.position.copy(at);
    ball.scale.setScalar(Math.max(0.012, 0.006 * at.distanceTo(eye)));
    this.group.add(ball);
  }

  line(from: Vector3, to: Vector3, colour: MarkColour): void {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array([...from.toArray(), ...to.toArray()]), 3));
    const line = new Line(geometry, new LineBasicMaterial({ color: markColours[colour], depthTest: false }));
    line.frustumCulled = false;
    this.group.add(line);
  }

  text(at: Vector3, text: string): void {
    const canvas = document.createElement("canvas");
    const pen = canvas.getContext("2d");
    if (!pen) return;
    const font = `600 ${text_px}px system-ui, sans-serif`;
    pen.font = font;
    canvas.width = Math.ceil(pen.measureText(text).width) + 24;
    canvas.height = text_px + 16;
    pen.fillStyle = "#171A21";
    pen.roundRect(0, 0, canvas.width, canvas.height, 8);
    pen.fill();
    pen.font = font;
    pen.fillStyle = markColours.plain;
    pen.textBaseline = "middle";
    pen.fillText(text, 12, canvas.height / 2 + 1);
    const material = new SpriteMaterial({ map: new CanvasTexture(canvas), depthTest: false, sizeAttenuation: false });
    const sprite = new Sprite(material);
    sprite.scale.set((onScreen * canvas.width) / canvas.height, onScreen, 1);
    sprite.center.set(0.5, -0.2);
    sprite.position.copy(at);
    sprite.renderOrder = 1;
    this.group.add(sprite);
  }
}
