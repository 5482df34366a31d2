// SPDX-License-Identifier: BSD-3-Clause
// Writes mcap/*.mcap, from which test_mcap.py reads: frames of the simulator as messages of ROS 2, by other people's
// writers. Their packages are needed here only; the tests need no node.
//
//   dhpmap-simulate /tmp/rec --frames 60 --width 64 --height 48 --no-noise
//   npm install --no-save --prefix /tmp/npm @mcap/core@2.2.2 @foxglove/rosmsg@5.0.5 \
//     @foxglove/rosmsg2-serialization@3.1.0 @foxglove/wasm-zstd@1.0.1 lz4js@0.2.0 pngjs@7.0.0
//   cp make_mcap.mjs /tmp/npm && node /tmp/npm/make_mcap.mjs /tmp/rec tests/unit/clients/python/mcap
//
// walk.mcap: depth 16UC1, colour, labels with a table of detections, camera, transforms; not packed, with an index.
// packed.mcap: the same frames as files of PNG, labels as class * 1000 + number; chunks by lz4 and zstd in turns.
// scan.mcap: points in a cloud, with colour and labels, and a LabelInfo; neither chunks nor an index.
// truth.json: stamps, poses and checksums of what the recordings hold.
import { readFileSync, writeFileSync } from "node:fs";
import { crc32 } from "@foxglove/crc";
import { parse } from "@foxglove/rosmsg";
import { MessageWriter } from "@foxglove/rosmsg2-serialization";
import zstd from "@foxglove/wasm-zstd";
import { McapWriter } from "@mcap/core";
import lz4 from "lz4js";
import png from "pngjs";

const [recording, out] = process.argv.slice(2);
const FRAMES = [0, 1, 2, 3, 4, 5];

// ---- types, as far as they are needed; comments and constants of the originals left out
const HEADER = ["std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id"];
const TIME = ["builtin_interfaces/Time", "int32 sec\nuint32 nanosec"];
const VECTOR = ["geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z"];
const POINT = ["geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z"];
const QUATERNION = ["geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w"];
const TYPES = {
  "sensor_msgs/msg/Image": ["std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\n" +
    "uint8 is_bigendian\nuint32 step\nuint8[] data", HEADER, TIME],
  "sensor_msgs/msg/CompressedImage": ["std_msgs/Header header\nstring format\nuint8[] data", HEADER, TIME],
  "sensor_msgs/msg/CameraInfo": ["std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\n" +
    "float64[] d\nfloat64[9] k\nfloat64[9] r\nfloat64[12] p\nuint32 binning_x\nuint32 binning_y\n" +
    "sensor_msgs/RegionOfInterest roi", HEADER, TIME, ["sensor_msgs/RegionOfInterest",
    "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify"]],
  "sensor_msgs/msg/PointCloud2": ["std_msgs/Header header\nuint32 height\nuint32 width\n" +
    "sensor_msgs/PointField[] fields\nbool is_bigendian\nuint32 point_step\nuint32 row_step\n" +
    "uint8[] data\nbool is_dense", HEADER, TIME, ["sensor_msgs/PointField", "string name\nuint32 offset\nuint8 datatype\nuint32 count"]],
  "tf2_msgs/msg/TFMessage": ["geometry_msgs/TransformStamped[] transforms", HEADER, TIME, VECTOR, QUATERNION,
    ["geometry_msgs/TransformStamped", "std_msgs/Header header\nstring child_frame_id\n" +
      "geometry_msgs/Transform transform"],
    ["geometry_msgs/Transform", "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation"]],
  "vision_msgs/msg/LabelInfo": ["std_msgs/Header header\nvision_msgs/VisionClass[] class_map\nfloat32 threshold",
    HEADER, TIME, ["vision_msgs/VisionClass", "uint16 class_id\nstring class_name"]],
  "vision_msgs/msg/Detection2DArray": ["std_msgs/Header header\nvision_msgs/Detection2D[] detections", HEADER, TIME,
    ["vision_msgs/Detection2D", "std_msgs/Header header\nvision_msgs/ObjectHypothesisWithPose[] results\n" +
      "vision_msgs/BoundingBox2D bbox\nstring id"],
    ["vision_msgs/ObjectHypothesisWithPose", "vision_msgs/ObjectHypothesis hypothesis\n" +
      "geometry_msgs/PoseWithCovariance pose"],
    ["vision_msgs/ObjectHypothesis", "string class_id\nfloat64 score"],
    ["geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose pose\nfloat64[36] covariance"],
    ["geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation"], POINT, QUATERNION,
    ["vision_msgs/BoundingBox2D", "vision_msgs/Pose2D center\nfloat64 size_x\nfloat64 size_y"],
    ["vision_msgs/Pose2D", "vision_msgs/Point2D position\nfloat64 theta"],
    ["vision_msgs/Point2D", "float64 x\nfloat64 y"]],
};

