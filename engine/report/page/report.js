// The page of a run: draws the mesh with three.js, and lists what the run knows. All text from files goes in as text.
'use strict';

const data = JSON.parse(document.getElementById('data').textContent);
const element = (id) => document.getElementById(id);

/** An element with text and children. */
function make(tag, text, ...children) {
  const made = document.createElement(tag);
  if (text) made.textContent = text;
  made.append(...children);
  return made;
}

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

// Colors of a value from 0 to 1 that keep their order for all eyes (after viridis).
const stops = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
function ramp(value) {
  const place = Math.min(Math.max(value, 0), 1) * (stops.length - 1);
  const low = Math.min(Math.floor(place), stops.length - 2);
  return stops[low].map((level, i) => level + (stops[low + 1][i] - level) * (place - low));
}
const css = (color) => `rgb(${color.map(Math.round).join(',')})`;

const mesh = data.mesh;
const colors = bytesOf(mesh.colors);
const confidence = bytesOf(mesh.confidence);
const viewCounts = bytesOf(mesh.views);
const mostViews = Math.min(10, data.views.length) || 1;
const full = data.histogram.full;
const short = (value) => Number(value.toPrecision(3)).toString();

const texture = mesh.texture;

const modes = [
  ...(texture ? [{name: 'Texture', isTextured: true, color: (i) => [colors[3 * i], colors[3 * i + 1], colors[3 * i + 2]]}] : []),
  {name: 'Color', lit: false, color: (i) => [colors[3 * i], colors[3 * i + 1], colors[3 * i + 2]]},
  {name: 'Shape', lit: true, color: () => [200, 200, 196]},
  {name: 'Confidence', lit: true, color: (i) => ramp(confidence[i] / 255), legend: ['0: a guess', `${short(full)} or more`]},
  {name: 'Views', lit: true, color: (i) => ramp(viewCounts[i] / mostViews), legend: ['no view', `${mostViews} views`]},
];

/** Normals of vertices. Where a texture's pieces meet, a vertex is there once for each: they share one normal. */
function smoothNormals(packed, positions, triangles) {
  const first = new Map();  // vertex of a place
  const same = new Uint32Array(positions.length / 3);
  for (let i = 0; i < same.length; ++i) {
    const place = (packed[3 * i] * 65536 + packed[3 * i + 1]) * 65536 + packed[3 * i + 2];
    if (!first.has(place)) first.set(place, i);
    same[i] = first.get(place);
  }
  const at = (i) => new THREE.Vector3().fromArray(positions, 3 * i);
  const normals = new Float32Array(positions.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [triangles[t], triangles[t + 1], triangles[t + 2]];
    const [a, b, c] = corners.map(at);
    const normal = b.sub(a).cross(c.sub(a)).toArray();  // as long as twice its area
    for (const corner of corners) normal.forEach((value, axis) => { normals[3 * same[corner] + axis] += value; });
  }
  for (let i = 0; i < same.length; ++i) normals.copyWithin(3 * i, 3 * same[i], 3 * same[i] + 3);
  for (let i = 0; i < same.length; ++i) new THREE.Vector3().fromArray(normals, 3 * i).normalize().toArray(normals, 3 * i);
  return normals;
}

/** The inside of a surface is drawn dark, so that an opening looks like one. */
function darkInside(material) {
  material.side = THREE.DoubleSide;
  material.onBeforeCompile = (shader) => {
    const last = '#include <premultiplied_alpha_fragment>';
    shader.fragmentShader = shader.fragmentShader.replace(last, `if (!gl_FrontFacing) gl_FragColor.rgb *= 0.3;\n${last}`);
  };
  return material;
}

