// A camera that circles the body: azimuth, elevation and distance, with a chosen direction upwards.
const FIELD_OF_VIEW = (30 * Math.PI) / 180;
const FAR = 1.5; // radii of the body that fit into the picture
const START = { azimuth: -0.62, elevation: 0.38, zoom: 1 };

class Camera {
  constructor(radius) {
    this.radius = radius;
    this.reset();
  }

  reset() {
    Object.assign(this, START);
  }

  turn(azimuth, elevation) {
    this.azimuth += azimuth;
    this.elevation = clamp(this.elevation + elevation, -Math.PI / 2, Math.PI / 2);
  }

  closer(factor) {
    this.zoom = clamp(this.zoom * factor, 0.3, 12);
  }

  /** Matrices for a picture of a given shape; `up` points upwards, in the components that `attitude` turns into. */
  matrices(attitude, up, aspect) {
    const distance = (FAR * this.radius) / Math.sin(FIELD_OF_VIEW / 2) / this.zoom / Math.min(1, aspect);
    const upright = dot(up, [0, 0, 1]) < -0.999999 ? [0, 1, 0, 0] : shortest(up, [0, 0, 1]);
    const around = rotation([0, 0, 1], this.azimuth);
    const down = rotation([1, 0, 0], this.elevation - Math.PI / 2);
    this.orientation = product(product(product(down, around), upright), attitude);
    const view = matrixOf(this.orientation, [0, 0, -distance]);
    const near = Math.max(0.05 * distance, distance - 3 * this.radius);
    const projection = perspective(FIELD_OF_VIEW, aspect, near, distance + 3 * this.radius);
    this.distance = distance;
    return { view, projection, both: matrixProduct(projection, view) };
  }

  /** Place in the picture, from 0 to 1 rightwards and downwards. */
  static spot(both, [x, y, z]) {
    const row = (r) => both[r] * x + both[4 + r] * y + both[8 + r] * z + both[12 + r];
    const w = row(3);
    return [0.5 + (0.5 * row(0)) / w, 0.5 - (0.5 * row(1)) / w];
  }

  /** Ray through a place in the picture, in the components of the body: eye and direction. */
  ray(across, down, aspect) {
    const t = Math.tan(FIELD_OF_VIEW / 2);
    const seen = [(2 * across - 1) * t * aspect, (1 - 2 * down) * t, -1];
    const back = inverse(this.orientation);
    return { eye: turned(back, [0, 0, this.distance]), direction: unit(turned(back, seen)) };
  }
}
