// Draws the pieces of the body, arrows and axes: first what is solid, then what is seen through, far faces before near.
const CORNERS = new Float32Array([0, -1, 1, -1, 0, 1, 1, 1]);
const SQUARE = new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]);
const CONE_SIDES = 28;

class Stage {
  constructor(gl) {
    this.gl = gl;
    this.face = glProgram(gl, FACE_VERTEX, FACE_FRAGMENT);
    this.line = glProgram(gl, LINE_VERTEX, LINE_FRAGMENT);
    this.point = glProgram(gl, POINT_VERTEX, POINT_FRAGMENT);
    this.corners = this.buffer(CORNERS);
    this.square = this.buffer(SQUARE);
    this.strokes = this.segments();
    this.cone = gl.createBuffer();
    this.cones = glArrays(gl, this.faceLayout(this.cone));
  }

  buffer(data) {
    const buffer = this.gl.createBuffer();
    glFill(this.gl, buffer, data, this.gl.STATIC_DRAW);
    return buffer;
  }

  faceLayout(buffer) {
    return [
      { location: 0, width: 3, buffer, stride: 6 },
      { location: 1, width: 3, buffer, stride: 6, offset: 3 },
    ];
  }

  /** Instances of line segments, with their buffer. */
  segments() {
    const buffer = this.gl.createBuffer();
    const ends = [0, 3].map((offset, i) => ({ location: i + 1, width: 3, buffer, stride: 6, offset, instanced: true }));
    return { buffer, arrays: glArrays(this.gl, [{ location: 0, width: 2, buffer: this.corners }, ...ends]) };
  }

  /** The drawable of a piece. */
  upload(piece) {
    const { gl } = this;
    const drawn = { piece };
    if (piece.faces) {
      drawn.faceBuffer = gl.createBuffer();
      drawn.faces = glArrays(gl, this.faceLayout(drawn.faceBuffer), piece.faces.corners);
      if (piece.faces.edges.length) drawn.edges = this.segments();
    }
    if (piece.lines?.length) drawn.lines = this.segments();
    if (piece.isPoints) {
      drawn.pointBuffer = gl.createBuffer();
      const center = { location: 1, width: 3, buffer: drawn.pointBuffer, instanced: true };
      drawn.points = glArrays(gl, [{ location: 0, width: 2, buffer: this.square }, center]);
    }
    return drawn;
  }

  /** Sends the places of a piece, as they are now. */
  refresh({ piece, faceBuffer, edges, lines, pointBuffer }) {
    const { gl } = this;
    const ends = (pairs) => {
      const data = new Float32Array(3 * pairs.length);
      pairs.forEach((vertex, i) => data.set(piece.places.subarray(3 * vertex, 3 * vertex + 3), 3 * i));
      return data;
    };
    if (faceBuffer) glFill(gl, faceBuffer, piece.faces.fill(piece.places));
    if (edges) glFill(gl, edges.buffer, ends(piece.faces.edges));
    if (lines) glFill(gl, lines.buffer, ends(piece.lines));
    if (pointBuffer) glFill(gl, pointBuffer, piece.places);
  }

  begin(paper, view, projection, pixel) {
    const { gl } = this;
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.clearColor(...paper, 1);
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    this.frame = { view, projection };
    this.pixel = pixel;
  }

  use(program, color, alpha, glow, rest = {}) {
    this.gl.useProgram(program.program);
    setUniforms(this.gl, program, { ...this.frame, color, alpha, glow, ...rest });
  }

