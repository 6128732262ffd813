// Pieces of the body: undeformed places, fields of displacement, and what is drawn of them.
// Vertices are split where the faces around them meet at an angle, so that boxes are sharp and spheres smooth.
const CREASE = Math.cos((38 * Math.PI) / 180);
const COIL_STEPS = 14;
// Radius of points and lines over that of the body, where the model gives none.
const POINT = 0.03;
const LINE = 0.006;

class Piece {
  constructor(source, radius) {
    const usual = radius * (source.triangles ? 0 : source.lines ? LINE : POINT);
    Object.assign(this, { name: source.name, kind: source.kind, size: source.size ?? usual, turning: source.turning ?? null });
    this.rest = vectors(source.vertices);
    this.fields = (source.fields ?? []).map((field) => ({ coordinate: field.coordinate, vectors: vectors(field.vectors) }));
    this.curvatures = (source.curvatures ?? []).map((field) => ({ coordinates: field.coordinates, vectors: vectors(field.vectors) }));
    this.lines = indices(source.lines);
    const triangles = indices(source.triangles);
    if (this.kind === "spring" && this.lines?.length === 2 && !triangles && this.size > 0) this.coil();
    this.count = this.rest.length / 3;
    this.turnedRest = this.rest;
    this.places = Float32Array.from(this.rest);
    this.faces = triangles?.length ? new Faces(this.rest, triangles) : null;
    this.isPoints = !this.faces && !this.lines?.length;
  }

  /** Draws a spring of two ends as a coil; its fields are linear along the line. */
  coil() {
    const [from, to] = [0, 1].map((i) => vectorAt(this.rest, this.lines[i]));
    const along = plus(to, from, -1);
    const turns = clamp(Math.round(size(along) / (5 * this.size)), 5, 16);
    const count = turns * COIL_STEPS + 1;
    const [x, y] = [across(along), cross(unit(along), across(along))];
    const radius = Math.min(2.4 * this.size, 0.2 * size(along));
    const parts = Array.from({ length: count }, (_, i) => i / (count - 1));
    const rest = parts.flatMap((part) => {
      const angle = 2 * Math.PI * turns * part;
      const open = radius * clamp(20 * Math.min(part, 1 - part), 0, 1);
      return plus(plus(plus(from, along, part), x, open * Math.cos(angle)), y, open * Math.sin(angle));
    });
    const spread = (field) => {
      const [a, b] = [0, 1].map((i) => vectorAt(field.vectors, this.lines[i]));
      return { ...field, vectors: Float32Array.from(parts.flatMap((part) => plus(times(1 - part, a), b, part))) };
    };
    this.fields = this.fields.map(spread);
    this.curvatures = this.curvatures.map(spread);
    this.rest = Float32Array.from(rest);
    this.lines = Uint32Array.from(parts.slice(1).flatMap((_, i) => [i, i + 1]));
    this.size *= 0.45;
  }

  /** Largest displacement of a vertex with given internal coordinates. */
  largest(q) {
    this.move(q, null, 1);
    let largest = 0;
    for (let i = 0; i < this.count; i++) largest = Math.max(largest, this.displacement(i));
    return largest;
  }

  displacement(i) {
    return size(plus(vectorAt(this.places, i), vectorAt(this.turnedRest, i), -1));
  }

  /** Places with internal coordinates and rotor angles, the displacements magnified. */
  move(q, rotors, magnified) {
    const { places } = this;
    this.turnedRest = this.turned(rotors);
    places.set(this.turnedRest);
    if (q) {
      for (const { coordinate, vectors } of this.fields) this.addTo(places, magnified * q[coordinate], vectors);
      for (const { coordinates: [j, k], vectors } of this.curvatures) {
        this.addTo(places, 0.5 * magnified * q[j] * q[k], vectors);
      }
    }
  }

  addTo(places, factor, vectors) {
    if (!factor) return;
    for (let i = 0; i < vectors.length; i++) places[i] += factor * vectors[i];
  }

