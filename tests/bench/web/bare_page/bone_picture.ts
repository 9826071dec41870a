import { Matrix4, Quaternion, Vector3 } from 'three';

import { drawsInSoftware } from '../../../../web/src/scene/software_drawing';
import { StreamDecoder } from '../../../../web/src/wire/decode';
import { meshDecoderReady } from '../../../../web/src/wire/decode_block';
import type { BlockSurface, Hello, Pose } from '../../../../web/src/wire/messages';
import { simplifiedSurface, simplifierReady } from '../../../../web/src/wire/simplified_surface';

/** The reamer as the page shows it, where the stream has it first. */
export interface ReamerPicture {
  /** Tool frame. */
  positionsMm: Float32Array;
  indices: Uint32Array;
  worldFromTool: Pose;
}

/** One indexed mesh, world frame. */
export interface BonePicture {
  positionsMm: Float32Array;
  /** Unit. */
  normals: Float32Array;
  indices: Uint32Array;
}

const stepsPerVoxel = 1024;
/** Values of a vertex in a block's buffers, the last one padding. */
const stride = 4;

/** The whole bone of a stream's messages, each with its length (u32, little endian) before it, and the reamer. */
export async function streamedPicture(stream: ArrayBuffer): Promise<{ bone: BonePicture; reamer: ReamerPicture }> {
  await Promise.all([meshDecoderReady, simplifierReady]);
  const decoder = new StreamDecoder();
  const newest = new Map<number, BlockSurface>();
  let hello: Hello | null = null;
  let pose: Pose | null = null;
  for (const bytes of messagesOf(stream)) {
    const message = decoder.decode(bytes);
    if (message.kind === 'hello') ({ hello } = message);
    if (message.kind === 'telemetry') pose ??= message.telemetry.worldFromTool;
    if (message.kind === 'mesh') for (const block of message.mesh.blocks) newest.set(block.block, block);
  }
  if (hello === null || pose === null) throw new Error('a stream that does not tell where bone and reamer are');
  // As the page draws it.
  const { voxelSpacingMm } = hello;
  const blocks = [...newest.values()].map((block) =>
    drawsInSoftware() ? simplifiedSurface(block, voxelSpacingMm) : block,
  );
  return {
    bone: merged(hello, blocks),
    reamer: { ...hello.tool, worldFromTool: pose },
  };
}

function* messagesOf(stream: ArrayBuffer): Generator<Uint8Array> {
  const view = new DataView(stream);
  for (let at = 0; at < stream.byteLength;) {
    const length = view.getUint32(at, true);
    yield new Uint8Array(stream.slice(at + 4, at + 4 + length));
    at += 4 + length;
  }
}

function merged(hello: Hello, blocks: BlockSurface[]): BonePicture {
  const sum = (count: (block: BlockSurface) => number) => blocks.reduce((total, block) => total + count(block), 0);
  const vertexCount = sum((block) => block.positions.length / stride);
  const picture: BonePicture = {
    positionsMm: new Float32Array(3 * vertexCount),
    normals: new Float32Array(3 * vertexCount),
    indices: new Uint32Array(sum((block) => block.indices.length)),
  };
  const turned = new Quaternion(...hello.worldFromGrid.rotationXyzw);
  const worldFromGrid = new Matrix4().compose(
    new Vector3(...hello.worldFromGrid.translationMm),
    turned,
    new Vector3(1, 1, 1),
  );
  const spacing = new Vector3(...hello.voxelSpacingMm);
  const place = new Vector3();
  let vertex = 0;
  let index = 0;
  for (const block of blocks) {
    const origin = originVoxels(hello, block.block);
    picture.indices.set(
      Array.from(block.indices, (i) => i + vertex),
      index,
    );
    index += block.indices.length;
    for (let at = 0; at < block.positions.length; at += stride, ++vertex) {
      place.fromArray(block.positions, at).divideScalar(stepsPerVoxel).add(origin).multiply(spacing);
      place.applyMatrix4(worldFromGrid).toArray(picture.positionsMm, 3 * vertex);
      // Buffers hold normals times the spacing, so that stretching divides them by it once more.
      place.fromArray(block.normals, at).divide(spacing).normalize().applyQuaternion(turned);
      place.toArray(picture.normals, 3 * vertex);
    }
  }
  return picture;
}

/** Blocks begin one voxel before their own. */
function originVoxels(hello: Hello, block: number): Vector3 {
  const edge = hello.blockEdgeVoxels;
  const blocksX = Math.ceil(hello.gridDims[0] / edge);
  const blocksY = Math.ceil(hello.gridDims[1] / edge);
  const place = new Vector3(
    block % blocksX,
    Math.floor(block / blocksX) % blocksY,
    Math.floor(block / (blocksX * blocksY)),
  );
  return place.multiplyScalar(edge).subScalar(1);
}
