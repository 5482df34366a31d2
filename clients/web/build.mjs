// SPDX-License-Identifier: BSD-3-Clause
// Makes dist/, which is committed, so that a build of the server needs no node:
//   node build.mjs            writes dist/
//   node build.mjs --check    says what of dist/ is not what would be written
import { build } from "esbuild";
import { mkdir, readFile, readdir, writeFile } from "node:fs/promises";
import { gzipSync } from "node:zlib";
import { fileURLToPath } from "node:url";
import { dirname, join } from "node:path";

const here = dirname(fileURLToPath(import.meta.url));
const mostGzipBytes = 250_000;

/** Which folders of src/ a file of a folder may import, besides its own. What is in none is wiring. */
const arrows = {
  api: [],
  state: ["api"],
  scene: ["api", "state"],
  actions: ["api", "state"],
  tools: ["api", "state", "scene", "actions"],
  panels: ["api", "state", "scene", "actions", "tools"],
};

/** What is imported against the arrows, a line each. */
async function wrongImports() {
  const wrong = [];
  for (const [room, allowed] of Object.entries(arrows)) {
    for (const name of await readdir(join(here, "src", room))) {
      const text = await readFile(join(here, "src", room, name), "utf8");
      for (const [, from] of text.matchAll(/from "\.\.\/([^"/]+)/g)) {
        if (!allowed.includes(from)) wrong.push(`src/${room}/${name} imports ${from}`);
      }
    }
  }
  return wrong;
}

async function makeFiles() {
  const bundle = await build({
    absWorkingDir: here,
    entryPoints: ["src/main.ts"],
    bundle: true,
    minify: true,
    format: "esm",
    target: ["es2022"],
    charset: "utf8",
    legalComments: "none",
    write: false,
    banner: { js: "// dhpmap viewer: BSD-3-Clause. Bundles three.js and three-mesh-bvh: MIT." },
  });
  const css = await build({ absWorkingDir: here, entryPoints: ["viewer.css"], minify: true, write: false });
  return new Map([
    ["viewer.js", Buffer.from(bundle.outputFiles[0].contents)],
    ["viewer.css", Buffer.from(css.outputFiles[0].contents)],
    ["index.html", await readFile(join(here, "index.html"))],
    ["icon.svg", await readFile(join(here, "icon.svg"))],
  ]);
}

const files = await makeFiles();
let total = 0;
for (const bytes of files.values()) total += gzipSync(bytes, { level: 9 }).length;
console.log(`${total} bytes gzipped, of at most ${mostGzipBytes}`);
const wrong = await wrongImports();
for (const line of wrong) console.log(line);
let isGood = total <= mostGzipBytes && wrong.length === 0;
await mkdir(join(here, "dist"), { recursive: true });
for (const [name, bytes] of files) {
  const path = join(here, "dist", name);
  if (!process.argv.includes("--check")) {
    await writeFile(path, bytes);
  } else if (!bytes.equals(await readFile(path).catch(() => Buffer.alloc(0)))) {
    console.log(`dist/${name} is not what the sources make: run \`node build.mjs\``);
    isGood = false;
  }
}
process.exit(isGood ? 0 : 1);
