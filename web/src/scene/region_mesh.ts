import {
  BufferAttribute,
  BufferGeometry,
  InterleavedBuffer,
  InterleavedBufferAttribute,
  type Material,
  Mesh,
} from 'three';

import type { BlockSurface } from '../wire/messages';
import type { BlockLayout } from './block_layout';
import { marksAttribute } from './cut_bone';
import { type GeometryPart, haveParts } from './line_hits';
import { shadowed } from './lights';

/** Values of a vertex in a block's buffers. */
const stride = 4;
/** The most vertices that short indices can name. */
const shortMost = 0xffff;

/** Blocks of a region that do not change any more, drawn at once: every mesh by itself takes as long as 500 triangles. */
export class RegionMesh {
  readonly mesh: Mesh;
  /** Where in the indices each block is. */
  private readonly parts = new Map<number, GeometryPart>();
  private leftOut = false;

  /** At least one surface, none empty, all of one region; what is drawn is copied. */
  constructor(layout: BlockLayout, surfaces: readonly BlockSurface[], material: Material) {
    const sum = (count: (surface: BlockSurface) => number) =>
      surfaces.reduce((total, surface) => total + count(surface), 0);
    const vertices = sum((surface) => surface.positions.length / stride);
    const indexCount = sum((surface) => surface.indices.length);
    const positions = new Float32Array(3 * vertices);
    const normals = new Int16Array(stride * vertices);
    const indices = vertices > shortMost ? new Uint32Array(indexCount) : new Uint16Array(indexCount);
    let vertex = 0;
    let start = 0;
    for (const surface of surfaces) {
      copyPositions(surface.positions, layout.stepsInRegion(surface.block).toArray(), positions, 3 * vertex);
      normals.set(surface.normals, stride * vertex);
      const count = surface.indices.length;
      for (let i = 0; i < count; ++i) indices[start + i] = (surface.indices[i] ?? 0) + vertex;
      this.parts.set(surface.block, { start, count, box: layout.blockBoxInRegion(surface.block) });
      vertex += surface.positions.length / stride;
      start += count;
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    const directions = new InterleavedBuffer(normals, stride);
    geometry.setAttribute('normal', new InterleavedBufferAttribute(directions, 3, 0, true));
    geometry.setAttribute(marksAttribute, new InterleavedBufferAttribute(directions, 1, 3));
    geometry.setIndex(new BufferAttribute(indices, 1));
    geometry.boundingSphere = layout.regionBall();
    haveParts(geometry, this.parts);
    this.mesh = shadowed(new Mesh(geometry, material));
    this.mesh.matrixAutoUpdate = false;
    this.mesh.matrix.copy(layout.gridFromRegionSteps(surfaces[0]?.block ?? 0));
  }

  /** Whether all that it was made of is drawn. */
  get whole(): boolean {
    return !this.leftOut;
  }

  /** A block that is drawn otherwise from here on, or not at all: all its corners fall into one. */
  leaveOut(block: number): void {
    const part = this.parts.get(block);
    const { index } = this.mesh.geometry;
    if (part === undefined || index === null) return;
    this.parts.delete(block);
    this.leftOut = true;
    (index.array as Uint16Array | Uint32Array).fill(0, part.start, part.start + part.count);
    index.addUpdateRange(part.start, part.count);
    index.needsUpdate = true;
  }

  dispose(): void {
    this.mesh.removeFromParent();
    this.mesh.geometry.dispose();
  }
}

function copyPositions(
  from: Uint16Array,
  [x, y, z]: readonly [number, number, number],
  to: Float32Array,
  begin: number,
): void {
  for (let at = 0, put = begin; at < from.length; at += stride) {
    to[put++] = (from[at] ?? 0) + x;
    to[put++] = (from[at + 1] ?? 0) + y;
    to[put++] = (from[at + 2] ?? 0) + z;
  }
}
