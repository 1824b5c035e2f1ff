// The page of `trimloop view`: orbit, body and face tree, pick a face -> its entity and its trim loops in (u, v).
// The scene stands in <script id="scene" type="application/json">; see io/view/page.h for its fields.
import {
  AmbientLight, BufferAttribute, BufferGeometry, CanvasTexture, Color, DirectionalLight, DoubleSide, LineBasicMaterial, LineSegments,
  Matrix4, Mesh, MeshBasicMaterial, MeshStandardMaterial, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

const data = JSON.parse(document.getElementById('scene').textContent);
const canvas = document.getElementById('canvas');
const panel = document.getElementById('picked');
const tree = document.getElementById('tree');

const bytesOf = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
const floatsOf = (text) => new Float32Array(bytesOf(text).buffer);
const indicesOf = (text) => new Uint32Array(bytesOf(text).buffer);

// --- scene -----------------------------------------------------------------------------------------------------------
const scene = new Scene();
scene.background = new Color(0xf4f5f7);
scene.add(new AmbientLight(0xffffff, 1.1));
const key = new DirectionalLight(0xffffff, 1.9);
key.position.set(1, -1.4, 2);
const fill = new DirectionalLight(0xffffff, 0.9);
fill.position.set(-1.5, 1, -0.6);

const size = Math.max(data.size, 1e-9);
const camera = new PerspectiveCamera(32, 1, size / 500, size * 50);
camera.up.set(0, 0, 1);
camera.add(key, fill);
scene.add(camera);

const highlight = new Color(0xff8a1e);
const meshes = [];
const edgeMaterial = new LineBasicMaterial({ color: 0x22262e });

for (const body of data.bodies) {
  const geometry = new BufferGeometry();
  const positions = floatsOf(body.positions);
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('normal', new BufferAttribute(floatsOf(body.normals), 3));
  geometry.setIndex(new BufferAttribute(indicesOf(body.triangles), 1));
  const colours = new Float32Array(positions.length);
  for (const face of body.faces) paint(colours, face, new Color(...face.colour));
  geometry.setAttribute('color', new BufferAttribute(colours, 3));
  const material = new MeshStandardMaterial({
    vertexColors: true, side: DoubleSide, metalness: 0.08, roughness: 0.6, polygonOffset: true,
    polygonOffsetFactor: 1, polygonOffsetUnits: 1,
  });
  const edges = new BufferGeometry();
  edges.setAttribute('position', new BufferAttribute(floatsOf(body.edges), 3));
  for (const placement of body.placements) {
    const mesh = new Mesh(geometry, material);
    mesh.matrixAutoUpdate = false;
    mesh.matrix = new Matrix4().fromArray(placement);
    mesh.userData.body = body;
    scene.add(mesh);
    meshes.push(mesh);
    const lines = new LineSegments(edges, edgeMaterial);
    lines.matrixAutoUpdate = false;
    lines.matrix = mesh.matrix;
    scene.add(lines);
  }
}

for (const note of data.annotation ?? []) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(floatsOf(note.strokes), 3));
  scene.add(new LineSegments(geometry, new LineBasicMaterial({ color: new Color(...note.colour) })));
  for (const run of note.texts) scene.add(written(run, note.colour));
}

// A run of text on a sheet as wide and as high as the file says.
function written(run, colour) {
  const height = 64;
  const picture = document.createElement('canvas');
  const pen = picture.getContext('2d');
  pen.font = `${height * 0.8}px sans-serif`;
  picture.width = Math.min(4096, Math.max(1, Math.ceil(pen.measureText(run.text).width)));
  picture.height = height;
  pen.font = `${height * 0.8}px sans-serif`;
  pen.fillStyle = `rgb(${colour.map((c) => Math.round(255 * c)).join(',')})`;
  pen.fillText(run.text, 0, height * 0.8);
  const along = new Vector3(...run.along), up = new Vector3(...run.up), at = new Vector3(...run.at);
  const corners = [at, at.clone().add(along), at.clone().add(along).add(up), at.clone().add(up)];
  const geometry = new BufferGeometry().setFromPoints(corners);
  geometry.setAttribute('uv', new BufferAttribute(new Float32Array([0, 0, 1, 0, 1, 1, 0, 1]), 2));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  const map = new CanvasTexture(picture);
  return new Mesh(geometry, new MeshBasicMaterial({ map, transparent: true, side: DoubleSide, depthWrite: false }));
}

