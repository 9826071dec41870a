import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import { BlockLayout } from '../../src/scene/block_layout';
import type { Hello } from '../../src/wire/messages';
import { hello } from '../wire/fake_messages';

const edgesAndBlocks = [75, 77, 91, 93, 99, 105, 117, 123].map((edge) => ({ edge, blocks: 7 }));

function layout(overrides: Partial<Hello>): BlockLayout {
  const message = hello({ voxelSpacingMm: [1, 1, 1], ...overrides });
  if (message.kind !== 'hello') throw new Error('not a hello');
  return new BlockLayout(message.hello);
}

/** Where a block begins, in voxels. */
function beginOf(blocks: BlockLayout, block: number): number[] {
  const { elements } = blocks.gridFromBlockSteps(block);
  return [12, 13, 14].map((at) => (elements[at] ?? NaN) + 1);
}

describe('BlockLayout', () => {
  it.each(edgesAndBlocks)('has as many blocks as fill the grid, edge $edge', ({ edge, blocks }) => {
    const whole = layout({ gridDims: [blocks * edge, blocks * edge, edge], blockEdgeVoxels: edge });
    // The numbers run along x, then y, then z.
    expect(beginOf(whole, blocks - 1)).toEqual([(blocks - 1) * edge, 0, 0]);
    expect(beginOf(whole, blocks)).toEqual([0, edge, 0]);
    expect(beginOf(whole, blocks * blocks)).toEqual([0, 0, edge]);
  });

  it.each([1, 2, 3, 5, 16, 32, 49, 75, 117, 128])('has a last block that is not full, edge %i', (edge) => {
    for (let blocks = 1; blocks <= 20; ++blocks) {
      for (const voxels of [(blocks - 1) * edge + 1, blocks * edge]) {
        const whole = layout({ gridDims: [voxels, 2 * edge, edge], blockEdgeVoxels: edge });
        expect(beginOf(whole, blocks - 1)).toEqual([(blocks - 1) * edge, 0, 0]);
        expect(beginOf(whole, blocks)).toEqual([0, edge, 0]);
      }
    }
  });

  it('knows where in its region a block can have corners', () => {
    const whole = layout({ gridDims: [300, 200, 170], blockEdgeVoxels: 32 });
    for (let block = 0; block < 10 * 7 * 6; ++block) {
      const box = whole.blockBoxInRegion(block);
      const inRegion = whole.gridFromRegionSteps(block).invert();
      for (const steps of [0, 34 * 1024]) {
        const corner = new Vector3(steps, steps, steps).applyMatrix4(whole.gridFromBlockSteps(block));
        expect(box.containsPoint(corner.applyMatrix4(inRegion))).toBe(true);
      }
      expect(Math.max(...box.getSize(new Vector3()).toArray())).toBeLessThan(35 * 1024);
    }
  });
});