// ---- the simulator's files
function readTiff(path) {
  const file = readFileSync(path), tags = {}, at = file.readUInt32LE(4);
  for (let i = 0; i < file.readUInt16LE(at); i++) {
    const entry = at + 2 + 12 * i, kind = file.readUInt16LE(entry + 2), count = file.readUInt32LE(entry + 4);
    const size = kind === 3 ? 2 : 4, first = count * size <= 4 ? entry + 8 : file.readUInt32LE(entry + 8);
    if (kind === 3 || kind === 4)
      tags[file.readUInt16LE(entry)] = Array.from({ length: count }, (_, k) => file.readUIntLE(first + k * size, size));
  }
  const strips = tags[273].map((offset, k) => file.subarray(offset, offset + tags[279][k]));
  const data = Buffer.concat(strips);
  return Float32Array.from({ length: data.length / 4 }, (_, k) => data.readFloatLE(4 * k));
}

const readRows = (path) => readFileSync(path, "utf8").trim().split("\n").filter((line) => !line.startsWith("#"))
  .map((line) => line.split(/[,\s]+/));
const classes = Object.fromEntries(readRows(`${recording}/groundtruth_labels.csv`).slice(1)
  .filter((row) => row[6] !== "unknown")
  .map((row) => [Number(row[0]), { id: Number(row[1]), name: row.slice(6, -1).join(" ").replace(/_\d+$/, "") }]));
const [width, height, fx, fy, cx, cy] = readRows(`${recording}/camera.txt`)[0].map(Number);
const stamps = Object.fromEntries(readRows(`${recording}/run1/timestamps.csv`).slice(1)
  .map(([name, ns]) => [name, BigInt(ns)]));

function readFrame(index) {
  const name = String(index).padStart(6, "0"), path = `${recording}/run1/${name}`;
  const rgba = png.PNG.sync.read(readFileSync(`${path}_color.png`)).data;
  const grey = png.PNG.sync.read(readFileSync(`${path}_segmentation.png`), { skipRescale: true }).data;
  return {
    stamp: stamps[name],
    depthMm: Uint16Array.from(readTiff(`${path}_depth.tiff`), (metres) => Math.round(1000 * metres)),
    rgb: Uint8Array.from({ length: 3 * width * height }, (_, k) => rgba[4 * Math.floor(k / 3) + (k % 3)]),
    labels: Uint16Array.from({ length: width * height }, (_, k) => grey[4 * k]),
    pose: readFileSync(`${path}_pose.txt`, "utf8").trim().split(/\s+/).map(Number),
  };
}

