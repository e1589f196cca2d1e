// Reading what data.rs has packed: same order, same steps back.

async function unpack(text, shape) {
  const letters = atob(text);
  const deflated = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) deflated[i] = letters.charCodeAt(i);
  const stream = new Blob([deflated]).stream().pipeThrough(new DecompressionStream('deflate'));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  let position = 0;
  const planes = (count, width, Kind) => {
    const values = new Kind(count);
    let value = 0;
    for (let i = 0; i < count; i++) {
      let zigzag = 0;
      for (let byte = 0; byte < width; byte++) zigzag |= bytes[position + byte * count + i] << (8 * byte);
      value = value + ((zigzag >>> 1) ^ -(zigzag & 1)) | 0;
      values[i] = value;
    }
    position += count * width;
    return values;
  };
  const u16s = count => planes(count, 2, Uint16Array);
  const u32s = count => planes(count, 4, Uint32Array);
  const u8s = count => bytes.subarray(position, position += count);
  const many = (count, read) => Array.from({ length: count }, read);
  const maps = shape.boxes.length;
  return {
    position: many(3, () => u16s(shape.vertices)),
    vertexOfPoint: u32s(shape.points),
    faceOfPatch: u32s(shape.patches),
    corners: many(4, () => u32s(shape.patches)),
    island: u32s(shape.faces),
    edges: many(3, () => u32s(shape.edges)),
    places: many(maps, () => ({ u: u16s(shape.points), v: u16s(shape.points) })),
    measures: many(maps, () => ({ angle: u8s(shape.faces), area: u8s(shape.faces), stretch: u8s(shape.faces) })),
  };
}

// The binary logarithm of an area ratio.
const logArea = step => 10 * Math.sign(step - 127) * ((step - 127) / 127) ** 2;

// What a step of a measure means, from 0 to 254; 255 is a flipped face.
const MEASURES = {
  angle: { title: 'angle error', unit: '°', value: step => 180 * (step / 254) ** 2, best: 0 },
  area: { title: 'area in the map / on the surface', unit: '', value: step => 2 ** logArea(step), best: 1 },
  stretch: { title: 'stretch (symmetric Dirichlet)', unit: '', value: step => Math.exp(Math.log(1e6) * (step / 254) ** 2), best: 1 },
};

// The step below which this share of the faces lies; areas count by how far they are from 1, as steps from the middle.
function quantile(name, steps, share) {
  const counts = new Uint32Array(256);
  for (const step of steps) if (step < 255) counts[name === 'area' ? Math.abs(step - 127) : step]++;
  let left = share * counts.reduce((a, b) => a + b, 0);
  for (let step = 0; step < 255; step++) {
    left -= counts[step];
    if (left <= 0) return Math.max(step, 2);
  }
  return 254;
}

function digits(value) {
  if (value === null || value === undefined) return '–';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) return value.toExponential(2);
  return value.toPrecision(size >= 1000 ? 5 : 4).replace(/(\.\d*?)0+$/, '$1').replace(/\.$/, '');
}