class Viewer {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true, alpha: true});
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(40, 1, 0.001, 1000);
    this.light = new THREE.DirectionalLight(0xffffff, 0.85);
    this.scene.add(new THREE.AmbientLight(0xffffff, 0.3), this.light, this.light.target);
    this.addMesh();
    this.addCameras();
    this.controls = new THREE.TrackballControls(this.camera, canvas);
    this.controls.staticMoving = true;
    this.controls.rotateSpeed = 3;
    this.controls.keys = [];  // S, A and D stay free
    this.controls.addEventListener('change', () => this.draw());
    this.reset();
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    const tick = () => { this.controls.update(); requestAnimationFrame(tick); };
    tick();
  }

  addMesh() {
    const packed = new Uint16Array(bytesOf(mesh.positions).buffer);
    const positions = new Float32Array(packed.length);
    for (let i = 0; i < packed.length; ++i) positions[i] = (packed[i] / 65535 - 0.5) * mesh.size[i % 3];
    this.middle = mesh.low.map((low, i) => low + mesh.size[i] / 2);  // the page's origin: float32 stays exact enough
    this.radius = Math.hypot(...mesh.size) / 2 || 1;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
    geometry.setAttribute('color', new THREE.BufferAttribute(new Uint8Array(positions.length), 3, true));
    const triangles = new Uint32Array(bytesOf(mesh.triangles).buffer);
    geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
    geometry.setAttribute('normal', new THREE.BufferAttribute(smoothNormals(packed, positions, triangles), 3));
    const options = {vertexColors: THREE.VertexColors};
    this.materials = {lit: darkInside(new THREE.MeshLambertMaterial(options)), flat: darkInside(new THREE.MeshBasicMaterial(options))};
    if (texture) this.addTexture(geometry);
    this.mesh = new THREE.Mesh(geometry, this.materials.flat);
    this.scene.add(this.mesh);
  }

  /** A material for each page of the texture; triangles that no photograph shows keep the colors of their vertices. */
  addTexture(geometry) {
    const places = new Uint16Array(bytesOf(texture.coordinates).buffer);
    geometry.setAttribute('uv', new THREE.BufferAttribute(places, 2, true));
    const first = texture.first_triangles;
    const groups = first.slice(1).map((end, i) => ({start: 3 * first[i], count: 3 * (end - first[i]), materialIndex: i}));
    const pages = texture.pages.map((address) => {
      const page = new THREE.Texture(new Image());
      page.flipY = false;
      page.generateMipmaps = false;
      page.minFilter = THREE.LinearFilter;
      page.image.addEventListener('load', () => { page.needsUpdate = true; this.draw(); });
      page.image.src = address;
      return darkInside(new THREE.MeshBasicMaterial({map: page}));
    });
    this.materials.textured = [...pages, this.materials.flat];
    this.groups = groups;
  }

  local(point) { return new THREE.Vector3(...point.map((value, i) => value - this.middle[i])); }

  addCameras() {
    const points = [];
    const size = this.radius * 0.09;
    for (const view of data.views) {
      const {rotation, size: pixels, focal} = view.camera;
      const center = this.local(view.camera.center);
      const corner = (x, y) => center.clone().add(new THREE.Vector3(...rotation[0]).multiplyScalar(x * size * pixels[0] / focal / 2))
        .add(new THREE.Vector3(...rotation[1]).multiplyScalar(y * size * pixels[1] / focal / 2))
        .add(new THREE.Vector3(...rotation[2]).multiplyScalar(size));
      const corners = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
      corners.forEach((at, i) => points.push(center, at, at, corners[(i + 1) % 4]));
    }
    const geometry = new THREE.BufferGeometry().setFromPoints(points);
    this.frusta = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({color: 0xffd27f}));
    this.scene.add(this.frusta);
  }

  /** Looks from where the first photograph was taken, all of the mesh in the picture. */
  reset() {
    const from = data.views.length > 0 ? this.local(data.views[0].camera.center) : new THREE.Vector3(0, 0, 1);
    const up = data.views.length > 0 ? new THREE.Vector3(...data.views[0].camera.rotation[1]).negate() : new THREE.Vector3(0, 1, 0);
    if (from.lengthSq() === 0) from.set(0, 0, 1);
    this.look(from.setLength(this.radius * 3.2), new THREE.Vector3(), up, 40);
  }

  look(position, target, up, fov) {
    this.camera.position.copy(position);
    this.camera.up.copy(up);
    this.camera.fov = fov;
    const distance = position.distanceTo(target);
    this.camera.near = Math.max(distance, this.radius) * 1e-3;
    this.camera.far = Math.max(distance, this.radius) * 30;
    if (this.controls) this.controls.target.copy(target);
    this.camera.lookAt(target);
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** As a photograph sees it: the same center, axes and angle. */
  lookAs(view) {
    const {center, rotation, size, focal} = view.camera;
    const position = this.local(center);
    const axis = new THREE.Vector3(...rotation[2]);
    const target = position.clone().add(axis.multiplyScalar(Math.max(-position.dot(axis), this.radius * 0.1)));
    const up = new THREE.Vector3(...rotation[1]).negate();
    const aspect = this.canvas.clientWidth / Math.max(this.canvas.clientHeight, 1);
    const height = Math.max(size[1], size[0] / aspect);  // all of the photograph is in the picture
    this.look(position, target, up, 2 * Math.atan(height / 2 / focal) * 180 / Math.PI);
  }

  lookInto(hole) {
    const center = this.local(hole.center);
    const normal = new THREE.Vector3(...hole.normal);
    const up = Math.abs(normal.dot(this.camera.up)) > 0.95 ? new THREE.Vector3(normal.y, normal.z, normal.x) : this.camera.up.clone();
    this.look(center.clone().add(normal.multiplyScalar(hole.diameter * 1.5 + this.radius * 1.6)), center, up, 40);
    if (this.rim) this.scene.remove(this.rim);
    const points = [];
    for (let i = 0; i < hole.line.length; i += 3) points.push(this.local(hole.line.slice(i, i + 3)));
    const material = new THREE.LineBasicMaterial({color: 0xff3355, depthTest: false});
    this.rim = new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints(points), material);
    this.rim.renderOrder = 1;  // over the mesh, also where that lies before it
    this.scene.add(this.rim);
    this.draw();
  }

  setMode(mode) {
    const attribute = this.mesh.geometry.getAttribute('color');
    for (let i = 0; i < attribute.count; ++i) attribute.array.set(mode.color(i), 3 * i);
    attribute.needsUpdate = true;
    this.mesh.geometry.groups = mode.isTextured ? this.groups : [];
    this.mesh.material = this.materials[mode.isTextured ? 'textured' : mode.lit ? 'lit' : 'flat'];
    this.draw();
  }

  /** The view whose frustum is at a point of the canvas, or none. */
  viewAt(x, y) {
    let best = null;
    let least = 22;
    for (const view of data.views) {
      const at = this.local(view.camera.center).project(this.camera);
      const distance = Math.hypot((at.x + 1) / 2 * this.canvas.clientWidth - x, (1 - at.y) / 2 * this.canvas.clientHeight - y);
      if (at.z < 1 && distance < least) [best, least] = [view, distance];
    }
    return best;
  }

  turn(right, down) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const side = new THREE.Vector3().crossVectors(this.camera.up, offset).normalize();
    offset.applyAxisAngle(this.camera.up, right).applyAxisAngle(side, down);
    this.camera.up.applyAxisAngle(side, down);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.draw();
  }

  zoom(factor) {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.draw();
  }

  resize() {
    const {clientWidth, clientHeight} = this.canvas.parentElement;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / Math.max(clientHeight, 1);
    this.camera.updateProjectionMatrix();
    this.controls.handleResize();
    this.draw();
  }

  draw() {
    this.light.position.copy(this.camera.position);
    this.renderer.render(this.scene, this.camera);
  }
}

