// What the Khronos validator (gltf-validator) says of GLB files; ends with 1 if one has an error.
//   node validate_glb.cjs MODEL.glb ...
'use strict';
const fs = require('node:fs');
const {validateBytes} = require('gltf-validator');

(async () => {
  for (const file of process.argv.slice(2)) {
    const {issues} = await validateBytes(new Uint8Array(fs.readFileSync(file)));
    console.log(`${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ${issues.numInfos} infos`);
    for (const {severity, code, message, pointer} of issues.messages.slice(0, 10))
      console.log(`  ${severity} ${code} ${pointer}: ${message}`);
    if (issues.numErrors > 0) process.exitCode = 1;
  }
})().catch((error) => { console.error(error.message); process.exitCode = 1; });