  turned(rotors) {
    const angle = this.turning && rotors ? rotors[this.turning.rotor] : 0;
    if (!angle) return this.rest;
    const { axis, center } = this.turning;
    const q = rotation(unit(axis), angle);
    const result = new Float32Array(this.rest.length);
    for (let i = 0; i < this.count; i++) {
      result.set(plus(turned(q, plus(vectorAt(this.rest, i), center, -1)), center), 3 * i);
    }
    return result;
  }

  middle() {
    const sum = [0, 0, 0];
    for (let i = 0; i < this.rest.length; i++) sum[i % 3] += this.rest[i] / this.count;
    return sum;
  }

  /** Whether the box around the piece holds a point. */
  holds(point) {
    return point.every((x, axis) => {
      let [low, high] = [Infinity, -Infinity];
      for (let i = axis; i < this.rest.length; i += 3) [low, high] = [Math.min(low, this.rest[i]), Math.max(high, this.rest[i])];
      return low < x && x < high;
    });
  }
}

/** Faces with split vertices: `source` names the vertex of each, `edges` the pairs of vertices along creases. */
class Faces {
  constructor(rest, triangles) {
    this.triangles = triangles;
    const normals = [];
    for (let f = 0; f < triangles.length; f += 3) normals.push(unit(this.normal(rest, triangles, f)));
    const around = Array.from({ length: rest.length / 3 }, () => []);
    triangles.forEach((vertex, corner) => around[vertex].push(corner));
    this.source = [];
    this.corners = new Uint32Array(triangles.length);
    around.forEach((corners, vertex) => this.split(vertex, corners, normals));
    this.source = Uint32Array.from(this.source);
    this.edges = this.creases(triangles, normals);
    this.data = new Float32Array(6 * this.source.length);
  }

  /** One split vertex for each group of faces that meet smoothly. */
  split(vertex, corners, normals) {
    const groups = [];
    for (const corner of corners) {
      const normal = normals[Math.floor(corner / 3)];
      let group = groups.find((known) => dot(known.normal, normal) > CREASE);
      if (!group) groups.push((group = { normal, index: this.source.push(vertex) - 1 }));
      this.corners[corner] = group.index;
    }
  }

  creases(triangles, normals) {
    const known = new Map();
    const edges = [];
    for (let corner = 0; corner < triangles.length; corner++) {
      const face = Math.floor(corner / 3);
      const [a, b] = [triangles[corner], triangles[3 * face + ((corner + 1) % 3)]];
      const key = Math.min(a, b) * 4294967296 + Math.max(a, b);
      if (!known.has(key)) known.set(key, { a, b, face });
      else {
        if (dot(normals[known.get(key).face], normals[face]) < CREASE) edges.push(a, b);
        known.set(key, { paired: true, face });
      }
    }
    for (const { a, b, paired } of known.values()) if (!paired) edges.push(a, b);
    return Uint32Array.from(edges);
  }

  normal(places, triangles, f) {
    const [a, b, c] = [0, 1, 2].map((i) => vectorAt(places, triangles[f + i]));
    return cross(plus(b, a, -1), plus(c, a, -1));
  }

  /** Places and normals of the split vertices, interleaved. */
  fill(places) {
    const { data, source, corners, triangles } = this;
    for (let i = 0; i < source.length; i++) {
      const from = 3 * source[i];
      const to = 6 * i;
      data[to] = places[from];
      data[to + 1] = places[from + 1];
      data[to + 2] = places[from + 2];
      data[to + 3] = data[to + 4] = data[to + 5] = 0;
    }
    for (let f = 0; f < triangles.length; f += 3) {
      const [a, b, c] = [3 * triangles[f], 3 * triangles[f + 1], 3 * triangles[f + 2]];
      const [ux, uy, uz] = [places[b] - places[a], places[b + 1] - places[a + 1], places[b + 2] - places[a + 2]];
      const [vx, vy, vz] = [places[c] - places[a], places[c + 1] - places[a + 1], places[c + 2] - places[a + 2]];
      const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
      for (let i = 0; i < 3; i++) {
        const to = 6 * corners[f + i];
        data[to + 3] += nx;
        data[to + 4] += ny;
        data[to + 5] += nz;
      }
    }
    return data;
  }
}