function showModes(viewer) {
  const choose = (mode, button) => {
    for (const other of element('modes').children) other.setAttribute('aria-checked', String(other === button));
    viewer.setMode(mode);
    element('legend').hidden = !mode.legend;
    if (!mode.legend) return;
    const bar = make('i');
    bar.style.background = `linear-gradient(90deg, ${stops.map(css).join(',')})`;
    element('legend').replaceChildren(bar, make('span', '', make('span', mode.legend[0]), make('span', mode.legend[1])));
  };
  for (const mode of modes) {
    const button = make('button', mode.name);
    button.type = 'button';
    button.setAttribute('role', 'radio');
    button.addEventListener('click', () => choose(mode, button));
    element('modes').append(button);
  }
  choose(modes[0], element('modes').children[0]);
}

function showPhotograph(viewer, view) {
  const figure = element('photograph');
  figure.hidden = false;
  figure.querySelector('img').src = view.photograph;
  figure.querySelector('img').alt = `Photograph ${view.name}`;
  const neighbors = view.neighbors && view.neighbors.length ? `; compared with ${view.neighbors.join(', ')}` : '';
  figure.querySelector('figcaption').textContent = `${view.name}: ${Math.round(100 * view.valid)} % measured${neighbors}`;
  if (viewer) viewer.lookAs(view);
}

function showViews(viewer) {
  for (const view of data.views) {
    const photograph = make('img');
    const map = make('img');
    [photograph.src, map.src] = [view.photograph, view.certainty || view.depth];
    [photograph.alt, map.alt] = ['', ''];
    photograph.loading = map.loading = 'lazy';
    const button = make('button', '', photograph, map, make('div', `${view.name}: ${Math.round(100 * view.valid)} % measured`));
    button.type = 'button';
    button.addEventListener('click', () => showPhotograph(viewer, view));
    element('views').append(button);
  }
}

function showHoles(viewer) {
  if (data.holes.length === 0) element('holes').replaceWith(make('p', 'No opening is wider than 3 % of the mesh.'));
  for (const hole of data.holes) {
    const button = make('button', 'Show');
    button.type = 'button';
    button.addEventListener('click', () => viewer && viewer.lookInto(hole));
    const direction = hole.normal.map((value) => value.toFixed(2)).join(', ');
    element('holes').append(make('li', '', make('div', `${short(hole.diameter)} scene units wide, open towards (${direction}). ${hole.remedy}.`), button));
  }
}

