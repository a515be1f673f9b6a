// What the shaders of all pieces share: a vertex finds its piece, the piece its pose, and the pose moves the vertex.

/** Declarations and functions for the vertex shader; see docs/live-view-format.md for the layout of the two tables. */
export const POSE_FUNCTIONS = /* glsl */ `
uniform highp usampler2D poseTable;
uniform highp sampler2D pieceTable;
uniform float frame;
uniform float frameRate;
attribute float piece;

vec4 pieceCell(int number, int cell) {
  return texelFetch(pieceTable, ivec2((number % PIECES_A_ROW) * 4 + cell, number / PIECES_A_ROW), 0);
}

uvec3 poseWords(int place) {
  ivec2 at = ivec2(3 * (place % POSES_A_ROW), place / POSES_A_ROW);
  return uvec3(
    texelFetch(poseTable, at, 0).x,
    texelFetch(poseTable, at + ivec2(1, 0), 0).x,
    texelFetch(poseTable, at + ivec2(2, 0), 0).x
  );
}

vec4 turnOf(uvec3 words) {
  vec3 t = (vec3((words >> 18u) & 8191u) / 8191.0 * 2.0 - 1.0) * 0.70710678;
  float rest = sqrt(max(0.0, 1.0 - dot(t, t)));
  uint leftOut = (words.x >> 31u) | ((words.y >> 31u) << 1u);
  // x y z w from the order w x y z, in which one component is left out.
  if (leftOut == 0u) return vec4(t.x, t.y, t.z, rest);
  if (leftOut == 1u) return vec4(rest, t.y, t.z, t.x);
  if (leftOut == 2u) return vec4(t.y, rest, t.z, t.x);
  return vec4(t.y, t.z, rest, t.x);
}

vec3 turned(vec4 q, vec3 v) {
  return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v);
}

struct Pose { vec3 position; vec4 turn; float speed; float size; vec4 look; };

Pose poseOf(float which) {
  int number = int(which + 0.5);
  vec4 low = pieceCell(number, 0);
  vec4 size = pieceCell(number, 1);
  vec4 run = pieceCell(number, 2);
  float before = floor(frame);
  float share = frame - before;
  float arrival = low.w * frameRate;
  // A piece that the front sets off between two frames begins to move then, not at the frame before.
  if (run.x == before && arrival > before && arrival < before + 1.0) {
    share = max(0.0, (frame - arrival) / (before + 1.0 - arrival));
  }
  int offset = int(size.w + 0.5);
  uvec3 a = poseWords(offset + int(clamp(before - run.x, 0.0, run.y - 1.0)));
  uvec3 b = poseWords(offset + int(clamp(before + 1.0 - run.x, 0.0, run.y - 1.0)));
  vec3 from = low.xyz + vec3(a & 262143u) / 262143.0 * size.xyz;
  vec3 to = low.xyz + vec3(b & 262143u) / 262143.0 * size.xyz;
  vec4 first = turnOf(a);
  vec4 second = turnOf(b);
  if (dot(first, second) < 0.0) second = -second;
  Pose pose;
  pose.position = mix(from, to, share);
  pose.turn = normalize(mix(first, second, share));
  pose.speed = length(to - from) * frameRate;
  pose.look = run;
  // What is not to be seen yet, or no longer, shrinks to a point.
  vec2 shown = pieceCell(number, 3).xy;
  float time = frame / frameRate;
  pose.size = time >= shown.x && time < shown.y ? 1.0 : 0.0;
  return pose;
}
`;

/** Sets a vertex in place in any of three's own materials. */
export const PLACED = /* glsl */ `
Pose pose = poseOf(piece);
vec3 transformed = turned(pose.turn, pose.size * position) + pose.position;
`;

/** As PLACED, for the materials that also need the normal, which they ask for first. */
export const PLACED_NORMAL = /* glsl */ `
Pose pose = poseOf(piece);
vec3 objectNormal = turned(pose.turn, normal);
`;
