// A function on the sphere as a surface of radius |f| that turns under the mouse.

const kLobeRows = 120;
const kLobeColumns = 240;  // (kLobeRows + 1) (kLobeColumns + 1) < 65536 indices

const kLobeVertexShader = `
  attribute vec3 position;
  attribute vec3 normal;
  attribute vec4 light;
  uniform mat3 turn;
  uniform vec2 extent;
  varying vec3 shading;
  varying vec4 shown;
  void main() {
    vec3 p = turn * position;
    shading = turn * normal;
    shown = light;
    gl_Position = vec4(p.xy * extent, -0.25 * p.z, 1.0);
  }`;

const kLobeFragmentShader = `
  precision highp float;
  uniform vec3 positive;
  uniform vec3 negative;
  uniform float own;
  varying vec3 shading;
  varying vec4 shown;
  void main() {
    vec3 n = normalize(shading);
    if (n.z < 0.0) n = -n;
    float lit = 0.42 + 0.5 * max(dot(n, vec3(-0.41, 0.57, 0.71)), 0.0) + 0.12 * n.z;
    vec3 sign = shown.a < 0.0 ? negative : positive;
    gl_FragColor = vec4(mix(sign, shown.rgb, own) * lit, 1.0);
  }`;

const kLineVertexShader = `
  attribute vec3 position;
  uniform mat3 turn;
  uniform vec2 extent;
  void main() {
    vec3 p = turn * position;
    gl_Position = vec4(p.xy * extent, -0.25 * p.z, 1.0);
  }`;

const kLineFragmentShader = `
  precision mediump float;
  uniform vec4 colour;
  void main() { gl_FragColor = colour; }`;

const kAxisLength = 1.2;
const kLabelReach = 0.04;  // above the widest step between vertices, 0.026
const kMargin = 1.34;  // what half the stage's shorter side shows

function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function weighted(a, s, b, t) {
  return a.map((value, i) => s * value + t * b[i]);
}

// The function's colour at every vertex of the surface's grid: (kLobeRows + 1, kLobeColumns + 1, 3).
function lobeSamples(channels, degree) {
  return synthesise(channels, degree, Array.from({length: kLobeRows + 1}, (_, i) => Math.PI * i / kLobeRows),
                    Array.from({length: kLobeColumns + 1}, (_, i) => 2 * Math.PI * i / kLobeColumns));
}

// Positions (native directions brought to the frame, times |value| / scale), normals, colours and
// values of the surface's grid; `rgb` is what lobeSamples gives.
function lobeMesh(rgb, valueOf, scale, nativeToFrame) {
  const stride = kLobeColumns + 1;
  const count = (kLobeRows + 1) * stride;
  const positions = new Float32Array(3 * count);
  const lights = new Float32Array(4 * count);
  for (let i = 0; i < count; ++i) {
    const theta = Math.PI * Math.floor(i / stride) / kLobeRows;
    const phi = 2 * Math.PI * (i % stride) / kLobeColumns;
    const colour = rgb.subarray(3 * i, 3 * i + 3);
    const value = valueOf(colour);
    const radius = Math.abs(value) / scale;
    const direction = nativeToFrame([Math.sin(theta) * Math.cos(phi), Math.sin(theta) * Math.sin(phi), Math.cos(theta)]);
    positions.set(direction.map(x => radius * x), 3 * i);
    const brightest = Math.max(colour[0], colour[1], colour[2], 1e-30);
    lights.set([0, 1, 2].map(c => srgbByte(colour[c] / brightest) / 255), 4 * i);
    lights[4 * i + 3] = value;
  }
  return {positions, normals: lobeNormals(positions), lights};
}

// Across the differences of neighbours; the columns close to a ring, the poles take their one-sided
// difference. Which side is out does not matter: the shader turns normals to the eye.
function lobeNormals(positions) {
  const stride = kLobeColumns + 1;
  const normals = new Float32Array(positions.length);
  const at = (row, column) => {
    const i = 3 * (row * stride + (column + kLobeColumns) % kLobeColumns);
    return [positions[i], positions[i + 1], positions[i + 2]];
  };
  for (let row = 0; row <= kLobeRows; ++row) {
    const inner = Math.min(Math.max(row, 1), kLobeRows - 1);
    for (let column = 0; column <= kLobeColumns; ++column) {
      const down = weighted(at(inner + 1, column), 1, at(inner - 1, column), -1);
      const along = weighted(at(inner, column + 1), 1, at(inner, column - 1), -1);
      const normal = cross(down, along);
      const length = Math.hypot(...normal) || 1;
      normals.set(normal.map(x => x / length), 3 * (row * stride + column));
    }
  }
  return normals;
}

