// Which surfaces of a stream are simplified when: those of the first picture after they have been passed on, as the whole bone
// is to be seen soon, and later ones before.
import type { BlockSurface, MeshDelta } from './messages';
import type { Triple } from './pose';
import { simplifiedSurface } from './simplified_surface';

export { simplifierReady } from './simplified_surface';

/** Of one connection. */
export class SurfaceSimplifier {
  private first = true;
  /** Of the first picture, by block: what is still to be simplified, and what has become of the others. */
  private readonly waiting = new Map<number, BlockSurface>();
  private readonly simplified = new Map<number, BlockSurface>();

  constructor(private readonly voxelSpacingMm: Triple) {}

  /** What is to be passed on of a message. */
  passOn(mesh: MeshDelta): MeshDelta {
    for (const { block } of mesh.blocks) {
      this.waiting.delete(block);
      this.simplified.delete(block);
    }
    if (!this.first) return { ...mesh, blocks: mesh.blocks.map((block) => this.simplify(block)) };
    for (const surface of mesh.blocks) if (surface.indices.length > 0) this.waiting.set(surface.block, copyOf(surface));
    this.first = !mesh.keyComplete;
    return { ...mesh, simplerFollow: mesh.keyComplete && this.waiting.size > 0 };
  }

  /** Whether there is more for work() to do. */
  get works(): boolean {
    return !this.first && this.waiting.size > 0;
  }

  /**
   * Goes on with the first picture for about so long, once that is complete; when it is done, all surfaces of it that are of
   * fewer triangles now, else null.
   */
  work(ms: number): BlockSurface[] | null {
    if (this.first) return null;
    const until = performance.now() + ms;
    for (const [block, surface] of this.waiting) {
      if (performance.now() >= until) return null;
      this.waiting.delete(block);
      const simpler = this.simplify(surface);
      if (simpler !== surface) this.simplified.set(block, simpler);
    }
    const all = [...this.simplified.values()];
    this.simplified.clear();
    return all;
  }

  /** What cannot be simplified stays as it is: the bone is seen all the same. */
  private simplify(surface: BlockSurface): BlockSurface {
    try {
      return simplifiedSurface(surface, this.voxelSpacingMm);
    } catch {
      return surface;
    }
  }
}

/** What is passed on goes to another thread. */
const copyOf = (surface: BlockSurface): BlockSurface => ({
  ...surface,
  positions: surface.positions.slice(),
  normals: surface.normals.slice(),
  indices: surface.indices.slice(),
});
