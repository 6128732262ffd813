// The piece under the pointer, and the vertex of it that is nearest.
const alongRay = ({ eye, direction }, place) => {
  const from = plus(place, eye, -1);
  const depth = dot(from, direction);
  return { depth, distance: size(plus(from, direction, -depth)) };
};

/** Depth at which a ray meets a triangle, or infinity. */
const meeting = ({ eye, direction }, a, b, c) => {
  const [u, v] = [plus(b, a, -1), plus(c, a, -1)];
  const p = cross(direction, v);
  const determinant = dot(u, p);
  if (determinant === 0) return Infinity;
  const s = plus(eye, a, -1);
  const x = dot(s, p) / determinant;
  const q = cross(s, u);
  const y = dot(direction, q) / determinant;
  return x < 0 || y < 0 || x + y > 1 ? Infinity : dot(v, q) / determinant;
};

/** Depth at which a ray first meets a piece; lines and points are met within `slack` times the depth. */
const depthOf = (piece, ray, slack) => {
  let nearest = Infinity;
  const at = (i) => vectorAt(piece.places, i);
  const near = (place) => {
    const { depth, distance } = alongRay(ray, place);
    if (distance < Math.max(piece.size, slack * depth)) nearest = Math.min(nearest, depth - piece.size);
  };
  if (piece.faces) {
    const { triangles } = piece.faces;
    for (let f = 0; f < triangles.length; f += 3) {
      nearest = Math.min(nearest, meeting(ray, at(triangles[f]), at(triangles[f + 1]), at(triangles[f + 2])));
    }
  }
  for (let i = 0; i < (piece.lines?.length ?? 0); i += 2) {
    const [a, b] = [at(piece.lines[i]), at(piece.lines[i + 1])];
    for (let k = 0; k <= 8; k++) near(plus(times(1 - k / 8, a), b, k / 8));
  }
  if (piece.isPoints) for (let i = 0; i < piece.count; i++) near(at(i));
  return nearest;
};

const picked = (pieces, ray, slack) => {
  const found = pieces.map((piece) => ({ piece, depth: depthOf(piece, ray, slack) })).filter(({ depth }) => depth < Infinity);
  if (!found.length) return null;
  // What lies inside another piece is meant before its hull, which is seen through.
  const solid = found.filter(({ piece }) => !piece.seenThrough);
  const { piece, depth } = (solid.length ? solid : found).reduce((a, b) => (b.depth < a.depth ? b : a));
  const place = plus(ray.eye, ray.direction, depth);
  let vertex = 0;
  let best = Infinity;
  for (let i = 0; i < piece.count; i++) {
    const distance = size(plus(vectorAt(piece.places, i), place, -1));
    if (distance < best) [best, vertex] = [distance, i];
  }
  return { piece, vertex };
};
