// State, and what changes it. Handlers only note what is wanted; drawing happens once a frame.

const STYLES = [['checker', 'checkerboard'], ['angle', 'angles'], ['area', 'areas'], ['stretch', 'stretch'], ['islands', 'islands'], ['plain', 'plain']];
const $ = id => document.getElementById(id);

class App {
  constructor(meta, data, gl) {
    Object.assign(this, { meta, data, gl, style: 0, hover: -1, a: meta.chosen, b: meta.chosen, mix: 0, wanted: false, asked: null });
    this.panel = new Panel(meta, face => this.fly(face));
    this.ranges = Object.fromEntries(Object.keys(MEASURES).map(name => [name, data ? this.ends(name) : [0, 254]]));
    if (data) {
      this.scene = new Scene(gl, data, meta);
      this.space = new SpaceCamera();
      this.plane = new PlaneCamera(meta.shape.boxes);
    }
    this.controls();
    this.setQ(meta.maps[meta.chosen].q);
  }

  // The steps of a measure at the ends of its scale.
  ends(name) {
    const step = quantile(name, this.data.measures[this.meta.chosen][name], 0.98);
    return name === 'area' ? [127 - step, 127 + step] : [0, step];
  }

  controls() {
    const { maps, knee, no_knee } = this.meta;
    if (maps.length > 1) {
      $('q').value = maps[this.meta.chosen].q;
      $('q').addEventListener('input', () => this.setQ(Number($('q').value)));
      this.front = new Front($('front'), maps, knee, q => { $('q').value = q; this.setQ(q); });
      $('knee').textContent = knee === null ? `No knee: ${no_knee}.` : `Knee at q = ${knee}: beyond it one error costs much more of the other.`;
    } else {
      $('dial').hidden = $('front-section').hidden = true;
      $('dial').style.display = 'none';
    }
    $('theme').addEventListener('click', () => theme(document.documentElement.dataset.theme !== 'dark', this));
    if (!this.scene) return;
    STYLES.forEach(([name, label], i) => {
      const element = document.createElement('label'), input = document.createElement('input');
      Object.assign(input, { type: 'radio', name: 'style', value: name, checked: i === 0 });
      input.addEventListener('change', () => { this.style = i; this.scale(); this.draw(); });
      element.append(input, ` ${label}`);
      $('styles').append(element);
    });
    for (const name of ['edges', 'seams', 'checks']) $(name).addEventListener('input', () => this.draw());
    this.pane('space', this.space, (dx, dy) => this.space.turn(dx, dy));
    this.pane('plane', this.plane, (dx, dy) => this.plane.move(dx, dy, this.small('plane')));
    new ResizeObserver(() => this.draw()).observe($('stage'));
  }

  pane(id, camera, turn) {
    const then = change => (...values) => { this.asked = null; change(...values); this.draw(); };
    listen($(id), {
      turn: then(turn),
      move: then((dx, dy) => camera.move(dx, dy, this.small(id))),
      zoom: then(factor => camera.zoom(factor)),
      reset: then(() => camera.reset()),
      point: event => { this.asked = { id, event }; this.draw(); },
    });
  }

  small(id) { return Math.min($(id).clientWidth, $(id).clientHeight); }

  // Between two maps, the nearer one's share.
  setQ(q) {
    const { maps } = this.meta;
    if (maps.length > 1) {
      // The maps have falling q.
      let b = maps.findIndex(map => map.q <= q + 1e-9);
      if (b < 0) b = maps.length - 1;
      const a = Math.abs(maps[b].q - q) < 1e-9 ? b : Math.max(b - 1, 0);
      const [high, low] = [maps[a].q, maps[b].q];
      Object.assign(this, { a, b, mix: a === b ? 0 : clamp((high - q) / (high - low), 0, 1) });
      const text = q.toFixed(3).replace(/0$/, '');
      $('q-value').textContent = text;
      $('q').setAttribute('aria-valuetext', `q ${text}`);
      this.front.mark(this.a, this.b, this.mix);
    }
    this.panel.numbers(this.a, this.b, this.mix);
    this.stale = true;
    this.draw();
  }

