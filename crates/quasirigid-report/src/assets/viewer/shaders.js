// Shaders in view space: faces, lines as lit cylinders that face the viewer, and points as exact spheres.
// The light moves with the camera, from above on the left, so that no view is dark.
const LIGHT = `
uniform vec3 color;
uniform float alpha;
uniform float glow;
out vec4 shade;
vec4 lit(vec3 n, vec3 place) {
  vec3 towards = normalize(-place);
  if (dot(n, towards) < 0.0) n = -n;
  vec3 key = normalize(vec3(-0.45, 0.8, 0.62));
  float wrapped = 0.5 + 0.5 * dot(n, key);
  float fill = max(dot(n, normalize(vec3(0.8, -0.1, 0.45))), 0.0);
  float light = 0.56 + 0.46 * wrapped * wrapped + 0.1 * fill;
  float spark = 0.10 * pow(max(dot(n, normalize(key + towards)), 0.0), 28.0);
  return vec4(mix(color * light + spark, vec3(1.0), 0.32 * glow), alpha);
}`;

const FACE_VERTEX = `
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 view, projection;
out vec3 place, across;
void main() {
  place = (view * vec4(position, 1.0)).xyz;
  across = mat3(view) * normal;
  gl_Position = projection * vec4(place, 1.0);
}`;
const FACE_FRAGMENT = `${LIGHT}
in vec3 place, across;
void main() { shade = lit(normalize(across), place); }`;

// `pixel` is the size of a pixel at unit distance, `thinnest` the least radius in pixels.
const LINE_VERTEX = `
layout(location = 0) in vec2 corner;
layout(location = 1) in vec3 a;
layout(location = 2) in vec3 b;
uniform mat4 view, projection;
uniform float radius, pixel, thinnest;
out vec3 place, side, front;
out float offset;
void main() {
  vec3 p = (view * vec4(a, 1.0)).xyz, q = (view * vec4(b, 1.0)).xyz;
  vec3 along = normalize(q - p + vec3(1e-20));
  side = normalize(cross(along, -(p + q)) + vec3(1e-20));
  front = cross(side, along);
  place = mix(p, q, corner.x);
  float r = max(radius, -place.z * pixel * thinnest);
  place += side * corner.y * r + along * (2.0 * corner.x - 1.0) * 0.5 * r;
  offset = corner.y;
  gl_Position = projection * vec4(place, 1.0);
}`;
const LINE_FRAGMENT = `${LIGHT}
in vec3 place, side, front;
in float offset;
void main() { shade = lit(normalize(side * offset + front * sqrt(max(0.0, 1.0 - offset * offset))), place); }`;

const POINT_VERTEX = `
layout(location = 0) in vec2 corner;
layout(location = 1) in vec3 center;
uniform mat4 view, projection;
uniform float radius, pixel, thinnest;
out vec3 middle, right, up;
out vec2 offset;
out float size;
void main() {
  middle = (view * vec4(center, 1.0)).xyz;
  size = max(radius, -middle.z * pixel * thinnest);
  vec3 towards = normalize(-middle);
  right = normalize(cross(vec3(0.0, 1.0, 0.0), towards));
  up = cross(towards, right);
  offset = 1.1 * corner;
  gl_Position = projection * vec4(middle + size * (right * offset.x + up * offset.y), 1.0);
}`;
const POINT_FRAGMENT = `${LIGHT}
uniform mat4 projection;
in vec3 middle, right, up;
in vec2 offset;
in float size;
void main() {
  float d = length(offset);
  float cover = clamp((1.0 - d) / fwidth(d) + 0.5, 0.0, 1.0);
  if (cover == 0.0) discard;
  vec3 n = right * offset.x + up * offset.y + normalize(-middle) * sqrt(max(0.0, 1.0 - d * d));
  vec3 place = middle + size * n;
  vec4 clip = projection * vec4(place, 1.0);
  gl_FragDepth = 0.5 * clip.z / clip.w + 0.5;
  shade = lit(n, place);
  shade.a *= cover;
}`;