function paint(colours, face, colour) {
  for (let i = face.first_vertex; i < face.first_vertex + face.vertices; ++i) colour.toArray(colours, 3 * i);
}

// --- camera ----------------------------------------------------------------------------------------------------------
const renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
const controls = new OrbitControls(camera, canvas);
controls.enableDamping = true;

function fit(direction) {
  const distance = (0.5 * size) / Math.tan((camera.fov * Math.PI) / 360) / Math.min(1, camera.aspect);
  camera.position.copy(direction.normalize().multiplyScalar(distance));
  controls.target.set(0, 0, 0);
  controls.update();
}

function resize() {
  const { clientWidth: w, clientHeight: h } = canvas.parentElement;
  renderer.setPixelRatio(window.devicePixelRatio);
  renderer.setSize(w, h, false);
  camera.aspect = w / Math.max(h, 1);
  camera.updateProjectionMatrix();
}
new ResizeObserver(resize).observe(canvas.parentElement);
resize();
const views = { i: [1, -1.25, 0.8], f: [0, -1, 0], t: [0, -1e-3, 1], r: [1, 0, 0] };
fit(new Vector3(...views.i));

// --- picking ---------------------------------------------------------------------------------------------------------
let picked = null;

function pick(body, face) {
  if (picked) repaint(picked, new Color(...picked.face.colour));
  picked = face ? { body, face } : null;
  if (picked) repaint(picked, highlight);
  describe(picked);
  for (const row of tree.querySelectorAll('[aria-selected]')) row.removeAttribute('aria-selected');
  if (face) {
    const row = document.getElementById(`face-${face.id}`);
    if (row) {
      row.parentElement.parentElement.open = true;
      row.setAttribute('aria-selected', 'true');
      row.scrollIntoView({ block: 'nearest' });
    }
  }
}

function repaint({ body, face }, colour) {
  const mesh = meshes.find((m) => m.userData.body === body);
  const attribute = mesh.geometry.getAttribute('color');
  paint(attribute.array, face, colour);
  attribute.needsUpdate = true;
}

function describe(selection) {
  panel.replaceChildren();
  if (!selection) {
    panel.append(element('p', 'Click a face, or choose one in the list. Keys: i isometric, f front, t top, r right.'));
    return;
  }
  const { body, face } = selection;
  panel.append(element('h2', `Face ${face.id}${face.source ? ` · ${face.source}` : ''}`));
  const list = document.createElement('dl');
  const rows = [['Body', body.name], ['Name', face.name], ['Source entity', face.source], ['Surface', face.surface],
    ['State', face.status], ['Remark', face.reason], ['Area', areaChange(face.areas)], ['Triangles', String(face.triangles)],
    ['Off by at most', `${face.bound.toPrecision(3)} mm`]];
  for (const [name, value] of rows) if (value) list.append(element('dt', name), element('dd', value));
  panel.append(list, element('h3', 'Trim loops in (u, v)'), loopPicture(face.loops));
}

// [before, after] of a healed face in mm2; before may be unknown.
function areaChange(areas) {
  if (!areas || areas.length < 2) return '';
  const before = areas[0] === null ? 'unknown' : `${areas[0].toPrecision(7)} mm2`;
  return `${before} before healing, ${areas[1].toPrecision(7)} mm2 after`;
}

function element(tag, text) {
  const node = document.createElement(tag);
  node.textContent = text;
  return node;
}