function showHistogram() {
  const counts = data.histogram.counts;
  const most = Math.max(...counts, 1);
  const width = 100 / counts.length;
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', '0 0 100 40');
  svg.setAttribute('preserveAspectRatio', 'none');
  svg.setAttribute('role', 'img');
  svg.setAttribute('aria-label', 'Vertices by confidence');
  counts.forEach((count, i) => {
    const bar = document.createElementNS('http://www.w3.org/2000/svg', 'rect');
    const height = 40 * count / most;
    for (const [name, value] of [['x', i * width], ['y', 40 - height], ['width', width * 0.9], ['height', height], ['fill', css(ramp((i + 0.5) / counts.length))]])
      bar.setAttribute(name, value);
    svg.append(bar);
  });
  element('histogram').append(svg, make('p', `Vertices by confidence, 0 to ${short(full)} and more. 1 is one photograph that is fully sure.`));
}

function row(name, value) { return make('tr', '', make('td', name), make('td', value)); }

function showRun() {
  const table = make('table');
  const run = data.run;
  const add = (name, value) => { if (value !== undefined && value !== null) table.append(row(name, String(value))); };
  add('Quorum', run.version);
  add('Device', run.device);
  const verified = data.verified.version === run.version && Array.isArray(data.verified.devices) ? data.verified.devices : [];
  add('Verified on', verified.length > 0 ? verified.join(', ') : 'no device yet: quorum verify OUT --scene SCENE');
  add('Wall seconds', run.wall_seconds && run.wall_seconds.toFixed(1));
  add('CPU seconds', run.cpu_seconds && run.cpu_seconds.toFixed(1));
  add('Peak memory', run.peak_memory_bytes && `${Math.round(run.peak_memory_bytes / 1048576)} MiB`);
  for (const [name, value] of Object.entries(run.options || {})) add(name.replace(/_/g, ' '), Array.isArray(value) ? value.join(', ') : value);
  for (const stage of run.stages || []) {
    add(stage.name.replace(/_/g, ' '), `${stage.wall_seconds.toFixed(1)} s, ${stage.cpu_seconds.toFixed(1)} CPU s`);
  }
  element('run').append(table);
  const files = make('table');
  files.append(make('tr', '', make('td', 'mesh.ply'), make('td', '', make('code', mesh.sha256))));
  for (const view of data.views) files.append(make('tr', '', make('td', view.name), make('td', '', make('code', view.sha256))));
  element('files').append(make('p', 'SHA-256. The same photographs and options give the same mesh on every device; quorum verify makes the run again and compares.'), files);
}

function listen(viewer) {
  const canvas = viewer.canvas;
  let pressed = [0, 0];
  canvas.addEventListener('pointerdown', (event) => { pressed = [event.offsetX, event.offsetY]; });
  canvas.addEventListener('pointerup', (event) => {
    if (Math.hypot(event.offsetX - pressed[0], event.offsetY - pressed[1]) > 4) return;
    const view = viewer.viewAt(event.offsetX, event.offsetY);
    if (view) showPhotograph(viewer, view);
  });
  const keys = {
    ArrowLeft: () => viewer.turn(-0.1, 0), ArrowRight: () => viewer.turn(0.1, 0), ArrowUp: () => viewer.turn(0, -0.1),
    ArrowDown: () => viewer.turn(0, 0.1), '+': () => viewer.zoom(0.9), '-': () => viewer.zoom(1.1), r: () => viewer.reset(),
  };
  canvas.addEventListener('keydown', (event) => {
    if (!keys[event.key]) return;
    keys[event.key]();
    event.preventDefault();
  });
  element('close').addEventListener('click', () => { element('photograph').hidden = true; });
}

let viewer = null;
try {
  if (mesh.all_triangles === 0) throw new Error('The mesh has no triangles.');
  viewer = new Viewer(element('canvas'));
  showModes(viewer);
  listen(viewer);
} catch (error) {
  element('trouble').hidden = false;
  element('trouble').textContent = `The mesh can't be drawn here (${error.message}). This browser may lack WebGL; the lists beside still hold.`;
  element('legend').hidden = true;
}
const missing = data.holes.length ? `, ${data.holes.length} openings` : '';
element('summary').textContent = `${data.views.length} photographs, ${mesh.all_triangles.toLocaleString('en')} triangles` +
  (mesh.shown_triangles < mesh.all_triangles ? ` (${mesh.shown_triangles.toLocaleString('en')} shown here)` : '') + missing;
showHoles(viewer);
showHistogram();
showViews(viewer);
showRun();
