// The surface and its maps on the graphics card.

const ROW = 2048;

class Scene {
  constructor(gl, data, meta) {
    this.gl = gl;
    this.meta = meta;
    this.data = data;
    this.surface = program(gl, SURFACE_VERTEX, SURFACE_FRAGMENT);
    this.lines = program(gl, LINE_VERTEX, LINE_FRAGMENT);
    this.array = gl.createVertexArray();
    this.textures = this.upload();
    this.target = pickTarget(gl);
    this.patches = meta.shape.patches;
    this.edges = meta.shape.edges;
  }

  upload() {
    const { gl, data, meta } = this;
    const [x, y, z] = data.position;
    const shape = meta.shape;
    const at = (count, width, Kind, fill) => {
      const values = new Kind(Math.ceil(count / ROW) * ROW * width);
      for (let i = 0; i < count; i++) fill(values, i * width, i);
      return values;
    };
    const position = at(shape.vertices, 4, Uint16Array, (v, o, i) => { v[o] = x[i]; v[o + 1] = y[i]; v[o + 2] = z[i]; });
    const patch = at(shape.patches, 4, Uint32Array, (v, o, i) => { for (let k = 0; k < 4; k++) v[o + k] = data.corners[k][i]; });
    const line = at(shape.edges, 4, Uint32Array, (v, o, i) => { for (let k = 0; k < 3; k++) v[o + k] = data.edges[k][i]; });
    const single = (count, source) => at(count, 1, Uint32Array, (v, o, i) => { v[o] = source[i]; });
    const normals = vertexNormals(data, shape);
    const places = data.places.map(({ u, v }) =>
      at(shape.points, 2, Uint16Array, (values, o, i) => { values[o] = u[i]; values[o + 1] = v[i]; }));
    const measures = data.measures.map(({ angle, area, stretch }) =>
      at(shape.faces, 4, Uint8Array, (v, o, i) => { v[o] = angle[i]; v[o + 1] = area[i]; v[o + 2] = stretch[i]; v[o + 3] = data.island[i]; }));
    const flat = (values, width, formats) => texture(gl, gl.TEXTURE_2D, values.length / width / ROW, [values], formats);
    const layers = (arrays, width, formats) => texture(gl, gl.TEXTURE_2D_ARRAY, arrays[0].length / width / ROW, arrays, formats);
    return {
      uPosition: flat(position, 4, [gl.RGBA16UI, gl.RGBA_INTEGER, gl.UNSIGNED_SHORT]),
      uNormal: flat(normals, 4, [gl.RGBA32F, gl.RGBA, gl.FLOAT]),
      uPoint: flat(single(shape.points, data.vertexOfPoint), 1, [gl.R32UI, gl.RED_INTEGER, gl.UNSIGNED_INT]),
      uPatch: flat(patch, 4, [gl.RGBA32UI, gl.RGBA_INTEGER, gl.UNSIGNED_INT]),
      uFace: flat(single(shape.patches, data.faceOfPatch), 1, [gl.R32UI, gl.RED_INTEGER, gl.UNSIGNED_INT]),
      uLine: shape.edges ? flat(line, 4, [gl.RGBA32UI, gl.RGBA_INTEGER, gl.UNSIGNED_INT]) : null,
      uPlace: layers(places, 2, [gl.RG16UI, gl.RG_INTEGER, gl.UNSIGNED_SHORT]),
      uMeasure: layers(measures, 4, [gl.RGBA8UI, gl.RGBA_INTEGER, gl.UNSIGNED_BYTE]),
      uPalette: colors(gl, meta.categories, gl.NEAREST),
      sequential: colors(gl, meta.sequential, gl.LINEAR),
      diverging: colors(gl, meta.diverging, gl.LINEAR),
    };
  }

