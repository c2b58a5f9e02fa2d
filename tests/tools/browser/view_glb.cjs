// Opens a GLB file in three.js (Debian's libjs-three, with its GLTFLoader) and looks at it from three sides.
//   node view_glb.cjs MODEL.glb [FOLDER for pictures] [up: x,y,z]
'use strict';
const fs = require('node:fs');
const path = require('node:path');
const {open, finish} = require('./browser.cjs');

const [file, folder, up = '0,1,0'] = process.argv.slice(2);
const three = process.env.THREE || '/usr/share/javascript/three';

/** In the page: loads the model and keeps what draws it. */
async function load([base64, up]) {
  const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  const model = await new Promise((resolve, reject) => new THREE.GLTFLoader().parse(bytes.buffer, '', resolve, reject));
  const scene = new THREE.Scene();
  scene.add(model.scene);
  const box = new THREE.Box3().setFromObject(model.scene);
  const [center, size] = [box.getCenter(new THREE.Vector3()), box.getSize(new THREE.Vector3()).length()];
  const renderer = new THREE.WebGLRenderer({canvas: document.querySelector('canvas'), alpha: true, preserveDrawingBuffer: true});
  renderer.gammaOutput = true;
  const camera = new THREE.PerspectiveCamera(40, 1, size / 1000, size * 10);
  const told = {meshes: 0, triangles: 0, textures: 0, confidences: 0};
  model.scene.traverse((node) => {
    if (!node.isMesh) return;
    ++told.meshes;
    told.triangles += node.geometry.index.count / 3;
    if (node.material.map && node.material.map.image.width > 0) ++told.textures;
    if (node.geometry.getAttribute('_confidence')) ++told.confidences;
  });
  const axis = new THREE.Vector3(...up).normalize();
  const side = new THREE.Vector3(Math.abs(axis.x) < 0.9 ? 1 : 0, Math.abs(axis.x) < 0.9 ? 0 : 1, 0);
  side.sub(axis.clone().multiplyScalar(side.dot(axis))).normalize();
  window.lookFrom = (turn) => {
    const from = side.clone().applyAxisAngle(axis, turn).add(axis.clone().multiplyScalar(0.35));
    camera.up.copy(axis);
    camera.position.copy(center).add(from.multiplyScalar(1.3 * size));
    camera.lookAt(center);
    renderer.render(scene, camera);
    const gl = renderer.getContext();
    const pixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
    gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    const levels = new Set();
    let shown = 0;
    for (let i = 0; i < pixels.length; i += 4) {
      if (pixels[i + 3] < 128) continue;
      ++shown;
      levels.add(pixels[i] << 16 | pixels[i + 1] << 8 | pixels[i + 2]);
    }
    return {share: 4 * shown / pixels.length, colors: levels.size};
  };
  return told;
}

(async () => {
  const {browser, page, errors} = await open('about:blank');
  await page.setContent('<body style="margin:0;background:#555"><canvas width="700" height="700"></canvas></body>');
  await page.addScriptTag({path: path.join(three, 'three.min.js')});
  await page.addScriptTag({path: path.join(three, 'examples/js/loaders/GLTFLoader.js')});
  const told = await page.evaluate(load, [fs.readFileSync(file).toString('base64'), up.split(',').map(Number)]);
  console.log(JSON.stringify(told));
  const wrong = [...errors];
  if (told.triangles < 1) wrong.push('no triangles');
  for (let i = 0; i < 3; ++i) {
    const seen = await page.evaluate((turn) => window.lookFrom(turn), 2 * Math.PI / 3 * i);
    if (seen.share < 0.02) wrong.push(`from side ${i} nothing is seen`);
    if (told.textures > 0 && seen.colors < 200) wrong.push(`from side ${i} the texture has ${seen.colors} colors`);
    if (folder) await page.locator('canvas').screenshot({path: path.join(folder, `${path.parse(file).name}-${i}.png`)});
  }
  await browser.close();
  finish(wrong);
})().catch((error) => { console.error(error.message); process.exit(1); });  // an open browser would keep it alive
