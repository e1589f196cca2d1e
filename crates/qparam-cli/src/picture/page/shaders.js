// Everything is fetched from textures by number, so that going from one map to the next changes a number and no array.
// A quad is four triangles around its middle: no diagonal is preferred, and colours are looked up in the bilinear quad.

const COMMON = `#version 300 es
precision highp float; precision highp int; precision highp usampler2D; precision highp usampler2DArray;
uniform usampler2D uPosition, uPoint;
uniform usampler2DArray uPlace;
uniform int uMapA, uMapB;
uniform float uMix;
uniform vec4 uBoxA, uBoxB;
uniform mat4 uCamera;
uniform bool uFlat;
ivec2 cell(uint i) { return ivec2(int(i & 2047u), int(i >> 11)); }
vec2 place(uint point) {
  vec2 a = uBoxA.xy + uBoxA.zw * vec2(texelFetch(uPlace, ivec3(cell(point), uMapA), 0).xy) / 65535.0;
  vec2 b = uBoxB.xy + uBoxB.zw * vec2(texelFetch(uPlace, ivec3(cell(point), uMapB), 0).xy) / 65535.0;
  return mix(a, b, uMix);
}
vec3 spot(uint point, vec2 uv) {
  if (uFlat) return vec3(uv, 0.0);
  uint vertex = texelFetch(uPoint, cell(point), 0).x;
  return vec3(texelFetch(uPosition, cell(vertex), 0).xyz) / 65535.0 - 0.5;
}
`;

const SURFACE_VERTEX = COMMON + `
uniform usampler2D uPatch, uFace;
uniform usampler2DArray uMeasure;
uniform sampler2D uNormal;
out vec2 vShare;
out vec3 vNormal;
flat out vec4 vUv01, vUv23;
flat out vec4 vMeasure;
flat out uvec2 vFace;
vec3 normal(uint point) { return texelFetch(uNormal, cell(texelFetch(uPoint, cell(point), 0).x), 0).xyz; }
void main() {
  uint patchNumber = uint(gl_VertexID) / 12u;
  int k = (gl_VertexID % 12) / 3, corner = gl_VertexID % 3;
  uvec4 p = texelFetch(uPatch, cell(patchNumber), 0);
  bool isTriangle = p.z == p.w;
  int n = isTriangle ? 3 : 4;
  vec2 uv0 = place(p.x), uv1 = place(p.y), uv2 = place(p.z), uv3 = place(p.w);
  vUv01 = vec4(uv0, uv1); vUv23 = vec4(uv2, uv3);
  int which = corner == 0 ? -1 : (k + corner - 1) % n;
  if (k == 3 && isTriangle) which = 0;
  vec3 at;
  if (which < 0) {
    vec3 sum = spot(p.x, uv0) + spot(p.y, uv1) + spot(p.z, uv2);
    vNormal = normal(p.x) + normal(p.y) + normal(p.z);
    at = isTriangle ? sum / 3.0 : (sum + spot(p.w, uv3)) / 4.0;
    vShare = isTriangle ? vec2(1.0 / 3.0) : vec2(0.5);
    if (!isTriangle) vNormal += normal(p.w);
    vNormal = normalize(vNormal + 1e-9);
  } else {
    uint point = which == 0 ? p.x : which == 1 ? p.y : which == 2 ? p.z : p.w;
    at = spot(point, which == 0 ? uv0 : which == 1 ? uv1 : which == 2 ? uv2 : uv3);
    vNormal = normal(point);
    vShare = which == 0 ? vec2(0.0) : which == 1 ? vec2(1.0, 0.0) : which == 3 ? vec2(0.0, 1.0)
      : isTriangle ? vec2(0.0, 1.0) : vec2(1.0);
  }
  uint face = texelFetch(uFace, cell(patchNumber), 0).x;
  vec4 a = vec4(texelFetch(uMeasure, ivec3(cell(face), uMapA), 0)), b = vec4(texelFetch(uMeasure, ivec3(cell(face), uMapB), 0));
  bool isFlipped = a.x == 255.0 && uMix < 1.0 || b.x == 255.0 && uMix > 0.0;
  vMeasure = vec4(mix(a.xyz, b.xyz, uMix) / 254.0, isFlipped ? 1.0 : 0.0);
  vFace = uvec2(face, uint(a.w) | (isTriangle ? 256u : 0u));
  gl_Position = uCamera * vec4(at, 1.0);
}`;