  // Draws one pane; `view` is its rectangle, camera, and whether it is the plane.
  draw(view, look) {
    const { gl } = this;
    const [left, bottom, width, height] = view.rectangle;
    gl.viewport(left, bottom, width, height);
    gl.scissor(left, bottom, width, height);
    gl.enable(gl.SCISSOR_TEST);
    gl.clearColor(...look.background, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.drawSurface(view, look, false);
    if (look.seams && this.edges) {
      const bound = this.bind(this.lines, view, look);
      gl.uniform2f(bound.uPixel, 2 / width, 2 / height);
      gl.uniform1f(bound.uWidth, look.lineWidth);
      gl.uniform3f(bound.uEdge, ...look.outline);
      gl.drawArrays(gl.TRIANGLES, 0, 6 * this.edges);
    }
  }

  drawSurface(view, look, pick) {
    const { gl } = this;
    const bound = this.bind(this.surface, view, look);
    gl.uniform1i(bound.uPick, pick ? 1 : 0);
    gl.uniform1i(bound.uEdges, look.edges ? 1 : 0);
    gl.uniform1i(bound.uStyle, look.style);
    gl.uniform1i(bound.uHover, look.hover);
    gl.uniform1f(bound.uChecks, look.checks);
    gl.uniform2f(bound.uRange, ...look.range);
    gl.uniform3f(bound.uLight, ...view.light);
    gl.uniform3f(bound.uClay, 0.80, 0.77, 0.73);
    gl.uniform3f(bound.uFlipped, ...rgb(this.meta.flipped));
    gl.drawArrays(gl.TRIANGLES, 0, 12 * this.patches);
  }

  bind({ handle, uniforms }, view, look) {
    const { gl, textures } = this;
    gl.useProgram(handle);
    gl.bindVertexArray(this.array);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    let unit = 0;
    for (const [name, value] of Object.entries({ ...textures, uRamp: textures[look.ramp] })) {
      if (!value || uniforms[name] === undefined) continue;
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(value.kind, value.handle);
      gl.uniform1i(uniforms[name], unit++);
    }
    const boxes = this.meta.shape.boxes;
    gl.uniform1i(uniforms.uMapA, look.a);
    gl.uniform1i(uniforms.uMapB, look.b);
    gl.uniform1f(uniforms.uMix, look.mix);
    gl.uniform4f(uniforms.uBoxA, ...boxes[look.a]);
    gl.uniform4f(uniforms.uBoxB, ...boxes[look.b]);
    gl.uniformMatrix4fv(uniforms.uCamera, false, view.matrix);
    gl.uniform1i(uniforms.uFlat, view.isFlat ? 1 : 0);
    gl.uniform3f(uniforms.uEdge, ...look.ink);
    return uniforms;
  }

  // The face under a place of a pane (from -1 to 1), or -1: the scene is drawn on a single pixel.
  pick(view, look, x, y) {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.target);
    gl.viewport(0, 0, 1, 1);
    gl.scissor(0, 0, 1, 1);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const [, , width, height] = view.rectangle;
    const zoomed = multiply([width, 0, 0, 0, 0, height, 0, 0, 0, 0, 1, 0, -x * width, -y * height, 0, 1], view.matrix);
    this.drawSurface({ ...view, matrix: zoomed }, look, true);
    const pixel = new Uint8Array(4);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return pixel[3] === 0 ? -1 : (pixel[0] | pixel[1] << 8 | pixel[2] << 16) - 1;
  }
}

function program(gl, vertex, fragment) {
  const handle = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(handle, shader);
  }
  gl.linkProgram(handle);
  if (!gl.getProgramParameter(handle, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(handle));
  const uniforms = {};
  const count = gl.getProgramParameter(handle, gl.ACTIVE_UNIFORMS);
  for (let i = 0; i < count; i++) {
    const { name } = gl.getActiveUniform(handle, i);
    uniforms[name] = gl.getUniformLocation(handle, name);
  }
  return { handle, uniforms };
}

function texture(gl, kind, rows, arrays, [inside, format, type]) {
  const handle = gl.createTexture();
  gl.bindTexture(kind, handle);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  if (kind === gl.TEXTURE_2D) {
    gl.texImage2D(kind, 0, inside, ROW, rows, 0, format, type, arrays[0]);
  } else {
    gl.texStorage3D(kind, 1, inside, ROW, rows, arrays.length);
    arrays.forEach((values, layer) => gl.texSubImage3D(kind, 0, 0, 0, layer, ROW, rows, 1, format, type, values));
  }
  gl.texParameteri(kind, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(kind, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  return { kind, handle };
}

function colors(gl, list, filter) {
  const bytes = new Uint8Array(list.flatMap(color => [...rgb(color).map(x => Math.round(255 * x)), 255]));
  const handle = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, handle);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, list.length, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  return { kind: gl.TEXTURE_2D, handle };
}

function pickTarget(gl) {
  const target = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, target);
  const part = (format, place) => {
    const buffer = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
    gl.renderbufferStorage(gl.RENDERBUFFER, format, 1, 1);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffer);
  };
  part(gl.RGBA8, gl.COLOR_ATTACHMENT0);
  part(gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  return target;
}

function rgb(hex) {
  return [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16) / 255);
}

// The sum over the faces' vector areas; four floats a vertex.
function vertexNormals(data, shape) {
  const [x, y, z] = data.position;
  const normals = new Float32Array(Math.ceil(shape.vertices / ROW) * ROW * 4);
  for (let i = 0; i < shape.patches; i++) {
    const [a, b, c, d] = data.corners.map(corner => data.vertexOfPoint[corner[i]]);
    const [ux, uy, uz] = [x[c] - x[a], y[c] - y[a], z[c] - z[a]];
    // Of a triangle the last point is there twice: its other diagonal is an edge, which gives the same direction.
    const [vx, vy, vz] = [x[d] - x[b], y[d] - y[b], z[d] - z[b]];
    const n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const vertex of c === d ? [a, b, c] : [a, b, c, d]) for (let k = 0; k < 3; k++) normals[4 * vertex + k] += n[k];
  }
  for (let i = 0; i < shape.vertices; i++) {
    const length = Math.hypot(normals[4 * i], normals[4 * i + 1], normals[4 * i + 2]) || 1;
    for (let k = 0; k < 3; k++) normals[4 * i + k] /= length;
  }
  return normals;
}
