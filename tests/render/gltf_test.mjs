// Exported lobes pass Khronos' validator without an error, a warning or a remark, in every kind of
// frame. Arguments: the program scene_tool, and a folder in which the validator is, or is installed.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import os from 'node:os';
import path from 'node:path';

const VALIDATOR = 'gltf-validator@2.0.0-dev.3.10';
const SKIPPED = 77;

function load(folder) {
  return createRequire(path.join(folder, 'here.js'))('gltf-validator');
}

function validator(folder) {
  try {
    return load(folder);
  } catch {
    fs.mkdirSync(folder, { recursive: true });
  }
  try {
    execFileSync('npm', ['install', '--no-save', '--silent', '--prefix', folder, VALIDATOR],
                 { stdio: 'ignore', timeout: 60000 });
    return load(folder);
  } catch {
    console.log(`skipped: ${VALIDATOR} is not there, and npm cannot get it`);
    process.exit(SKIPPED);
  }
}

const [tool, folder] = process.argv.slice(2);
const { validateBytes } = validator(folder);
const out = fs.mkdtempSync(path.join(os.tmpdir(), 'shoal-gltf-'));
let failures = 0;
for (const [frame, name] of [['native', 'a.glb'], ['openexr', 'b.gltf'], ['materialx', 'c.glb'],
                             ['three', 'd.glb']]) {
  const file = path.join(out, name);
  execFileSync(tool, ['lobes', frame, file]);
  const report = await validateBytes(new Uint8Array(fs.readFileSync(file)), { uri: name });
  const found = report.issues.messages.length;
  const vertices = report.info.totalVertexCount;
  console.log(`${name}, frame ${frame}: ${vertices} vertices, ${found} messages`);
  for (const message of report.issues.messages) console.log(`  ${message.code} ${message.pointer}: ${message.message}`);
  if (found > 0 || vertices < 1000) failures += 1;
}
fs.rmSync(out, { recursive: true });
process.exit(failures > 0 ? 1 : 0);
