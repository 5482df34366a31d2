// SPDX-License-Identifier: BSD-3-Clause
import { FrontSide, ShaderMaterial, Vector3 } from "three";

/** The same light for all, in the map frame: mostly from above, a little from one side. Shared by reference. */
export const light = { ground: { value: new Vector3(0.006, 0.007, 0.009) } };
/** What is beyond, in the map frame, is not drawn. Shared by reference. */
export const clipping = { min: { value: new Vector3(-1e9, -1e9, -1e9) }, max: { value: new Vector3(1e9, 1e9, 1e9) } };

const vertex = /* glsl */ `
  attribute vec3 color;
  uniform vec3 flatColor;
  uniform float flatShare;
  varying vec3 vColor;
  varying vec3 vAt;
  void main() {
    vec3 n = normalize(mat3(modelMatrix) * normal);
    vAt = (modelMatrix * vec4(position, 1.0)).xyz;
    vec3 toCamera = normalize(cameraPosition - vAt);
    float sky = 0.5 + 0.5 * n.z;
    float key = max(dot(n, normalize(vec3(0.35, -0.5, 0.79))), 0.0);
    float facing = abs(dot(n, toCamera));
    // What the sensor saw has its own light in it.
    float shade = mix(0.80 + 0.14 * sky + 0.16 * key, 0.34 + 0.30 * sky + 0.42 * key, flatShare);
    shade *= mix(0.86, 1.0, smoothstep(0.0, 0.55, facing));
    vColor = mix(color, flatColor, flatShare) * shade;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;

const fragment = /* glsl */ `
  uniform float ghost;
  uniform vec3 ground;
  uniform vec3 clipMin;
  uniform vec3 clipMax;
  varying vec3 vColor;
  varying vec3 vAt;
  void main() {
    if (any(lessThan(vAt, clipMin)) || any(greaterThan(vAt, clipMax))) discard;
    float grey = dot(vColor, vec3(0.2126, 0.7152, 0.0722));
    vec3 shown = mix(vColor, mix(vec3(grey), ground, 0.86), ghost);
    gl_FragColor = vec4(shown, 1.0);
    #include <colorspace_fragment>
  }`;

export function newSurfaceMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: {
      flatColor: { value: new Vector3() },
      flatShare: { value: 0 },
      ghost: { value: 0 },
      ground: light.ground,
      clipMin: clipping.min,
      clipMax: clipping.max,
    },
    vertexShader: vertex,
    fragmentShader: fragment,
    side: FrontSide,
  });
}