  scale() {
    const name = STYLES[this.style][0], isHeat = name in MEASURES;
    $('scale').hidden = !isHeat;
    this.stale = true;
    if (!isHeat) return;
    const [low, high] = this.ranges[name].map(MEASURES[name].value), ramp = this.meta[name === 'area' ? 'diverging' : 'sequential'];
    const [left, bar, right] = $('scale').children;
    left.textContent = digits(Number(low.toPrecision(3))) + MEASURES[name].unit;
    right.textContent = digits(Number(high.toPrecision(3))) + MEASURES[name].unit;
    const context = bar.getContext('2d');
    for (let x = 0; x < 256; x++) {
      context.fillStyle = ramp[Math.round(x / 255 * (ramp.length - 1))];
      context.fillRect(x, 0, 1, 1);
    }
  }

  histogram() {
    this.stale = false;
    const name = STYLES[this.style][0] in MEASURES ? STYLES[this.style][0] : 'stretch';
    const steps = this.data.measures[this.mix < 0.5 ? this.a : this.b][name];
    const key = `${name} ${this.mix < 0.5 ? this.a : this.b}`;
    if (key === this.counted) return;
    this.counted = key;
    $('histogram-what').textContent = MEASURES[name].title;
    drawHistogram($('histogram'), name, steps, this.ranges[name], this.meta[name === 'area' ? 'diverging' : 'sequential']);
  }

  draw() {
    if (this.wanted || !this.scene) return;
    this.wanted = true;
    requestAnimationFrame(() => { this.wanted = false; this.frame(); });
  }

  look() {
    const name = STYLES[this.style][0], color = variable => rgb(getComputedStyle(document.documentElement).getPropertyValue(variable).trim());
    const range = {
      angle: ends => ends.map(MEASURES.angle.value), area: ends => ends.map(logArea),
      stretch: ends => ends.map(step => Math.log(MEASURES.stretch.value(step))),
    }[name];
    return {
      a: this.a, b: this.b, mix: this.mix, style: this.style, hover: this.hover, edges: $('edges').checked, seams: $('seams').checked,
      checks: Math.sqrt(2 ** Number($('checks').value) / this.meta.shape.area), background: color('--card'), ink: [0.12, 0.14, 0.2], outline: color('--ink'),
      range: range ? range(this.ranges[name]) : [0, 1], ramp: name === 'area' ? 'diverging' : 'sequential', lineWidth: 1.6 * devicePixelRatio,
    };
  }

  views() {
    const canvas = $('canvas'), ratio = devicePixelRatio, stage = canvas.getBoundingClientRect();
    const [width, height] = [Math.round(stage.width * ratio), Math.round(stage.height * ratio)];
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const rectangle = id => {
      const pane = $(id).getBoundingClientRect();
      return [pane.left - stage.left, stage.bottom - pane.bottom, pane.width, pane.height].map(x => Math.round(x * ratio));
    };
    return { space: this.space.view(rectangle('space')), plane: this.plane.view(rectangle('plane')) };
  }

  frame() {
    const look = this.look(), views = this.views();
    this.point(views, look);
    look.hover = this.hover;
    this.scene.draw(views.space, look);
    this.scene.draw(views.plane, look);
    if (this.stale) this.histogram();
  }

  // Marks the face under the pointer, in both views.
  point(views, look) {
    if (!this.asked) return;
    const { id, event } = this.asked;
    this.asked = null;
    const hint = $('hint');
    hint.hidden = true;
    this.hover = -1;
    if (!event) return;
    const pane = $(id).getBoundingClientRect(), stage = $('stage').getBoundingClientRect();
    const [x, y] = [(event.clientX - pane.left) / pane.width * 2 - 1, 1 - (event.clientY - pane.top) / pane.height * 2];
    this.hover = this.scene.pick(views[id], look, x, y);
    if (this.hover < 0) return;
    const measures = this.data.measures[this.mix < 0.5 ? this.a : this.b], step = name => measures[name][this.hover];
    const value = name => `${name} ${digits(Number(MEASURES[name].value(step(name)).toPrecision(2)))}${MEASURES[name].unit}`;
    hint.textContent = `face ${this.hover + 1}: ${step('angle') === 255 ? 'flipped' : Object.keys(MEASURES).map(value).join(', ')}`;
    Object.assign(hint.style, { left: `${clamp(event.clientX - stage.left + 14, 0, stage.width - 200)}px`, top: `${event.clientY - stage.top + 14}px` });
    hint.hidden = false;
  }