function lobeTriangles() {
  const stride = kLobeColumns + 1;
  const indices = new Uint16Array(6 * kLobeRows * kLobeColumns);
  let end = 0;
  for (let row = 0; row < kLobeRows; ++row) {
    for (let column = 0; column < kLobeColumns; ++column) {
      const i = row * stride + column;
      indices.set([i, i + stride, i + 1, i + 1, i + stride, i + stride + 1], end);
      end += 6;
    }
  }
  return indices;
}

// Three great circles of radius 1, then the six half axes.
function stageLines() {
  const points = [];
  const steps = 128;
  for (let axis = 0; axis < 3; ++axis) {
    for (let i = 0; i < 2 * steps; ++i) {
      const angle = 2 * Math.PI * Math.ceil(i / 2) / steps;
      const point = [0, 0, 0];
      point[(axis + 1) % 3] = Math.cos(angle);
      point[(axis + 2) % 3] = Math.sin(angle);
      points.push(...point);
    }
  }
  const circleCount = points.length / 3;
  for (const sign of [1, -1]) {
    for (let axis = 0; axis < 3; ++axis) {
      const end = [0, 0, 0];
      end[axis] = sign * kAxisLength;
      points.push(0, 0, 0, ...end);
    }
  }
  return {points: new Float32Array(points), circleCount, axisCount: 6};
}

class LobeView {
  // The frame's x, y and z are drawn right-handed, whatever hand the frame's tool has: what points
  // along the drawn and labelled +x is the light from the tool's +x. The frame says which axis is up,
  // and from where the shape is first seen.
  constructor(canvas, labels, frame) {
    this.canvas = canvas;
    this.labels = [1, -1].flatMap(sign => ['x', 'y', 'z'].map((name, axis) => {
      const label = labels.appendChild(document.createElement('span'));
      label.textContent = (sign > 0 ? '+' : '−') + name;
      label.classList.toggle('minus', sign < 0);
      const direction = [0, 0, 0];
      direction[axis] = sign;
      return {label, direction};
    }));
    this.setFrame(frame);
    const options = {antialias: true, alpha: true};
    this.gl = canvas.getContext('webgl2', options) || canvas.getContext('webgl', options);
    if (this.gl) {
      this.prepare();
      canvas.addEventListener('webglcontextrestored', () => { this.prepare(); this.upload(); this.draw(); });
      canvas.addEventListener('webglcontextlost', event => event.preventDefault());
    }
    this.listen();
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  program(vertex, fragment) {
    const gl = this.gl;
    const program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    return program;
  }

  buffer(kind, data) {
    const gl = this.gl;
    const buffer = gl.createBuffer();
    gl.bindBuffer(kind, buffer);
    gl.bufferData(kind, data, gl.STATIC_DRAW);
    return buffer;
  }

  prepare() {
    const gl = this.gl;
    this.surface = this.program(kLobeVertexShader, kLobeFragmentShader);
    this.lines = this.program(kLineVertexShader, kLineFragmentShader);
    this.triangles = this.buffer(gl.ELEMENT_ARRAY_BUFFER, lobeTriangles());
    this.stage = stageLines();
    this.linePoints = this.buffer(gl.ARRAY_BUFFER, this.stage.points);
    this.vertexBuffers = [];
  }

  // What is drawn next is in this frame; as long as it stays, so does the turn.
  setFrame(frame) {
    if (this.frame === frame) return;
    this.frame = frame;
    this.turn = this.startTurn();
  }

  // `own`: 1 for the light's own colours, 0 for the sign's.
  show(mesh, own) {
    this.mesh = mesh;
    this.own = own;
    if (this.gl) this.upload();
    this.draw();
  }

  upload() {
    if (!this.mesh) return;
    const gl = this.gl;
    this.vertexBuffers.forEach(({buffer}) => gl.deleteBuffer(buffer));
    this.vertexBuffers = [
      {name: 'position', size: 3, buffer: this.buffer(gl.ARRAY_BUFFER, this.mesh.positions)},
      {name: 'normal', size: 3, buffer: this.buffer(gl.ARRAY_BUFFER, this.mesh.normals)},
      {name: 'light', size: 4, buffer: this.buffer(gl.ARRAY_BUFFER, this.mesh.lights)},
    ];
  }

  // The turn that sees the shape from the frame's viewer.
  startTurn() {
    const {center, up, viewer} = this.frame;
    return {yaw: Math.atan2(dot(viewer, cross(up, center)), dot(viewer, center)), pitch: Math.asin(dot(viewer, up))};
  }

  // Rows: the stage's right, up, and towards the eye.
  axes() {
    const {center, up} = this.frame;
    const {yaw, pitch} = this.turn;
    const level = weighted(center, Math.cos(yaw), cross(up, center), Math.sin(yaw));
    const right = cross(up, level);
    const eye = weighted(level, Math.cos(pitch), up, Math.sin(pitch));
    return [right, cross(eye, right), eye];
  }

  draw() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (!width || !height) return;
    const axes = this.axes();
    const half = Math.min(width, height) / 2 / kMargin;
    this.placeLabels(axes, width, height, half);
    if (!this.gl || !this.mesh) return;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const [columns, rows] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (this.canvas.width !== columns || this.canvas.height !== rows) {
      this.canvas.width = columns;
      this.canvas.height = rows;
    }
    const gl = this.gl;
    gl.viewport(0, 0, columns, rows);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    const turn = new Float32Array([0, 1, 2].flatMap(k => axes.map(axis => axis[k])));
    const extent = [2 * half / width, 2 * half / height];
    this.drawLines(turn, extent);
    this.drawSurface(turn, extent);
  }