const SURFACE_FRAGMENT = `#version 300 es
precision highp float; precision highp int;
uniform bool uFlat, uEdges, uPick;
uniform int uStyle, uHover;
uniform float uChecks;
uniform vec2 uRange;
uniform vec3 uLight, uClay, uEdge, uFlipped;
uniform sampler2D uRamp, uPalette;
in vec2 vShare;
in vec3 vNormal;
flat in vec4 vUv01, vUv23;
flat in vec4 vMeasure;
flat in uvec2 vFace;
out vec4 color;
// How much of a pixel lies on dark checks: the mean of a square wave over the pixel's width.
float checker(vec2 p) {
  vec2 w = max(fwidth(p), vec2(1e-4));
  vec2 left = abs(fract((p - 0.5 * w) / 2.0) - 0.5), right = abs(fract((p + 0.5 * w) / 2.0) - 0.5);
  vec2 wave = clamp(2.0 * (left - right) / w, -1.0, 1.0);
  return 0.5 + 0.5 * wave.x * wave.y;
}
void main() {
  if (uPick) {
    uint id = vFace.x + 1u;
    color = vec4(id & 255u, (id >> 8) & 255u, (id >> 16) & 255u, 255u) / 255.0;
    return;
  }
  bool isTriangle = vFace.y >= 256u;
  float s = vShare.x, t = vShare.y;
  vec4 shares = isTriangle ? vec4(1.0 - s - t, s, t, 0.0) : vec4((1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t);
  vec2 uv = shares.x * vUv01.xy + shares.y * vUv01.zw + shares.z * vUv23.xy + shares.w * vUv23.zw;
  vec3 base = uClay;
  if (uStyle == 0) base = mix(vec3(0.98, 0.975, 0.965), vec3(0.17, 0.41, 0.69), checker(uv * uChecks));
  if (uStyle >= 1 && uStyle <= 3) {
    float away = 2.0 * vMeasure.y - 1.0;
    float x = uStyle == 1 ? 180.0 * vMeasure.x * vMeasure.x : uStyle == 2 ? 10.0 * away * abs(away)
      : 13.8155 * vMeasure.z * vMeasure.z;
    base = texture(uRamp, vec2(clamp((x - uRange.x) / (uRange.y - uRange.x), 0.004, 0.996), 0.5)).rgb;
    if (vMeasure.w > 0.0) base = uFlipped;
  }
  if (uStyle == 4) base = mix(vec3(1.0), texelFetch(uPalette, ivec2(int(vFace.y & 255u) % 48, 0), 0).rgb, 0.45);
  float shade = 1.0;
  if (!uFlat) {
    vec3 n = normalize(vNormal) * (gl_FrontFacing ? 1.0 : -1.0);
    shade = 0.55 + 0.45 * max(dot(n, uLight), 0.0);
    if (uStyle >= 1 && uStyle <= 3) shade = mix(1.0, shade, 0.5);
    if (!gl_FrontFacing) base = mix(base, vec3(0.35), 0.6);
  }
  vec3 lit = base * shade;
  if (uEdges) {
    // Distances from the edges, in pixels.
    vec2 w = max(fwidth(vShare), vec2(1e-5));
    float inside = isTriangle ? min(min(s / w.x, t / w.y), (1.0 - s - t) / max(fwidth(s + t), 1e-5))
      : min(min(s, 1.0 - s) / w.x, min(t, 1.0 - t) / w.y);
    float line = 1.0 - smoothstep(0.3, 1.1, inside);
    lit = mix(lit, uEdge, line * 0.55 * clamp(1.2 - 4.0 * max(w.x, w.y), 0.0, 1.0));
  }
  if (int(vFace.x) == uHover) lit = mix(lit, vec3(1.0, 0.72, 0.0), 0.75);
  color = vec4(lit, 1.0);
}`;

const LINE_VERTEX = COMMON + `
uniform usampler2D uLine;
uniform sampler2D uPalette;
uniform vec2 uPixel;
uniform float uWidth;
uniform vec3 uEdge;
out vec3 vColor;
void main() {
  uvec4 line = texelFetch(uLine, cell(uint(gl_VertexID / 6)), 0);
  int k = gl_VertexID % 6;
  vec4 a = uCamera * vec4(spot(line.x, place(line.x)), 1.0), b = uCamera * vec4(spot(line.y, place(line.y)), 1.0);
  vec2 along = (b.xy / b.w - a.xy / a.w) / uPixel;
  along = length(along) > 1e-6 ? normalize(along) : vec2(1.0, 0.0);
  bool isEnd = k == 1 || k == 2 || k == 4;
  float side = (k == 0 || k == 1 || k == 3) ? 1.0 : -1.0;
  vec4 at = isEnd ? b : a;
  // A little nearer than the surface that it lies on, and a little longer, so that joints close.
  at.xy += (vec2(-along.y, along.x) * side + along * (isEnd ? 0.5 : -0.5)) * uPixel * uWidth * at.w;
  at.z -= (uFlat ? 0.001 : 0.0012) * at.w;
  vColor = line.z == 0u ? uEdge : texelFetch(uPalette, ivec2(int(line.z - 1u) % 48, 0), 0).rgb;
  gl_Position = at;
}`;

const LINE_FRAGMENT = `#version 300 es
precision highp float;
in vec3 vColor;
out vec4 color;
void main() { color = vec4(vColor, 1.0); }`;