// ---- 4 x 4 matrices by rows, and quaternions x y z w
const product = (a, b) => Array.from({ length: 16 }, (_, k) => {
  const row = 4 * Math.floor(k / 4), column = k % 4;
  return [0, 1, 2, 3].reduce((sum, i) => sum + a[row + i] * b[4 * i + column], 0);
});
function inverse(a) {
  const at = (row, column) => a[4 * row + column], out = Array(16).fill(0);
  for (let i = 0; i < 3; i++) {
    for (let j = 0; j < 3; j++) out[4 * i + j] = at(j, i);
    out[4 * i + 3] = -(at(0, i) * at(0, 3) + at(1, i) * at(1, 3) + at(2, i) * at(2, 3));
  }
  out[15] = 1;
  return out;
}
function turn(axis, angle, [x, y, z] = [0, 0, 0]) {  // about a unit axis, and a shift
  const [a, b, c] = axis, s = Math.sin(angle), k = 1 - Math.cos(angle), d = Math.cos(angle);
  return [d + a * a * k, a * b * k - c * s, a * c * k + b * s, x,
    a * b * k + c * s, d + b * b * k, b * c * k - a * s, y,
    a * c * k - b * s, b * c * k + a * s, d + c * c * k, z, 0, 0, 0, 1];
}
function quaternion(a) {
  const candidates = [a[0] - a[5] - a[10], a[5] - a[0] - a[10], a[10] - a[0] - a[5], a[0] + a[5] + a[10]]
    .map((t) => 1 + t);
  const best = candidates.indexOf(Math.max(...candidates)), s = 2 * Math.sqrt(candidates[best]);
  const sums = { xy: a[1] + a[4], xz: a[2] + a[8], yz: a[6] + a[9],
    wx: a[9] - a[6], wy: a[2] - a[8], wz: a[4] - a[1] };
  const pairs = ["xyzw", "xyzw", "xyzw", "xyzw"].map((_, k) => {
    if (k === best) return s / 4;
    const [p, q] = ["x", "y", "z", "w"].filter((_, i) => i === k || i === best);
    return (sums[p + q] ?? sums[q + p]) / s;
  });
  return { x: pairs[0], y: pairs[1], z: pairs[2], w: pairs[3] };
}

// ---- writing
class Recorder {
  constructor(options) {
    this.parts = [];
    this.size = 0n;
    const writable = { write: async (data) => { this.parts.push(Buffer.from(data)); this.size += BigInt(data.length); },
      position: () => this.size };
    this.writer = new McapWriter({ writable, ...options });
    this.channels = {};
  }
  async add(topic, type, stamp, message) {
    if (!(topic in this.channels)) {
      const [own, ...others] = TYPES[type];
      const text = [own, ...others.map(([name, fields]) => `${"=".repeat(80)}\nMSG: ${name}\n${fields}`)].join("\n");
      const schemaId = await this.writer.registerSchema({ name: type, encoding: "ros2msg", data: Buffer.from(text) });
      const id = await this.writer.registerChannel({ topic, schemaId, messageEncoding: "cdr", metadata: new Map() });
      this.channels[topic] = { id, cdr: new MessageWriter(parse(text, { ros2: true })), sequence: 0 };
    }
    const channel = this.channels[topic];
    await this.writer.addMessage({ channelId: channel.id, sequence: channel.sequence++, publishTime: stamp,
      logTime: stamp + 1_000_000n, data: channel.cdr.writeMessage(message) });
  }
  async close(path) {
    await this.writer.end();
    writeFileSync(path, Buffer.concat(this.parts));
  }
}

const time = (stamp) => ({ sec: Number(stamp / 1_000_000_000n), nanosec: Number(stamp % 1_000_000_000n) });
const header = (stamp, frame_id) => ({ stamp: time(stamp), frame_id });
const octets = (array) => new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
const image = (stamp, encoding, pixels) => ({ header: header(stamp, "camera"), height, width, encoding, is_bigendian: 0,
  step: octets(pixels).length / height, data: octets(pixels) });
const packed = (stamp, format, data) => ({ header: header(stamp, "camera"), format, data });
const transform = (stamp, parent, child, pose) => ({ header: header(stamp, parent), child_frame_id: child,
  transform: { translation: { x: pose[3], y: pose[7], z: pose[11] }, rotation: quaternion(pose) } });
const camera = (stamp) => ({ header: header(stamp, "camera"), height, width, distortion_model: "plumb_bob",
  d: [0, 0, 0, 0, 0], k: [fx, 0, cx, 0, fy, cy, 0, 0, 1], r: [1, 0, 0, 0, 1, 0, 0, 0, 1],
  p: [fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0], binning_x: 0, binning_y: 0,
  roi: { x_offset: 0, y_offset: 0, height: 0, width: 0, do_rectify: false } });

// map <- odom <- base <- camera; odom and the camera's place on the robot stand still
const mapOdom = turn([0, 0, 1], 0.4, [1.5, -0.5, 0]);
const baseCamera = product(turn([0, 0, 1], -Math.PI / 2, [0.1, 0, 1.2]), turn([1, 0, 0], -Math.PI / 2));
const TF = "tf2_msgs/msg/TFMessage";

