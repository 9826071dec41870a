import { Box3, Matrix4, Quaternion, Sphere, Vector3 } from 'three';

import type { Hello } from '../wire/messages';

/** Steps of a block's vertex positions in one voxel. */
const stepsPerVoxel = 1024;
/** A region is so many blocks long, wide and high. */
const regionEdgeBlocks = 4;

/** Where the blocks of a surface lie in the grid, and the regions that they make up. */
export class BlockLayout {
  private readonly blocks: Vector3;

  constructor(private readonly hello: Hello) {
    const [x, y, z] = hello.gridDims;
    // Not by divideScalar(), which multiplies by 1 / edge: 525 voxels would make 8 blocks of 75.
    const along = (voxels: number) => Math.ceil(voxels / hello.blockEdgeVoxels);
    this.blocks = new Vector3(along(x), along(y), along(z));
  }

  /** Which region a block belongs to. */
  regionOf(block: number): number {
    const at = this.placeOf(block).divideScalar(regionEdgeBlocks).floor();
    const regions = this.blocks.clone().divideScalar(regionEdgeBlocks).ceil();
    return at.x + regions.x * (at.y + regions.y * at.z);
  }

  /** From the vertex steps of a block to those of its region, whose steps are as long; whole numbers. */
  stepsInRegion(block: number): Vector3 {
    const at = this.placeOf(block);
    const first = this.firstOfRegion(at);
    return at.sub(first).multiplyScalar(this.hello.blockEdgeVoxels * stepsPerVoxel);
  }

  /** mm in the grid frame from a block's vertex steps, which begin one voxel before the block. */
  gridFromBlockSteps(block: number): Matrix4 {
    return this.gridFromSteps(this.placeOf(block));
  }
  /** The same of the region that a block belongs to. */
  gridFromRegionSteps(block: number): Matrix4 {
    return this.gridFromSteps(this.firstOfRegion(this.placeOf(block)));
  }

  /** All that a block can hold, in its steps. */
  blockBall(): Sphere {
    return this.ball(1);
  }
  regionBall(): Sphere {
    return this.ball(regionEdgeBlocks);
  }

  /** All that a block can hold and a little more, in the steps of its region. */
  blockBoxInRegion(block: number): Box3 {
    const begin = this.stepsInRegion(block);
    return new Box3(begin, begin.clone().addScalar(this.stepsAlong(1))).expandByScalar(1);
  }

  /** A voxel more than so many blocks at both ends. */
  private stepsAlong(edgeBlocks: number): number {
    return (edgeBlocks * this.hello.blockEdgeVoxels + 2) * stepsPerVoxel;
  }

  private ball(edgeBlocks: number): Sphere {
    const halfEdge = this.stepsAlong(edgeBlocks) / 2;
    return new Sphere(new Vector3(halfEdge, halfEdge, halfEdge), halfEdge * Math.sqrt(3));
  }

  /** Counted in blocks. */
  private placeOf(block: number): Vector3 {
    const { x: alongX, y: alongY } = this.blocks;
    return new Vector3(block % alongX, Math.floor(block / alongX) % alongY, Math.floor(block / (alongX * alongY)));
  }

  private firstOfRegion(place: Vector3): Vector3 {
    return place.clone().divideScalar(regionEdgeBlocks).floor().multiplyScalar(regionEdgeBlocks);
  }

  private gridFromSteps(firstBlock: Vector3): Matrix4 {
    const spacing = new Vector3(...this.hello.voxelSpacingMm);
    const origin = firstBlock.clone().multiplyScalar(this.hello.blockEdgeVoxels).addScalar(-1).multiply(spacing);
    return new Matrix4().compose(origin, new Quaternion(), spacing.divideScalar(stepsPerVoxel));
  }
}
