import { BufferAttribute, BufferGeometry, type Color } from 'three';

/** A coloured surface of rings of as many points each. */
export class RingSurface {
  private readonly positions: number[] = [];
  private readonly colours: number[] = [];
  private rings = 0;

  constructor(private readonly around: number) {}

  /** The next ring; `light` is how much of its colour is seen. */
  add(
    point: (angle: number, i: number) => { at: readonly [number, number, number]; colour: Color; light: number },
  ): void {
    for (let i = 0; i < this.around; ++i) {
      const { at, colour, light } = point((2 * Math.PI * i) / this.around, i);
      this.positions.push(...at);
      this.colours.push(light * colour.r, light * colour.g, light * colour.b);
    }
    ++this.rings;
  }

  /** Seen from where rings that widen from one to the next go around counter-clockwise. */
  geometry(): BufferGeometry {
    const { around, rings } = this;
    const indices: number[] = [];
    for (let ring = 1; ring < rings; ++ring)
      for (let i = 0; i < around; ++i) {
        const [next, below, above] = [(i + 1) % around, (ring - 1) * around, ring * around];
        indices.push(below + i, above + i, above + next, below + i, above + next, below + next);
      }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(this.positions), 3));
    geometry.setAttribute('color', new BufferAttribute(new Float32Array(this.colours), 3));
    geometry.setIndex(indices);
    geometry.computeVertexNormals();
    return geometry;
  }
}