async function addStatic(recorder, stamp) {
  await recorder.add("/tf_static", TF, stamp, { transforms: [transform(stamp, "map", "odom", mapOdom),
    transform(stamp, "base", "camera", baseCamera)] });
}
/** Before and after the frame, so that half way between is where the frame was. */
async function addMoving(recorder, frame, side) {
  const pose = product(product(inverse(mapOdom), frame.pose), inverse(baseCamera));
  const moved = product(pose, turn([0, 0, 1], 0.02 * side));
  const [x, y, z] = [0.03, -0.02, 0.01].map((metres) => metres * side);
  moved[3] += x, moved[7] += y, moved[11] += z;
  const stamp = frame.stamp + BigInt(20_000_000 * side);
  await recorder.add("/tf", TF, stamp, { transforms: [transform(stamp, "odom", "base", moved)] });
}
const detections = (frame) => ({ header: header(frame.stamp, "camera"),
  detections: [...new Set(frame.labels)].filter((id) => id in classes).map((id, k) => ({
    header: header(frame.stamp, "camera"), id: String(id),
    results: [["lamp of another kind", 0.05], [classes[id].name, 0.9]].slice(k ? 1 : 0).map(([class_id, score]) => ({
      hypothesis: { class_id, score }, pose: { pose: { position: { x: 0, y: 0, z: 0 },
        orientation: { x: 0, y: 0, z: 0, w: 1 } }, covariance: Array(36).fill(0) } })),
    bbox: { center: { position: { x: 0, y: 0 }, theta: 0 }, size_x: 0, size_y: 0 } })) });
const labelInfo = (stamp) => ({ header: header(stamp, ""), threshold: 0.5, class_map: [
  { class_id: 0, class_name: "unlabeled" },
  ...Object.entries(Object.fromEntries(Object.values(classes).map(({ id, name }) => [id, name])))
    .map(([id, name]) => ({ class_id: Number(id), class_name: name }))] });
function pngOf(pixels, colorType, bitDepth) {
  const kind = { width, height, colorType, inputColorType: colorType, bitDepth, inputHasAlpha: false };
  const picture = new png.PNG(kind);
  picture.data = bitDepth === 16 ? new Uint16Array(pixels) : Buffer.from(pixels);
  return png.PNG.sync.write(picture, kind);
}

async function walk(frames) {
  const recorder = new Recorder({ chunkSize: 64 * 1024 });
  await recorder.writer.start({ profile: "ros2", library: "make_mcap.mjs" });
  await addStatic(recorder, frames[0].stamp - 50_000_000n);
  for (const frame of frames) {
    await addMoving(recorder, frame, -1);
    await recorder.add("/camera/color/image_raw", "sensor_msgs/msg/Image", frame.stamp + 3_000_000n,
      image(frame.stamp + 3_000_000n, "rgb8", frame.rgb));
    await recorder.add("/camera/depth/camera_info", "sensor_msgs/msg/CameraInfo", frame.stamp, camera(frame.stamp));
    await recorder.add("/camera/depth/image_raw", "sensor_msgs/msg/Image", frame.stamp,
      image(frame.stamp, "16UC1", frame.depthMm));
    await recorder.add("/panoptic/labels", "sensor_msgs/msg/Image", frame.stamp,
      image(frame.stamp, "mono16", frame.labels));
    await recorder.add("/panoptic/detections", "vision_msgs/msg/Detection2DArray", frame.stamp, detections(frame));
    await addMoving(recorder, frame, 1);
  }
  await recorder.close(`${out}/walk.mcap`);
}

