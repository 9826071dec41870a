import { putBoneMarks } from '../wire/bone_marks';
import type { BlockSurface } from '../wire/messages';
import { stretchedNormals } from '../wire/octahedral';
import type { Surface } from '../wire/ply';
import type { Triple } from '../wire/pose';

const vertexBytes = 8;
const none = 0xffffffff;

/** What the twin's WebAssembly exports (server/twin/wasm/exports.cpp); addresses are of its memory. */
interface TwinExports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  twin_input(bytes: number): number;
  twin_take(): number;
  twin_agreed_ticks(): number;
  twin_ended(): number;
  twin_recorded_ticks(): number;
  twin_keep_snapshot(): number;
  twin_go_to(snapshot: number): number;
  twin_find_changed_blocks(): number;
  twin_blocks_at(): number;
  twin_make_surface(block: number): number;
  twin_indices_at(): number;
  twin_vertices_at(): number;
  twin_vertex_count(): number;
  twin_make_whole_surface(): number;
  twin_whole_vertices_at(): number;
  twin_whole_normals_at(): number;
  twin_whole_triangle_count(): number;
  twin_whole_triangles_at(): number;
  twin_marks_at(kind: number): number;
  twin_marks_bytes(kind: number): number;
}

/** Three numbers a vertex, and a triangle. */
export type GridSurface = Pick<Surface, 'positions' | 'normals' | 'indices'>;

const outcomes = ['agrees', 'damaged', 'differs'] as const;
/** Of the parts taken so far: they agree, cannot be read, or another bone comes of them. */
export type Outcome = (typeof outcomes)[number];

/**
 * A session's bone, computed again here from its causes by the program's own sources. One session a module. Throws
 * WebAssembly.RuntimeError where memory runs out; nothing is to be asked of it then.
 */
export class TwinModule {
  /** That have been made. */
  private surfaces = 0;

  private constructor(private readonly twin: TwinExports) {
    twin._initialize();
  }

  static async load(module: ArrayBuffer): Promise<TwinModule> {
    const { instance } = await WebAssembly.instantiate(module);
    return new TwinModule(instance.exports as unknown as TwinExports);
  }

  take(part: Uint8Array): Outcome {
    const place = this.twin.twin_input(part.length) >>> 0;
    // Memory may have grown, and its buffer with it.
    new Uint8Array(this.twin.memory.buffer, place, part.length).set(part);
    return outcomes[this.twin.twin_take()] ?? 'damaged';
  }

  /** Keeps what has been computed, for goTo(); its number. Null where parts do not agree, and after the end. */
  keepSnapshot(): number | null {
    const number = this.twin.twin_keep_snapshot() >>> 0;
    return number === none ? null : number;
  }

  /** The next part to be taken is the one that came after that snapshot. */
  goTo(snapshot: number): boolean {
    return this.twin.twin_go_to(snapshot) === 1;
  }

  /** Blocks whose surface may have changed since the last call; all of them at first. */
  changedBlocks(): Uint32Array<ArrayBuffer> {
    const count = this.twin.twin_find_changed_blocks();
    return new Uint32Array(this.twin.memory.buffer, this.twin.twin_blocks_at() >>> 0, count).slice();
  }

  /** As decodeBlock gives what a server sends. */
  surfaceOf(block: number, voxelSpacingMm: Triple): BlockSurface {
    const { twin } = this;
    const indexCount = twin.twin_make_surface(block);
    const count = twin.twin_vertex_count();
    const { buffer } = twin.memory;
    const vertices = new Uint8Array(buffer, twin.twin_vertices_at() >>> 0, vertexBytes * count).slice();
    const wide = new Uint32Array(buffer, twin.twin_indices_at() >>> 0, indexCount);
    const indices = count > 65536 ? wide.slice() : Uint16Array.from(wide);
    const normals = stretchedNormals(vertices, count, voxelSpacingMm);
    putBoneMarks(normals, count, this.marks(0), this.marks(1), this.marks(2));
    const positions = new Uint16Array(vertices.buffer);
    return { block, revision: ++this.surfaces, tick: this.agreedTicks, positions, normals, indices };
  }

  /** The whole surface, its vertices in the order of the program's files; in the grid's frame, mm. */
  wholeSurface(): GridSurface {
    const { twin } = this;
    const vertices = twin.twin_make_whole_surface();
    const triangles = twin.twin_whole_triangle_count();
    const { buffer } = twin.memory;
    const floats = (at: number) => new Float32Array(buffer, at >>> 0, 3 * vertices).slice();
    return {
      positions: floats(twin.twin_whole_vertices_at()),
      normals: floats(twin.twin_whole_normals_at()),
      indices: new Uint32Array(buffer, twin.twin_whole_triangles_at() >>> 0, 3 * triangles).slice(),
    };
  }

  /** Null: none are known. */
  private marks(kind: number): Uint8Array | null {
    const bytes = this.twin.twin_marks_bytes(kind);
    return bytes === 0 ? null : new Uint8Array(this.twin.memory.buffer, this.twin.twin_marks_at(kind) >>> 0, bytes);
  }

  /** Ticks whose hashes agreed. */
  get agreedTicks(): number {
    return this.twin.twin_agreed_ticks();
  }

  /** Of the whole recording: more than agreed where its last ticks have no bone. Null before the end was taken. */
  get recordedTicks(): number | null {
    return this.twin.twin_ended() === 1 ? this.twin.twin_recorded_ticks() : null;
  }
}