  /** Draws a piece with a colour, seen through where alpha is below one. */
  draw(drawn, { color, edge, alpha, glow }) {
    const { gl } = this;
    const { piece } = drawn;
    const clear = alpha < 1;
    gl.depthMask(!clear);
    if (clear) gl.enable(gl.BLEND);
    else gl.disable(gl.BLEND);
    if (drawn.faces) {
      gl.bindVertexArray(drawn.faces);
      this.use(this.face, color, alpha, glow);
      const count = piece.faces.corners.length;
      if (clear) {
        gl.enable(gl.CULL_FACE);
        for (const side of [gl.FRONT, gl.BACK]) {
          gl.cullFace(side);
          gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 0);
        }
        gl.disable(gl.CULL_FACE);
      } else {
        gl.enable(gl.POLYGON_OFFSET_FILL);
        gl.polygonOffset(1, 2);
        gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 0);
        gl.disable(gl.POLYGON_OFFSET_FILL);
      }
    }
    const edgeAlpha = clear ? 0.7 : 1;
    if (drawn.edges) this.drawSegments(drawn.edges.arrays, piece.faces.edges.length / 2, edge, 0, 0.7, edgeAlpha, glow);
    if (drawn.lines) this.drawSegments(drawn.lines.arrays, piece.lines.length / 2, color, piece.size, 0.9, alpha, glow);
    if (drawn.points) this.drawPoints(drawn.points, piece, color, alpha, glow);
    gl.bindVertexArray(null);
  }

  drawSegments(arrays, count, color, radius, thinnest, alpha, glow) {
    this.gl.bindVertexArray(arrays);
    this.use(this.line, color, alpha, glow, { radius, pixel: this.pixel, thinnest });
    this.gl.drawArraysInstanced(this.gl.TRIANGLE_STRIP, 0, 4, count);
  }

  drawPoints(arrays, piece, color, alpha, glow) {
    const { gl } = this;
    gl.enable(gl.SAMPLE_ALPHA_TO_COVERAGE);
    gl.bindVertexArray(arrays);
    this.use(this.point, color, alpha, glow, { radius: piece.size, pixel: this.pixel, thinnest: 3 });
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, piece.count);
    gl.disable(gl.SAMPLE_ALPHA_TO_COVERAGE);
  }

  /** Draws a line through given points, of a radius in pixels. */
  stroke(points, color, thinnest) {
    const { gl } = this;
    gl.disable(gl.BLEND);
    gl.depthMask(true);
    glFill(gl, this.strokes.buffer, Float32Array.from(points.slice(1).flatMap((point, i) => [...points[i], ...point])));
    this.drawSegments(this.strokes.arrays, points.length - 1, color, 0, thinnest, 1, 0);
    gl.bindVertexArray(null);
  }

  /** Draws an arrow between two points on a line through the origin. */
  arrow(tail, tip, radius, color) {
    const { gl } = this;
    const shaft = plus(tip, tail, -1);
    const direction = unit(shaft);
    const head = Math.min(7 * radius, 0.5 * size(shaft));
    const base = plus(tip, direction, -head);
    gl.disable(gl.BLEND);
    gl.depthMask(true);
    glFill(gl, this.strokes.buffer, Float32Array.from([...tail, ...base]));
    this.drawSegments(this.strokes.arrays, 1, color, radius, 1, 1, 0);
    glFill(gl, this.cone, cone(base, direction, head, 0.36 * head));
    gl.bindVertexArray(this.cones);
    this.use(this.face, color, 1, 0);
    gl.drawArrays(gl.TRIANGLES, 0, 6 * CONE_SIDES);
    gl.bindVertexArray(null);
  }
}

/** Triangles of a cone with its base, places and normals interleaved. */
const cone = (base, direction, length, radius) => {
  const [x, y] = [across(direction), cross(direction, across(direction))];
  const tip = plus(base, direction, length);
  const data = [];
  for (let i = 0; i < CONE_SIDES; i++) {
    const spoke = (k) => {
      const angle = (2 * Math.PI * k) / CONE_SIDES;
      return plus(times(Math.cos(angle), x), y, Math.sin(angle));
    };
    const normal = (k) => unit(plus(times(length, spoke(k)), direction, radius));
    const rim = (k) => plus(base, spoke(k), radius);
    data.push(...tip, ...normal(i + 0.5), ...rim(i), ...normal(i), ...rim(i + 1), ...normal(i + 1));
    for (const place of [base, rim(i), rim(i + 1)]) data.push(...place, ...times(-1, direction));
  }
  return Float32Array.from(data);
};
