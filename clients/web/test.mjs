// SPDX-License-Identifier: BSD-3-Clause
// node test.mjs: the unit tests of tests/unit/clients/web, bundled, by node's own runner.
import { build } from "esbuild";
import { mkdtemp, readdir, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { spawnSync } from "node:child_process";

const tests = join(dirname(fileURLToPath(import.meta.url)), "../../tests/unit/clients/web");
const out = await mkdtemp(join(tmpdir(), "dhpmap-web-tests-"));
const names = (await readdir(tests)).filter((name) => name.endsWith(".test.ts"));
await build({
  entryPoints: names.map((name) => join(tests, name)),
  bundle: true,
  platform: "node",
  format: "esm",
  outdir: out,
  outExtension: { ".js": ".mjs" },
});
const run = spawnSync(process.execPath, ["--test", ...names.map((name) => join(out, name.replace(/ts$/, "mjs")))], {
  stdio: "inherit",
});
await rm(out, { recursive: true });
process.exit(run.status ?? 1);
