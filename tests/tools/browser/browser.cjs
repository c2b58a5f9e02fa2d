// A headless Chromium with software WebGL, driven by playwright-core.
'use strict';
const {chromium} = require('playwright-core');

/** Opens a page in a window of a size; webgl: whether it can draw. Errors that the page tells are collected. */
async function open(address, {width = 1280, height = 800, webgl = true} = {}) {
  const drawing = webgl ? ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist']
    : ['--disable-gpu', '--disable-3d-apis'];
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM || '/usr/bin/chromium',
    args: ['--no-sandbox', '--allow-file-access-from-files', ...drawing],
  });
  const page = await browser.newPage({viewport: {width, height}});
  const errors = [];
  page.on('pageerror', (error) => errors.push(error.message));
  page.on('console', (message) => { if (message.type() === 'error') errors.push(message.text()); });
  page.on('request', (request) => { if (/^https?:/.test(request.url())) errors.push(`asks for ${request.url()}`); });
  await page.goto(address, {timeout: 120000});
  return {browser, page, errors};
}

/** Ends with 1 and what was wrong, or with 0. */
function finish(wrong) {
  for (const line of wrong) console.error(line);
  process.exitCode = wrong.length > 0 ? 1 : 0;
}

module.exports = {open, finish};