  use(program, turn, extent) {
    const gl = this.gl;
    gl.useProgram(program);
    gl.uniformMatrix3fv(gl.getUniformLocation(program, 'turn'), false, turn);
    gl.uniform2fv(gl.getUniformLocation(program, 'extent'), extent);
  }

  attribute(program, name, size, buffer) {
    const gl = this.gl;
    const place = gl.getAttribLocation(program, name);
    if (place < 0) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
  }

  drawLines(turn, extent) {
    const gl = this.gl;
    this.use(this.lines, turn, extent);
    this.attribute(this.lines, 'position', 3, this.linePoints);
    const colour = gl.getUniformLocation(this.lines, 'colour');
    const line = cssColour('--quiet');
    gl.uniform4f(colour, ...line.map(c => c * 0.35), 0.35);
    gl.drawArrays(gl.LINES, 0, this.stage.circleCount);
    gl.uniform4f(colour, ...line, 1);
    gl.drawArrays(gl.LINES, this.stage.circleCount, 2 * this.stage.axisCount);
  }

  drawSurface(turn, extent) {
    const gl = this.gl;
    this.use(this.surface, turn, extent);
    for (const {name, size, buffer} of this.vertexBuffers) this.attribute(this.surface, name, size, buffer);
    gl.uniform3fv(gl.getUniformLocation(this.surface, 'positive'), cssColour('--positive'));
    gl.uniform3fv(gl.getUniformLocation(this.surface, 'negative'), cssColour('--negative'));
    gl.uniform1f(gl.getUniformLocation(this.surface, 'own'), this.own);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.triangles);
    gl.drawElements(gl.TRIANGLES, 6 * kLobeRows * kLobeColumns, gl.UNSIGNED_SHORT, 0);
    // An array left on whose buffer is deleted later would stop the lines from being drawn.
    for (const {name} of this.vertexBuffers) {
      const place = gl.getAttribLocation(this.surface, name);
      if (place >= 0) gl.disableVertexAttribArray(place);
    }
  }

  placeLabels(axes, width, height, half) {
    for (const {label, direction} of this.labels) {
      const [x, y, z] = axes.map(axis => (kAxisLength + 0.07) * dot(axis, direction));
      label.style.transform = `translate(-50%, -50%) translate(${width / 2 + half * x}px, ${height / 2 - half * y}px)`;
      label.classList.toggle('behind', z < -0.2);
      label.hidden = z < 0 && this.covers(axes, x, y);
    }
  }

  // Whether the surface, seen along the third axis, lies within kLabelReach of a point of the stage. It
  // ends at 1 and labels stand beyond kAxisLength: it is always before those that stand behind the middle.
  covers([right, up], x, y) {
    const p = this.mesh?.positions ?? [];
    for (let i = 0; i < p.length; i += 3) {
      const dx = right[0] * p[i] + right[1] * p[i + 1] + right[2] * p[i + 2] - x;
      const dy = up[0] * p[i] + up[1] * p[i + 1] + up[2] * p[i + 2] - y;
      if (dx * dx + dy * dy < kLabelReach * kLabelReach) return true;
    }
    return false;
  }

  turnBy(yaw, pitch) {
    this.turn.yaw += yaw;
    this.turn.pitch = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.turn.pitch + pitch));
    this.draw();
  }

  listen() {
    const canvas = this.canvas;
    canvas.addEventListener('pointerdown', event => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener('pointermove', event => {
      if (!canvas.hasPointerCapture(event.pointerId)) return;
      this.turnBy(-0.01 * event.movementX, 0.01 * event.movementY);
    });
    const step = Math.PI / 24;
    const turns = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step]};
    canvas.addEventListener('keydown', event => {
      if (event.key === 'Home') {
        this.turn = this.startTurn();
        this.draw();
      } else if (turns[event.key]) {
        this.turnBy(...turns[event.key]);
      } else {
        return;
      }
      event.preventDefault();
      event.stopPropagation();
    });
  }
}

// A custom property of the page, "#rrggbb", as three numbers in [0, 1].
function cssColour(name) {
  const text = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  return [1, 3, 5].map(i => parseInt(text.slice(i, i + 2), 16) / 255);
}