// Loops as polylines with an arrow at each start: outer loops in blue, holes in red (by signed area).
function loopPicture(loops) {
  const ns = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(ns, 'svg');
  let [u0, v0, u1, v1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const loop of loops) {
    for (let i = 0; i < loop.length; i += 2) {
      u0 = Math.min(u0, loop[i]); u1 = Math.max(u1, loop[i]);
      v0 = Math.min(v0, loop[i + 1]); v1 = Math.max(v1, loop[i + 1]);
    }
  }
  if (!(u1 > u0)) u1 = u0 + 1;
  if (!(v1 > v0)) v1 = v0 + 1;
  const w = 240, h = 180, m = 12;
  const x = (u) => m + ((u - u0) / (u1 - u0)) * (w - 2 * m);
  const y = (v) => h - m - ((v - v0) / (v1 - v0)) * (h - 2 * m);
  svg.setAttribute('viewBox', `0 0 ${w} ${h}`);
  for (const loop of loops) {
    let area = 0, d = '';
    for (let i = 0; i < loop.length; i += 2) {
      const j = (i + 2) % loop.length;
      area += loop[i] * loop[j + 1] - loop[j] * loop[i + 1];
      d += `${i ? 'L' : 'M'}${x(loop[i]).toFixed(2)} ${y(loop[i + 1]).toFixed(2)}`;
    }
    const path = document.createElementNS(ns, 'path');
    path.setAttribute('d', `${d}Z`);
    path.setAttribute('class', area >= 0 ? 'outer' : 'hole');
    svg.append(path);
  }
  const caption = document.createElementNS(ns, 'title');
  caption.textContent = `u ${u0.toPrecision(5)} to ${u1.toPrecision(5)}, v ${v0.toPrecision(5)} to ${v1.toPrecision(5)}`;
  svg.append(caption);
  const figure = document.createElement('figure');
  figure.append(svg, element('figcaption', caption.textContent));
  return figure;
}

let pressed = null;
canvas.addEventListener('pointerdown', (e) => { pressed = [e.clientX, e.clientY]; });
canvas.addEventListener('pointerup', (e) => {
  if (!pressed || Math.hypot(e.clientX - pressed[0], e.clientY - pressed[1]) > 4) return;
  const box = canvas.getBoundingClientRect();
  const at = new Vector2(((e.clientX - box.left) / box.width) * 2 - 1, 1 - ((e.clientY - box.top) / box.height) * 2);
  const ray = new Raycaster();
  ray.setFromCamera(at, camera);
  const hit = ray.intersectObjects(meshes)[0];
  if (!hit) return pick(null, null);
  const { body } = hit.object.userData;
  const triangle = hit.faceIndex;
  pick(body, body.faces.find((f) => triangle >= f.first_triangle && triangle < f.first_triangle + f.triangles));
});
window.addEventListener('keydown', (e) => { if (views[e.key]) fit(new Vector3(...views[e.key])); });

// --- tree ------------------------------------------------------------------------------------------------------------
for (const body of data.bodies) {
  const group = document.createElement('details');
  group.open = data.bodies.length === 1 && body.faces.length <= 60;
  group.append(element('summary', `${body.name} (${body.faces.length})`));
  const list = document.createElement('ul');
  for (const face of body.faces) {
    const row = element('li', `${face.source || face.id}${face.name ? ` ${face.name}` : ''}${face.status === 'ok' ? '' : ` · ${face.status}`}`);
    row.id = `face-${face.id}`;
    row.tabIndex = 0;
    row.className = face.status;
    row.addEventListener('click', () => pick(body, face));
    row.addEventListener('keydown', (e) => { if (e.key === 'Enter') pick(body, face); });
    list.append(row);
  }
  group.append(list);
  tree.append(group);
}

// page.html#face=3 opens with that face picked, so that a finding can link to it.
function pickFromAddress() {
  const wanted = /face=(\d+)/.exec(window.location.hash);
  const id = wanted ? Number(wanted[1]) : -1;
  for (const body of data.bodies) {
    for (const face of body.faces) if (face.id === id) return pick(body, face);
  }
  return pick(null, null);
}
window.addEventListener('hashchange', pickFromAddress);
pickFromAddress();
(function frame() {
  controls.update();
  renderer.render(scene, camera);
  document.documentElement.dataset.ready = 'true';
  requestAnimationFrame(frame);
})();
