// SPDX-License-Identifier: Apache-2.0
// node validate_gltf.cjs FOLDER MODEL..: what Khronos' validator (npm package gltf-validator, in FOLDER/node_modules or on
// NODE_PATH) has against each model: errors and warnings. Exit code 0: nothing; 1: what stands on stdout; 77: no such package.
'use strict';
const fs = require('fs');

const [folder, ...models] = process.argv.slice(2);
let place;
try {
  place = require.resolve('gltf-validator', { paths: [folder] });
} catch {
  process.exit(77);
}

async function complaints(model) {
  const { issues } = await require(place).validateBytes(new Uint8Array(fs.readFileSync(model)), { maxIssues: 0 });
  // 0 is an error, 1 a warning; 2 and 3 are notes: of extensions that it does not know, of sizes of images.
  return issues.messages
    .filter((issue) => issue.severity <= 1)
    .map((issue) => `${model}: ${issue.code} ${issue.pointer ?? ''}: ${issue.message}`);
}

(async () => {
  const found = (await Promise.all(models.map(complaints))).flat();
  if (found.length > 0) console.log(found.join('\n'));
  process.exitCode = found.length > 0 ? 1 : 0;
})();