  // Both cameras go to a face.
  fly(face) {
    if (!this.scene) return;
    const { data, meta } = this, { faceOfPatch } = data;
    let [low, high] = [0, faceOfPatch.length - 1];
    while (low < high) { const middle = (low + high) >> 1; if (faceOfPatch[middle] < face) low = middle + 1; else high = middle; }
    const points = data.corners.map(corner => corner[low]);
    const spot = point => data.position.map(axis => axis[data.vertexOfPoint[point]] / 65535 - 0.5);
    const place = point => {
      const at = map => { const box = meta.shape.boxes[map], { u, v } = data.places[map]; return [box[0] + box[2] * u[point] / 65535, box[1] + box[3] * v[point] / 65535]; };
      const [p, q] = [at(this.a), at(this.b)];
      return p.map((x, k) => x + (q[k] - x) * this.mix);
    };
    const mean = list => list[0].map((_, k) => list.reduce((sum, p) => sum + p[k], 0) / list.length);
    const size = list => Math.max(...list.map(p => Math.hypot(...p.map((x, k) => x - list[0][k]))));
    const [spots, places] = [points.map(spot), points.map(place)];
    const [u, v] = [[2, 0], [3, 1]].map(([i, j]) => spots[i].map((x, k) => x - spots[j][k]));
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]], length = Math.hypot(...n) || 1;
    this.hover = face;
    this.go([[this.space, this.space.towards(mean(spots), n.map(x => x / length), size(spots))], [this.plane, this.plane.towards(mean(places), size(places))]]);
    $('space').focus({ preventScroll: true });
    $('stage').scrollIntoView({ block: 'nearest' });
  }

  // Moves cameras in half a second, or at once for those who want no motion.
  go(moves) {
    const calm = matchMedia('(prefers-reduced-motion: reduce)').matches, start = performance.now();
    const from = moves.map(([camera, goal]) => Object.fromEntries(Object.keys(goal).map(key => [key, structuredClone(camera[key])])));
    const mix = (x, y, t) => Array.isArray(x) ? x.map((value, i) => mix(value, y[i], t)) : x + (y - x) * t;
    const flight = this.flight = {};
    const step = now => {
      if (this.flight !== flight) return;
      const time = calm ? 1 : clamp((now - start) / 500, 0, 1), t = time * time * (3 - 2 * time);
      moves.forEach(([camera, goal], i) => { for (const key in goal) camera[key] = mix(from[i][key], goal[key], t); });
      this.draw();
      if (time < 1) requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }
}

function theme(isDark, app) {
  document.documentElement.dataset.theme = isDark ? 'dark' : 'light';
  $('theme').setAttribute('aria-pressed', isDark);
  if (app) app.draw();
}

async function main() {
  theme(matchMedia('(prefers-color-scheme: dark)').matches);
  const meta = JSON.parse($('meta').textContent);
  const gl = meta.shape && $('canvas').getContext('webgl2', { antialias: true });
  const data = gl ? await unpack($('packed').textContent, meta.shape) : null;
  $('packed').remove();
  document.documentElement.classList.toggle('live', !!data);
  if (!data) {
    document.querySelectorAll('.pane, #styles, #scale, .row, #help').forEach(element => element.remove());
    $('histogram').closest('section').remove();
  }
  window.qparam = new App(meta, data, gl);
  document.documentElement.dataset.ready = data ? 'live' : 'pictures';
}

main();
