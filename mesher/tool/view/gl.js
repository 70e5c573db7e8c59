// WebGL 2: programs, and colours that both views use.

export function make_program(gl, vertex, fragment) {
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, '#version 300 es\nprecision highp float;\n' + text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) {
      throw new Error(gl.getShaderInfoLog(shader));
    }
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    throw new Error(gl.getProgramInfoLog(program));
  }
  const at = {program};
  const uniforms = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS);
  for (let i = 0; i < uniforms; ++i) {
    const {name} = gl.getActiveUniform(program, i);
    at[name] = gl.getUniformLocation(program, name);
  }
  return at;
}

// How much of a line at the edge of a triangle a pixel has; `side` is 1 at one corner each, lines of
// small triangles are faint.
export const LINE = `
float line_at(vec3 side, float from, float to, float least) {
  vec3 steps = fwidth(side);
  vec3 away = side / steps;
  float line = 1. - smoothstep(from, to, min(away.x, min(away.y, away.z)));
  return line * clamp(1. / max(steps.x, max(steps.y, steps.z)) / 8., least, 1.);
}`;

// A size as 14 bits: its octaves below the box around the mesh, in parts of 1/256. It does not depend
// on the sizes that there are, which change; the scale of colours does.
const kSizeOctaves = 64, kSizeSteps = 256;
function size_code(mesh, measure) {
  const code = Math.round((measure - mesh.box_measure + kSizeOctaves) * kSizeSteps);
  return Math.min(kSizeOctaves * kSizeSteps - 1, Math.max(0, code));
}

// Puts what `colour` reads, for a slot, at four bytes. `best`: the best angle.
export function put_judged(octets, at, mesh, s, marks, best) {
  const size = size_code(mesh, mesh.measure[s]);
  octets[at] = Math.min(255, mesh.angle[s] * 255 / best);
  octets[at + 1] = size >> 6;
  octets[at + 2] = mesh.labels[s];
  octets[at + 3] = marks | (size & 63) << 2;
}

const MODES = ['region', 'quality', 'size'];
export function set_colours(gl, at, mesh, mode) {
  gl.uniform1i(at.mode, MODES.indexOf(mode));
  gl.uniform2fv(at.sizes, mesh.sizes().map((size) => size_code(mesh, size)));
}

// `judged`: quality; the high 8 bits of the size; the region; marks (bits: 1 poor, 2 forced or
// sliver) and above them the low 6 bits of the size. `sizes`: the scale of sizes.
export const COLOUR = `
uniform int mode; uniform vec2 sizes;
vec3 ramp(float t) {
  vec3 low = vec3(.80, .16, .12), middle = vec3(.97, .84, .45), high = vec3(.80, .90, .93);
  return t < .5 ? mix(low, middle, t * 2.) : mix(middle, high, t * 2. - 1.);
}
vec3 depth(float t) {
  vec3 low = vec3(.16, .23, .48), middle = vec3(.20, .60, .57), high = vec3(.97, .94, .72);
  return t < .5 ? mix(low, middle, t * 2.) : mix(middle, high, t * 2. - 1.);
}
vec3 region(float label) {
  if (label < .5) return vec3(.94, .94, .93);
  if (label < 1.5) return vec3(.87, .91, .96);
  float h = fract(label * .381966) * 6.;
  vec3 c = clamp(abs(mod(h + vec3(0., 4., 2.), 6.) - 3.) - 1., 0., 1.);
  return mix(vec3(1.), c, .30) * .97;
}
vec3 colour(vec4 judged) {
  int marks = int(judged.w + .5) & 3;
  float size = judged.y * 64. + float(int(judged.w + .5) >> 2);
  if ((marks & 2) != 0) return vec3(.78, .10, .50);
  if ((marks & 1) != 0) return vec3(.90, .25, .15);
  if (mode == 1) return judged.z < .5 ? region(0.) : ramp(judged.x / 255.);
  float in_scale = clamp((size - sizes.x) / max(sizes.y - sizes.x, 1.), 0., 1.);
  if (mode == 2) return judged.z < .5 ? region(0.) : depth(in_scale);
  return region(judged.z);
}
`;
export const LEGENDS = {
  region: 'linear-gradient(90deg, #dee8f5, #dee8f5)',
  quality: 'linear-gradient(90deg, #cc291f, #f7d673, #cce6ed)',
  size: 'linear-gradient(90deg, #293b7a, #339991, #f7f0b8)',
};
