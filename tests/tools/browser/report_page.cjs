// Drives report.html as a reader does: modes, a camera, an opening, the keyboard, a phone, no WebGL.
//   node report_page.cjs REPORT.html [FOLDER for pictures of the page]
'use strict';
const path = require('node:path');
const {pathToFileURL} = require('node:url');
const {open, finish} = require('./browser.cjs');

const [file, folder] = process.argv.slice(2);
const address = pathToFileURL(path.resolve(file)).href;
const wrong = [];
const expect = (holds, text) => { if (!holds) wrong.push(text); };
const picture = async (page, name) => { if (folder) await page.screenshot({path: path.join(folder, `${name}.png`)}); };

/** The drawn canvas: share of pixels that show something, and their mean color. */
const drawn = (page) => page.evaluate(() => {
  viewer.draw();
  const gl = viewer.renderer.getContext();
  const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
  const pixels = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  const sum = [0, 0, 0];
  let count = 0;
  for (let i = 0; i < pixels.length; i += 4) {
    if (pixels[i + 3] < 128) continue;
    ++count;
    for (let k = 0; k < 3; ++k) sum[k] += pixels[i + k];
  }
  return {share: count / (width * height), mean: sum.map((value) => value / Math.max(count, 1))};
});
const distance = (a, b) => Math.hypot(...a.mean.map((value, i) => value - b.mean[i]));

/** Where on the page the camera of a view that is in sight is drawn, and its name. */
const cameraInSight = (page) => page.evaluate(() => {
  const box = viewer.canvas.getBoundingClientRect();
  for (const view of data.views) {
    const at = viewer.local(view.camera.center).project(viewer.camera);
    const [x, y] = [(at.x + 1) / 2 * box.width, (1 - at.y) / 2 * box.height];
    if (at.z < 1 && x > 20 && y > 60 && x < box.width - 20 && y < box.height - 20 && viewer.viewAt(x, y) === view)
      return {x: x + box.left, y: y + box.top, name: view.name};
  }
  return null;
});

async function readOnDesk() {
  const {browser, page, errors} = await open(address);
  await page.waitForFunction(() => !texture || viewer.materials.textured.slice(0, -1).every((page) => page.map.version > 0));
  const looks = {};
  for (const button of await page.locator('#modes button').all()) {
    const name = await button.textContent();
    await button.click();
    expect(await button.getAttribute('aria-checked') === 'true', `${name} is not marked when chosen`);
    looks[name] = await drawn(page);
    expect(looks[name].share > 0.01, `${name} draws nothing: ${looks[name].share}`);
    await picture(page, name.toLowerCase());
  }
  const names = Object.keys(looks);
  expect(names.length >= 4, `only these modes: ${names}`);
  for (const mode of ['Shape', 'Confidence', 'Views'])
    expect(distance(looks.Color, looks[mode]) > 8, `${mode} looks as Color does`);
  if (looks.Texture) expect(distance(looks.Texture, looks.Color) < 12, 'Texture has other colors than Color');
  await page.locator('#modes button').first().click();

  let camera = null;
  for (let step = 0; step < 12 && !camera; ++step) {
    await page.evaluate(() => viewer.zoom(1.2));
    camera = await cameraInSight(page);
  }
  expect(camera, 'no camera is in sight');
  if (camera) {
    await page.mouse.click(camera.x, camera.y);
    const caption = await page.locator('#photograph figcaption').textContent();
    expect(caption.startsWith(`${camera.name}:`), `a click on ${camera.name} shows ${caption}`);
    expect(await page.locator('#photograph img').evaluate((image) => image.decode().then(() => image.naturalWidth > 0)), 'no photograph');
    expect((await drawn(page)).share > 0.01, 'the mesh is out of sight beside its photograph');
    await picture(page, 'camera');
    await page.locator('#close').click();
    expect(await page.locator('#photograph').isHidden(), 'the photograph stays');
  }
  const holes = page.locator('#holes button');
  if (await holes.count() > 0) {
    await holes.first().click();
    expect(await page.evaluate(() => viewer.rim && viewer.rim.geometry.getAttribute('position').count > 2), 'no rim is drawn');
    await picture(page, 'opening');
  } else {
    expect((await page.locator('aside').textContent()).includes('No opening'), 'neither openings nor a word on them');
  }

  await page.locator('#canvas').focus();
  const position = () => page.evaluate(() => viewer.camera.position.toArray().join());
  for (const key of ['ArrowLeft', 'ArrowUp', '+', 'r']) {
    const before = await position();
    await page.keyboard.press(key);
    expect(await position() !== before, `key ${key} does nothing`);
  }
  for (const details of await page.locator('aside details').all())
    if (!await details.evaluate((element) => element.open)) await details.locator('summary').press('Enter');
  expect(/[0-9a-f]{64}/.test(await page.locator('#files').textContent()), 'no SHA-256');
  expect((await page.locator('#run').textContent()).includes('Device'), 'no device');
  expect(await page.locator('#views button').count() === await page.evaluate(() => data.views.length), 'not all views are listed');
  await page.locator('#views button').last().click();
  expect(await page.locator('#photograph').isVisible(), 'the list shows no photograph');
  for (const error of errors) wrong.push(`desk: ${error}`);
  await browser.close();
}

async function readOnPhone() {
  const {browser, page, errors} = await open(address, {width: 390, height: 780});
  expect((await drawn(page)).share > 0.01, 'nothing is drawn on a phone');
  const overflow = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
  expect(overflow <= 0, `the page is ${overflow} pixels too wide for a phone`);
  await picture(page, 'phone');
  for (const error of errors) wrong.push(`phone: ${error}`);
  await browser.close();
}

async function readWithoutWebGl() {
  const {browser, page} = await open(address, {webgl: false});
  expect((await page.locator('#trouble').textContent()).includes('WebGL'), 'no word on the lack of WebGL');
  expect(await page.locator('#views button').count() > 0, 'no views without WebGL');
  await page.locator('#views button').first().click();
  expect(await page.locator('#photograph').isVisible(), 'no photograph without WebGL');
  await picture(page, 'without-webgl');
  await browser.close();
}

(async () => {
  await readOnDesk();
  await readOnPhone();
  await readWithoutWebGl();
  finish(wrong);
})().catch((error) => { console.error(error.message); process.exit(1); });  // an open browser would keep it alive