async function packedWalk(frames) {
  await zstd.isLoaded;
  let chunks = 0;
  const compressChunk = (data) => chunks++ % 2 === 0
    ? { compression: "lz4", compressedData: lz4.compress(data) }
    : { compression: "zstd", compressedData: new Uint8Array(zstd.compress(data, 9)) };
  const recorder = new Recorder({ chunkSize: 16 * 1024, compressChunk });
  await recorder.writer.start({ profile: "ros2", library: "make_mcap.mjs" });
  await addStatic(recorder, frames[0].stamp - 50_000_000n);
  const COMPRESSED = "sensor_msgs/msg/CompressedImage";
  for (const frame of frames) {
    const ids = frame.labels.map((id) => (id in classes ? classes[id].id * 1000 + (id % 1000) : 0));
    await addMoving(recorder, frame, -1);
    await recorder.add("/depth/camera_info", "sensor_msgs/msg/CameraInfo", frame.stamp, camera(frame.stamp));
    const depth = Buffer.concat([Buffer.alloc(12), pngOf(frame.depthMm, 0, 16)]);
    await recorder.add("/depth/image/compressedDepth", COMPRESSED, frame.stamp,
      packed(frame.stamp, "16UC1; compressedDepth png", depth));
    await recorder.add("/rgb/compressed", COMPRESSED, frame.stamp,
      packed(frame.stamp, "rgb8; png compressed bgr8", pngOf(frame.rgb, 2, 8)));
    await recorder.add("/panoptic", "sensor_msgs/msg/Image", frame.stamp,
      image(frame.stamp, "32SC1", Int32Array.from(ids)));
    await recorder.add("/label_info", "vision_msgs/msg/LabelInfo", frame.stamp, labelInfo(frame.stamp));
    await addMoving(recorder, frame, 1);
  }
  await recorder.close(`${out}/packed.mcap`);
}

function cloud(frame) {
  const step = 20, places = Array.from({ length: (width * height) / 4 }, (_, n) => {
    return [2 * (n % (width / 2)), 2 * Math.floor(n / (width / 2))];  // every other pixel, every other row
  });
  const data = Buffer.alloc(step * places.length);
  places.forEach(([u, v], n) => {
    const k = v * width + u, mm = frame.depthMm[k], z = mm === 0 ? NaN : mm / 1000;
    const point = [(z * (u - cx)) / fx, (z * (v - cy)) / fy, z];
    point.forEach((metres, axis) => data.writeFloatLE(metres, step * n + 4 * axis));
    data.set([frame.rgb[3 * k + 2], frame.rgb[3 * k + 1], frame.rgb[3 * k]], step * n + 12);
    data.writeUInt16LE(classes[frame.labels[k]]?.id ?? 0, step * n + 16);
  });
  const fields = [["x", 0, 7], ["y", 4, 7], ["z", 8, 7], ["rgb", 12, 7], ["label", 16, 4]];
  return { header: header(frame.stamp, "camera"), height: 1, width: places.length, is_bigendian: false,
    point_step: step, row_step: data.length, data, is_dense: false,
    fields: fields.map(([name, offset, datatype]) => ({ name, offset, datatype, count: 1 })) };
}

async function scan(frames) {
  const recorder = new Recorder({ useChunks: false, useStatistics: false, useSummaryOffsets: false,
    repeatSchemas: false, repeatChannels: false });
  await recorder.writer.start({ profile: "ros2", library: "make_mcap.mjs" });
  await addStatic(recorder, frames[0].stamp - 50_000_000n);
  await recorder.add("/label_info", "vision_msgs/msg/LabelInfo", frames[0].stamp, labelInfo(frames[0].stamp));
  for (const frame of frames) {
    await addMoving(recorder, frame, -1);
    await recorder.add("/points", "sensor_msgs/msg/PointCloud2", frame.stamp, cloud(frame));
    await addMoving(recorder, frame, 1);
  }
  await recorder.close(`${out}/scan.mcap`);
}

const frames = FRAMES.map(readFrame);
await walk(frames);
await packedWalk(frames.slice(0, 3));
await scan(frames.slice(0, 1));
writeFileSync(`${out}/truth.json`, JSON.stringify({
  camera: [width, height, fx, fy, cx, cy],
  classes: Object.fromEntries(Object.entries(classes).map(([id, { id: classId, name }]) => [id, [classId, name]])),
  frames: frames.map((frame) => ({ stamp_ns: String(frame.stamp), pose: frame.pose,
    depth_crc: crc32(octets(frame.depthMm)), rgb_crc: crc32(frame.rgb), labels_crc: crc32(octets(frame.labels)) })),
}) + "\n");
