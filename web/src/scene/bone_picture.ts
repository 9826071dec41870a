import {
  BufferAttribute,
  BufferGeometry,
  Group,
  InterleavedBuffer,
  InterleavedBufferAttribute,
  type Material,
  Mesh,
} from 'three';

import type { BlockSurface, Hello } from '../wire/messages';
import { BlockLayout } from './block_layout';
import { marksAttribute } from './cut_bone';
import { RegionMesh } from './region_mesh';
import { shadowed } from './lights';
import { poseMatrix } from './pose_matrix';

/** What did not change for so long has come to rest. */
const settlesAfterMs = 1500;
/** A region is put together before all of it rests once so many of its blocks do; each time, all that rest are copied. */
const manyBlocks = 16;

interface ShownBlock {
  region: number;
  surface: BlockSurface;
  /** Of its own; null: it is drawn with its region. */
  mesh: Mesh | null;
  changedMs: number;
}

/**
 * One whole picture of the bone. What changes is drawn block by block, what has come to rest by regions. Times are of any
 * clock, ms.
 */
export class BonePicture {
  readonly group = new Group();
  private readonly layout: BlockLayout;
  private readonly blocks = new Map<number, ShownBlock>();
  private readonly regions = new Map<number, RegionMesh>();
  /** Regions that have blocks with a mesh of their own, or have lost blocks, and when they changed last. */
  private readonly unsettled = new Map<number, number>();

  constructor(
    hello: Hello,
    private readonly material: Material,
  ) {
    this.layout = new BlockLayout(hello);
    this.group.matrixAutoUpdate = false;
    this.group.matrix.copy(poseMatrix(hello.worldFromGrid));
  }

  get blockCount(): number {
    return this.blocks.size;
  }

  /** Replaces a block unless a newer revision of it is shown. */
  apply(surface: BlockSurface, nowMs: number): void {
    const { block } = surface;
    const shown = this.blocks.get(block);
    if (shown !== undefined && shown.surface.revision > surface.revision) return;
    const region = this.layout.regionOf(block);
    this.regions.get(region)?.leaveOut(block);
    disposeOf(shown?.mesh);
    this.blocks.delete(block);
    const empty = surface.indices.length === 0;
    if (shown !== undefined || !empty) this.unsettled.set(region, nowMs);
    if (empty) return;
    const mesh = shadowed(new Mesh(this.geometry(surface), this.material));
    mesh.matrixAutoUpdate = false;
    mesh.matrix.copy(this.layout.gridFromBlockSteps(block));
    this.group.add(mesh);
    this.blocks.set(block, { region, surface, mesh, changedMs: nowMs });
  }

  /** Nothing more comes of a first picture: all of it has come to rest. */
  whole(): void {
    for (const shown of this.blocks.values()) shown.changedMs = -Infinity;
    for (const region of this.unsettled.keys()) this.unsettled.set(region, -Infinity);
  }

  /** Whether anything is still drawn block by block, or is kept that is not seen any more. */
  get restless(): boolean {
    return this.unsettled.size > 0;
  }

  /** Draws together what has come to rest, of one region at each call; false: there is nothing more. */
  settleOne(nowMs: number): boolean {
    const rests = (changedMs: number) => nowMs - changedMs >= settlesAfterMs;
    for (const [region, changedMs] of this.unsettled) {
      const resting = [...this.blocks.values()].filter((shown) => shown.region === region && rests(shown.changedMs));
      const apart = resting.filter(({ mesh }) => mesh !== null).length;
      if (!rests(changedMs) && apart < manyBlocks) continue;
      if (rests(changedMs)) this.unsettled.delete(region);
      if (apart === 0 && this.regions.get(region)?.whole !== false) continue;
      this.settle(region, resting);
      return true;
    }
    return false;
  }

  dispose(): void {
    this.group.removeFromParent();
    for (const { mesh } of this.blocks.values()) disposeOf(mesh);
    for (const region of this.regions.values()) region.dispose();
    this.blocks.clear();
    this.regions.clear();
    this.unsettled.clear();
  }

  private settle(region: number, resting: ShownBlock[]): void {
    this.regions.get(region)?.dispose();
    this.regions.delete(region);
    if (resting.length === 0) return;
    const together = new RegionMesh(
      this.layout,
      resting.map(({ surface }) => surface),
      this.material,
    );
    this.regions.set(region, together);
    this.group.add(together.mesh);
    for (const shown of resting) {
      disposeOf(shown.mesh);
      shown.mesh = null;
    }
  }

  private geometry(surface: BlockSurface): BufferGeometry {
    const geometry = new BufferGeometry();
    const positions = new InterleavedBuffer(surface.positions, 4);
    const normals = new InterleavedBuffer(surface.normals, 4);
    geometry.setAttribute('position', new InterleavedBufferAttribute(positions, 3, 0));
    geometry.setAttribute('normal', new InterleavedBufferAttribute(normals, 3, 0, true));
    geometry.setAttribute(marksAttribute, new InterleavedBufferAttribute(normals, 1, 3));
    geometry.setIndex(new BufferAttribute(surface.indices, 1));
    geometry.boundingSphere = this.layout.blockBall();
    return geometry;
  }
}

function disposeOf(mesh: Mesh | null | undefined): void {
  mesh?.removeFromParent();
  mesh?.geometry.dispose();
}
