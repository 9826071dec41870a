import { MeshoptDecoder } from 'meshoptimizer/decoder';

import { putBoneMarks } from './bone_marks';
import type { MeshBlock } from './generated/ream/wire/mesh-block';
import type { BlockSurface, Triple } from './messages';
import { stretchedNormals } from './octahedral';

const vertexBytes = 8;

/** Resolves once the mesh decoder may be used. */
export const meshDecoderReady: Promise<void> = MeshoptDecoder.ready;

/** Unpacks one block. Throws when its streams are malformed or an index is out of range. */
export function decodeBlock(block: MeshBlock, voxelSpacingMm: Triple): BlockSurface {
  const vertexCount = block.vertexCount();
  const indexCount = vertexCount === 0 ? 0 : block.indexCount();
  const vertices = new Uint8Array(vertexCount * vertexBytes);
  const indices = vertexCount > 65536 ? new Uint32Array(indexCount) : new Uint16Array(indexCount);
  if (vertexCount > 0) {
    MeshoptDecoder.decodeVertexBuffer(vertices, vertexCount, vertexBytes, block.verticesArray() ?? new Uint8Array());
    MeshoptDecoder.decodeIndexBuffer(
      new Uint8Array(indices.buffer),
      indexCount,
      indices.BYTES_PER_ELEMENT,
      block.indicesArray() ?? new Uint8Array(),
    );
    for (const index of indices) {
      if (index >= vertexCount) {
        throw new Error(`block ${block.block()}: index ${index} of ${vertexCount} vertices`);
      }
    }
  }
  const normals = stretchedNormals(vertices, vertexCount, voxelSpacingMm);
  putBoneMarks(normals, vertexCount, block.classesArray(), block.removedArray(), block.densitiesArray());
  return {
    block: block.block(),
    revision: block.revision(),
    tick: block.tick(),
    positions: new Uint16Array(vertices.buffer),
    normals,
    indices,
  };
}
