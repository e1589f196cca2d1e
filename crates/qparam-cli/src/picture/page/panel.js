// What stands beside the views: numbers, the worst faces, what was done.

const ROWS = [
  ['angle error (Eq. 13)', d => d.angle_error],
  ['area error (Eq. 14)', d => d.area_error],
  ['sum of both', d => d.angle_error + d.area_error],
  ['angles off by (rms)', d => d.angle_rms_degrees, '°'],
  ['symmetric Dirichlet, mean', d => d.symmetric_dirichlet],
  ['symmetric Dirichlet, largest', d => d.symmetric_dirichlet_max],
  ['s1/s2, mean', d => d.singular_ratio_mean],
  ['s1/s2, 99th percentile', d => d.singular_ratio_p99],
  ['L2 stretch', d => d.stretch_l2],
  ['flipped corners', d => d.flipped_corners],
  ['folded faces', d => d.folded_faces],
  ['boundary crossings', d => d.boundary_crossings],
];

class Panel {
  constructor(meta, fly) {
    this.meta = meta;
    this.fly = fly;
    const body = document.querySelector('#numbers tbody');
    this.cells = ROWS.map(([name]) => {
      const row = body.insertRow(), head = document.createElement('th');
      head.scope = 'row';
      head.textContent = name;
      row.append(head);
      return row.insertCell();
    });
    fill('#notes', meta.notes.map(note => item(note)));
    document.querySelector('#settings').textContent = JSON.stringify(meta.settings, null, 1);
    fill('#notes', [...document.querySelector('#notes').children, item(`qparam ${meta.version}`)]);
    this.shown = -1;
  }

  numbers(a, b, mix) {
    const [from, to] = [this.meta.maps[a].distortion, this.meta.maps[b].distortion];
    const isBetween = mix > 0 && mix < 1;
    ROWS.forEach(([, value, unit = ''], i) => {
      const [x, y] = [value(from), value(to)];
      const known = x !== null && y !== null;
      const mean = x === y ? x : x + (y - x) * mix;
      this.cells[i].textContent = (isBetween && x !== y ? '≈ ' : '') + (known ? digits(mean) + unit : '–');
    });
    const nearest = mix < 0.5 ? a : b;
    if (nearest !== this.shown) this.map(nearest);
    const text = isBetween ? `Between the maps of q = ${this.meta.maps[a].q} and ${this.meta.maps[b].q}: a picture of the way, not a map.` : '';
    const between = document.querySelector('#between');
    if (between.textContent !== text) between.textContent = text;
  }

  // Verdict and worst faces belong to one map.
  map(number) {
    this.shown = number;
    const map = this.meta.maps[number];
    const verdict = document.querySelector('#verdict');
    const at = map.q === null ? '' : ` at q = ${map.q}`;
    verdict.textContent = `Certificate${at}: ${map.certificate}${map.holds ? ', no two faces overlap' : ''}`;
    verdict.className = map.holds ? 'holds' : 'fails';
    fill('#worst', map.worst.map(worst => {
      const entry = document.createElement('li'), button = document.createElement('button');
      button.type = 'button';
      button.textContent = `face ${worst.face} (line ${worst.line}): ${reason(worst)}`;
      button.addEventListener('click', () => this.fly(worst.face - 1));
      entry.append(button);
      const cause = document.createElement('div');
      cause.textContent = worst.cause;
      entry.append(cause);
      return entry;
    }));
  }
}

// What is wrong with a face, the largest fault first.
function reason({ angle, area, ratio }) {
  if (ratio === null) return 'flipped';
  const factor = area >= 1 ? `${digits(Number(area.toPrecision(3)))} times too large` : `${digits(Number((1 / area).toPrecision(3)))} times too small`;
  const faults = [
    [Math.abs(Math.log(area)), factor],
    [Math.log(ratio), `stretched ${digits(Number(ratio.toPrecision(3)))} : 1`],
    [angle / 45, `corners off by ${angle.toFixed(0)}°`],
  ];
  return faults.filter(([size]) => size > 0.05).sort((x, y) => y[0] - x[0]).map(([, text]) => text).join(', ') || 'nearly an isometry';
}

function fill(place, children) { document.querySelector(place).replaceChildren(...children); }

function item(text) {
  const entry = document.createElement('li');
  entry.textContent = text;
  return entry;
}
