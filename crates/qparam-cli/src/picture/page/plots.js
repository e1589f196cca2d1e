// Two small plots, as SVG text.

// Angle error against area error, on logarithmic axes; a dot a map.
class Front {
  constructor(svg, maps, knee, choose) {
    this.svg = svg;
    const errors = maps.map(map => [map.distortion.angle_error, map.distortion.area_error].map(x => Math.log10(Math.max(x, 1e-9))));
    const frame = { left: 46, right: 350, top: 10, bottom: 222 };
    const axis = k => {
      let low = Math.min(...errors.map(e => e[k])), high = Math.max(...errors.map(e => e[k]));
      const room = Math.max(0.08 * (high - low), 0.02);
      return { low: low - room, high: high + room };
    };
    const [x, y] = [axis(0), axis(1)];
    this.place = ([a, b]) => [
      frame.left + (a - x.low) / (x.high - x.low) * (frame.right - frame.left),
      frame.bottom - (b - y.low) / (y.high - y.low) * (frame.bottom - frame.top)];
    this.errors = errors;
    const ticks = (range, draw) => logTicks(range.low, range.high).map(draw).join('');
    const points = errors.map(this.place);
    svg.innerHTML = `<path class="axis" fill="none" d="M${frame.left} ${frame.top}V${frame.bottom}H${frame.right}"/>`
      + ticks(x, value => `<text text-anchor="middle" x="${this.place([Math.log10(value), 0])[0]}" y="${frame.bottom + 15}">${digits(value)}</text>`)
      + ticks(y, value => `<text text-anchor="end" x="${frame.left - 5}" y="${this.place([0, Math.log10(value)])[1] + 4}">${digits(value)}</text>`)
      + `<text text-anchor="end" x="${frame.right}" y="${frame.bottom + 31}">angle error (Eq. 13) →</text><text x="${frame.left + 6}" y="${frame.top + 4}">↑ area error (Eq. 14)</text>`
      + `<polyline class="curve" points="${points.map(p => p.join()).join(' ')}"/>`
      + maps.map((map, i) => `<circle class="dot${map.q === knee ? ' knee' : ''}" r="4.5" cx="${points[i][0]}" cy="${points[i][1]}" data-q="${map.q}"><title>q = ${map.q}</title></circle>`).join('')
      + '<circle class="now" r="8"/>';
    svg.setAttribute('aria-label', 'Angle error and area error of each map: '
      + maps.map(map => `q ${map.q}: ${digits(map.distortion.angle_error)} and ${digits(map.distortion.area_error)}`).join('; '));
    svg.addEventListener('click', event => { if (event.target.dataset.q) choose(Number(event.target.dataset.q)); });
    this.now = svg.querySelector('.now');
  }

  mark(a, b, mix) {
    const [x, y] = this.place([0, 1].map(k => this.errors[a][k] * (1 - mix) + this.errors[b][k] * mix));
    this.now.setAttribute('cx', x);
    this.now.setAttribute('cy', y);
  }
}

// Round values between powers of ten: 1, 2, 5 of each, or the powers alone, or even steps where there is less than a factor of two.
function logTicks(low, high) {
  const ticks = [];
  const steps = high - low > 4 ? [1] : high - low > 0.5 ? [1, 2, 5] : null;
  if (!steps) {
    const [from, to] = [10 ** low, 10 ** high], raw = (to - from) / 4, power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map(k => k * power).find(k => k >= raw);
    // Counted, since a step may be too small to move a value.
    const first = Math.ceil(from / step), count = Math.min(Math.floor(to / step) - first + 1, 10);
    for (let i = 0; i < count; i++) ticks.push(Number(((first + i) * step).toPrecision(6)));
    return ticks;
  }
  const skip = Math.max(1, Math.ceil((high - low) / 6));
  for (let power = Math.floor(low); power <= high; power += skip)
    for (const step of steps) {
      const value = step * 10 ** power;
      if (Math.log10(value) >= low && Math.log10(value) <= high) ticks.push(value);
    }
  return ticks;
}

// How many faces have which value of a measure.
function drawHistogram(svg, name, steps, ends, colors) {
  const [low, high] = ends, bins = Math.min(36, high - low), counts = new Uint32Array(bins);
  const flipped = steps.reduce((sum, step) => sum + (step === 255), 0);
  for (const step of steps) if (step < 255) counts[clamp(Math.floor((step - low) / (high - low) * bins), 0, bins - 1)]++;
  const most = Math.max(...counts, 1), width = 340 / bins;
  const value = share => MEASURES[name].value(low + share * (high - low));
  const bars = Array.from(counts, (count, i) => {
    const height = 160 * count / most, color = colors[Math.round((i + 0.5) / bins * (colors.length - 1))];
    return `<rect x="${10 + i * width}" y="${170 - height}" width="${width - 1}" height="${height}" fill="${color}" stroke="currentColor" stroke-width="0.3"/>`;
  });
  const ticks = [0, 0.25, 0.5, 0.75, 1].map(share =>
    `<text text-anchor="middle" x="${10 + 340 * share}" y="186">${share === 1 ? '≥ ' : share === 0 && name === 'area' ? '≤ ' : ''}${digits(Number(value(share).toPrecision(Math.abs(value(share) - 1) < 0.2 ? 4 : 3)))}${MEASURES[name].unit}</text>`);
  svg.innerHTML = `<path class="axis" d="M10 170.5H350"/>` + bars.join('') + ticks.join('');
  const middle = [...counts].reduce((state, count, i) => state.left > 0 ? { left: state.left - count, bin: i } : state,
    { left: steps.length / 2, bin: 0 });
  svg.setAttribute('aria-label', `Half of the faces have ${MEASURES[name].title} below about ${digits(value((middle.bin + 1) / bins))}${MEASURES[name].unit}; ${flipped} are flipped.`);
}
