// Where the two panes are looked at from. Matrices are sixteen numbers, column after column.

function multiply(a, b) {
  const product = new Array(16).fill(0);
  for (let column = 0; column < 4; column++)
    for (let row = 0; row < 4; row++)
      for (let k = 0; k < 4; k++) product[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return product;
}

const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

class SpaceCamera {
  constructor() { this.reset(); }

  reset() { Object.assign(this, { target: [0, 0, 0], yaw: 0.61, pitch: 0.28, distance: 3.1 }); }

  axes() {
    const [sy, cy, sp, cp] = [Math.sin(this.yaw), Math.cos(this.yaw), Math.sin(this.pitch), Math.cos(this.pitch)];
    return { right: [cy, 0, -sy], up: [-sy * sp, cp, -cy * sp], back: [sy * cp, sp, cy * cp] };
  }

  view(rectangle) {
    const { right, up, back } = this.axes();
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const eye = this.target.map((x, i) => x + back[i] * this.distance);
    const turn = [right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0,
      -dot(right, eye), -dot(up, eye), -dot(back, eye), 1];
    // The narrower side of the pane spans 25 degrees.
    const [, , width, height] = rectangle, focal = 1 / Math.tan(12.5 * Math.PI / 180), small = Math.min(width, height);
    const near = this.distance * 0.02, far = this.distance + 3;
    const lens = [focal * small / width, 0, 0, 0, 0, focal * small / height, 0, 0,
      0, 0, (near + far) / (near - far), -1, 0, 0, 2 * near * far / (near - far), 0];
    const light = [0, 1, 2].map(i => 0.8 * back[i] - 0.5 * right[i] + 0.55 * up[i]), size = Math.hypot(...light);
    return { rectangle, isFlat: false, matrix: multiply(lens, turn), light: light.map(x => x / size) };
  }

  turn(dx, dy) {
    this.yaw -= dx * 0.008;
    this.pitch = clamp(this.pitch + dy * 0.008, -1.55, 1.55);
  }

  move(dx, dy, height) {
    const { right, up } = this.axes(), unit = this.distance * 0.443 / height;
    this.target = this.target.map((x, i) => x + (-right[i] * dx + up[i] * dy) * unit);
  }

  zoom(factor) { this.distance = clamp(this.distance / factor, 0.01, 20); }

  // Straight at a place, so near that something of this size fills a part of the pane.
  towards(target, normal, size) {
    return {
      target, yaw: nearTurn(Math.atan2(normal[0], normal[2]), this.yaw), pitch: clamp(Math.asin(clamp(normal[1], -1, 1)), -1.5, 1.5),
      distance: clamp(size * 14, 0.05, 3),
    };
  }
}

// The same angle, less than half a turn away from `from`.
function nearTurn(angle, from) {
  return from + Math.atan2(Math.sin(angle - from), Math.cos(angle - from));
}

class PlaneCamera {
  constructor(boxes) {
    const low = k => Math.min(...boxes.map(box => box[k])), high = k => Math.max(...boxes.map(box => box[k] + box[k + 2]));
    this.all = { center: [(low(0) + high(0)) / 2, (low(1) + high(1)) / 2], extent: Math.max(high(0) - low(0), high(1) - low(1)) * 1.06 };
    this.reset();
  }

  // `extent` of the plane is seen along the narrower side.
  reset() { Object.assign(this, structuredClone(this.all)); }

  view(rectangle) {
    const [, , width, height] = rectangle, small = Math.min(width, height), unit = 2 * small / this.extent;
    const [x, y] = [unit / width, unit / height];
    return { rectangle, isFlat: true, light: [0, 0, 1], matrix: [x, 0, 0, 0, 0, y, 0, 0, 0, 0, 1, 0, -this.center[0] * x, -this.center[1] * y, 0, 1] };
  }

  move(dx, dy, small) {
    const unit = this.extent / small;
    this.center = [this.center[0] - dx * unit, this.center[1] + dy * unit];
  }

  zoom(factor) { this.extent = clamp(this.extent / factor, this.all.extent / 5000, this.all.extent * 4); }

  towards(center, size) { return { center, extent: clamp(size * 14, this.all.extent / 200, this.all.extent) }; }
}

// Pointer, wheel and keys of a pane. `act` names what can be done: turn, move, zoom, reset, point.
function listen(pane, act) {
  const pointers = new Map();
  const spread = () => { const [a, b] = [...pointers.values()]; return Math.hypot(a.x - b.x, a.y - b.y); };
  pane.addEventListener('pointerdown', event => {
    pane.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  for (const end of ['pointerup', 'pointercancel']) pane.addEventListener(end, event => pointers.delete(event.pointerId));
  pane.addEventListener('pointermove', event => {
    const known = pointers.get(event.pointerId);
    if (!known) return act.point(event);
    const before = pointers.size === 2 ? spread() : 0;
    const [dx, dy] = [event.clientX - known.x, event.clientY - known.y];
    Object.assign(known, { x: event.clientX, y: event.clientY });
    if (pointers.size === 2) act.zoom(spread() / before);
    else if (event.shiftKey || event.buttons & 2) act.move(dx, dy);
    else act.turn(dx, dy);
  });
  pane.addEventListener('pointerleave', () => act.point(null));
  pane.addEventListener('contextmenu', event => event.preventDefault());
  pane.addEventListener('wheel', event => {
    event.preventDefault();
    act.zoom(Math.exp(-clamp(event.deltaY, -200, 200) * 0.002));
  }, { passive: false });
  pane.addEventListener('dblclick', () => act.reset());
  pane.addEventListener('keydown', event => {
    const step = { ArrowLeft: [-20, 0], ArrowRight: [20, 0], ArrowUp: [0, -20], ArrowDown: [0, 20] }[event.key];
    if (step) (event.shiftKey ? act.move : act.turn)(-step[0], -step[1]);
    else if (event.key === '+' || event.key === '=') act.zoom(1.2);
    else if (event.key === '-') act.zoom(1 / 1.2);
    else if (event.key === '0') act.reset();
    else return;
    event.preventDefault();
  });
}
