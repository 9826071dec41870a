// The golden messages were made from proto/golden/*.json by `flatc -b`; the block inside was encoded by libmeshoptimizer
// 0.18, so nothing here was written by the code that reads it.
import { Builder } from 'flatbuffers';
import { readFileSync } from 'node:fs';
import { afterEach, beforeAll, describe, expect, it, vi } from 'vitest';

import { meshMessage, serverMessage } from '../../../tests/support/fake_stream/messages';
import { StreamDecoder, transferables } from '../../src/wire/decode';
import { meshDecoderReady } from '../../src/wire/decode_block';
import { Body, Hello, Playback, SessionState, Telemetry } from '../../src/wire/generated/stream_generated';
import type { BlockSurface, StreamMessage } from '../../src/wire/messages';
import { simplifierReady, SurfaceSimplifier } from '../../src/wire/surface_simplifier';

const golden = (name: string) =>
  new Uint8Array(readFileSync(new URL(`../../../proto/golden/${name}.bin`, import.meta.url)));

function decoded<K extends StreamMessage['kind']>(name: string, kind: K): Extract<StreamMessage, { kind: K }> {
  const decoder = new StreamDecoder();
  const hello = decoder.decode(golden('hello'));
  const message = name === 'hello' ? hello : decoder.decode(golden(name));
  if (message.kind !== kind) throw new Error(`expected ${kind}, got ${message.kind}`);
  return message as Extract<StreamMessage, { kind: K }>;
}

beforeAll(() => Promise.all([meshDecoderReady, simplifierReady]));
afterEach(() => vi.restoreAllMocks());

describe('StreamDecoder', () => {
  it('reads the hello', () => {
    const { hello } = decoded('hello', 'hello');
    expect(hello.serverEpoch).toBe('18446744073709551615');
    expect(hello).toMatchObject({ sessionId: 'k7m2', caseName: 'Phantom scapula', side: 'left', forceScale: 26 });
    expect(hello.gridDims).toEqual([64, 40, 96]);
    expect(hello.voxelSpacingMm).toEqual([0.5, 0.25, 1]);
    expect(hello.blockEdgeVoxels).toBe(32);
    expect(hello.worldFromGrid).toEqual({ rotationXyzw: [0.5, 0.5, 0.5, 0.5], translationMm: [-100.5, 20.25, 300] });
    expect([...hello.tool.positionsMm]).toEqual([0, 0, 0, 1.5, 0, -1, 0, 1.5, -1]);
    expect([...hello.tool.indices]).toEqual([0, 1, 2]);
    expect(hello.axisDirection[1]).toBeCloseTo(0.6, 6);
    expect(hello.plannedDepthMm).toBe(2.5);
  });

  it('reads and unpacks mesh blocks', () => {
    const { mesh } = decoded('mesh_delta', 'mesh');
    expect(mesh.keyComplete).toBe(true);
    const [full, empty] = mesh.blocks;
    expect(full).toMatchObject({ block: 5, revision: 3, tick: 1234 });
    const positions = [0, 1, 2, 3, 4].map((v) => [...(full?.positions ?? []).slice(4 * v, 4 * v + 3)]);
    expect(positions).toEqual([
      [1024, 1024, 2048],
      [2048, 1024, 2048],
      [2048, 2048, 2048],
      [1024, 2048, 34816],
      [1536, 1536, 512],
    ]);
    // Kinds 0 1 2 1 2; gone 0 15 3 0 8; steps of density 0 3 15 1 8.
    expect([0, 1, 2, 3, 4].map((v) => full?.normals[4 * v + 3])).toEqual([1, 254, 975, 66, 547]);
    expect(full?.indices).toBeInstanceOf(Uint16Array);
    expect(cyclicTriangles(full?.indices ?? [])).toEqual([
      [0, 1, 2],
      [0, 2, 3],
      [0, 4, 1],
    ]);
    expect(empty).toMatchObject({ block: 6, revision: 9 });
    expect(empty?.indices.length).toBe(0);
  });

  it('reads blocks of a server that tells neither what kind of bone there is nor what is gone', () => {
    const { mesh } = decoded('mesh_without_classes', 'mesh');
    expect([0, 1, 2, 3, 4].map((v) => mesh.blocks[0]?.normals[4 * v + 3])).toEqual([0, 0, 0, 0, 0]);
  });

  it('reads telemetry, with the newest of each series', () => {
    const { telemetry } = decoded('telemetry', 'telemetry');
    expect(telemetry).toMatchObject({
      firstTick: 1000,
      tickStride: 2,
      tick: 1004,
      handForceN: 1,
      torqueNMm: 3,
      feedRateMmS: 0.375,
      densityGCc: 0.75,
      spindleOn: true,
      spindleSpeedRadS: -8.5,
      stalled: true,
      irrigating: true,
      surfaceTemperatureC: 48.5,
      state: 'fault',
      fault: 'device lost',
      depthMm: 1.5,
      dropped: 7,
      ticksMissed: 2,
      worldFromHandle: null,
      stampMs: 5000,
    });
    expect([...telemetry.thrustN]).toEqual([10.5, 11.25, 12]);
    expect([...telemetry.feedRatesMmS]).toEqual([0.125, 0.25, 0.375]);
    expect([...telemetry.vibrationG]).toEqual([0.25, -0.5, 0.75]);
    expect(telemetry.worldFromTool?.translationMm).toEqual([4, 5, 6]);
    expect(telemetry.worldFromBoneRest).toEqual({ rotationXyzw: [0, 0, 1, 0], translationMm: [0.5, -1, 2.5] });
  });

  it('hands over buffers of its own, never the message', () => {
    for (const [name, kind] of [
      ['hello', 'hello'],
      ['mesh_delta', 'mesh'],
      ['telemetry', 'telemetry'],
    ] as const) {
      const message = decoded(name, kind);
      const buffers = transferables(message);
      expect(buffers.length).toBeGreaterThan(0);
      expect(new Set(buffers).size).toBe(buffers.length);
    }
  });

  it('wants a hello first', () => {
    expect(() => new StreamDecoder().decode(golden('telemetry'))).toThrow('hello');
  });

  it('refuses a block whose mesh streams were damaged', () => {
    const bytes = golden('mesh_delta');
    const vertexHeader = bytes.findIndex((byte, i) => byte === 160 && bytes[i + 1] === 0 && bytes[i + 2] === 1);
    bytes[vertexHeader] = 0;
    const decoder = new StreamDecoder();
    decoder.decode(golden('hello'));
    expect(() => decoder.decode(bytes)).toThrow();
  });
});

/** Triangles with their smallest index first, sorted; winding is kept. */
function cyclicTriangles(indices: ArrayLike<number>): number[][] {
  const triangles: number[][] = [];
  for (let i = 0; i < indices.length; i += 3) {
    const t = [indices[i] ?? -1, indices[i + 1] ?? -1, indices[i + 2] ?? -1];
    const turn = t.indexOf(Math.min(...t));
    triangles.push([...t.slice(turn), ...t.slice(0, turn)]);
  }
  return triangles.sort((a, b) => a.join().localeCompare(b.join()));
}

/** A delta of one flat block, a corner for every two voxels. */
function flatBlock(keyComplete: boolean, of: { block?: number; revision?: number } = {}): Uint8Array {
  const row = 16;
  const vertices = new Uint8Array(8 * row * row);
  const places = new DataView(vertices.buffer);
  const indices: number[] = [];
  for (let i = 0; i < row * row; ++i) {
    const [x, y] = [i % row, Math.floor(i / row)];
    for (const [axis, voxels] of [2 * x, 2 * y, 7].entries()) places.setUint16(8 * i + 2 * axis, 1024 * voxels, true);
    if (x + 1 < row && y + 1 < row) indices.push(i, i + 1, i + row + 1, i, i + row + 1, i + row);
  }
  const mesh = { vertices, vertexCount: row * row, indices: Uint32Array.from(indices) };
  return meshMessage([{ block: 0, revision: 0, ...of, mesh }], 0, keyComplete);
}

const emptyMesh = { vertices: new Uint8Array(), vertexCount: 0, indices: new Uint32Array() };

describe('StreamDecoder for drawing in software', () => {
  const passed = (decoder: StreamDecoder, bytes: Uint8Array) => {
    const decoded = decoder.decode(bytes);
    if (decoded.kind !== 'mesh') throw new Error('no mesh');
    // As it goes to another thread: what is kept must not go with it.
    return structuredClone(decoded, { transfer: transferables(decoded) }).mesh;
  };
  const triangles = (blocks: readonly BlockSurface[]) => (blocks[0]?.indices.length ?? 0) / 3;
  const all = 2 * 15 * 15;
  const begun = (simplifies: boolean) => {
    const decoder = new StreamDecoder(simplifies ? SurfaceSimplifier : null);
    decoder.decode(golden('hello'));
    return decoder;
  };
  const after = (decoder: StreamDecoder) => {
    const message = decoder.goOn(1000);
    if (message?.kind !== 'simpler') throw new Error('nothing came of it');
    expect(new Set(transferables(message)).size).toBe(3 * message.blocks.length);
    return message.blocks;
  };

  it('passes a first picture on at once, and simplifies it as what comes after it', () => {
    const decoder = begun(true);
    const first = passed(decoder, flatBlock(false));
    expect(triangles(first.blocks)).toBe(all);
    expect(first.simplerFollow).toBe(false);
    expect(decoder.goOn(1000), 'the picture is not complete').toBeNull();
    expect(decoder.works).toBe(false);
    const complete = passed(decoder, flatBlock(true));
    expect(triangles(complete.blocks)).toBe(all);
    expect(complete.simplerFollow).toBe(true);
    expect(decoder.goOn(0), 'no time').toBeNull();
    const simpler = after(decoder);
    expect(simpler).toHaveLength(1);
    expect(triangles(simpler)).toBeLessThan(all / 4);
    const later = passed(decoder, flatBlock(false));
    expect(later.simplerFollow).toBeUndefined();
    expect(later.blocks[0]?.indices).toEqual(simpler[0]?.indices);
    expect(later.blocks[0]?.positions).toEqual(simpler[0]?.positions);
  });

  it.each(['simplified already', 'still to be simplified'] as const)(
    'does not come back to a block, %s, that has come anew or is empty now',
    (which) => {
      // Half a millisecond between any two looks at the clock.
      let nowMs = 0;
      vi.spyOn(performance, 'now').mockImplementation(() => (nowMs += 0.5));
      const decoder = begun(true);
      for (const block of [0, 1, 2, 3]) passed(decoder, flatBlock(block === 3, { block }));
      expect(decoder.works).toBe(true);
      expect(decoder.goOn(1.2), 'time for two').toBeNull();
      expect(decoder.works).toBe(true);
      const [emptied, renewed] = which === 'simplified already' ? [0, 1] : [2, 3];
      passed(decoder, meshMessage([{ block: emptied, revision: 1, mesh: emptyMesh }], 0, false));
      const anew = passed(decoder, flatBlock(false, { block: renewed, revision: 1 }));
      expect(triangles(anew.blocks)).toBeLessThan(all / 4);
      const left = after(decoder);
      expect(left.map(({ block }) => block).sort()).toEqual([0, 1, 2, 3].filter((b) => b !== emptied && b !== renewed));
      expect(decoder.works).toBe(false);
    },
  );

  it('sends nothing again that stays as it is', () => {
    const decoder = begun(true);
    // Three triangles, and bone is gone at one corner.
    expect(decoder.decode(golden('mesh_delta'))).toMatchObject({ mesh: { keyComplete: true, simplerFollow: true } });
    expect(decoder.works).toBe(true);
    expect(after(decoder)).toEqual([]);
  });

  it('simplifies nothing elsewhere', () => {
    const decoder = begun(false);
    const mesh = passed(decoder, flatBlock(true));
    expect(triangles(mesh.blocks)).toBe(all);
    expect(mesh.simplerFollow).toBeUndefined();
    expect(decoder.goOn(1000)).toBeNull();
  });
});

describe('StreamDecoder of a replay', () => {
  it('says of what it is and where it stands', () => {
    const decoder = new StreamDecoder();
    const b = new Builder();
    const of = b.createString('abcdefgh');
    Hello.startHello(b);
    Hello.addReplayOf(b, of);
    Hello.addDurationTicks(b, 61234);
    const hello = decoder.decode(serverMessage(b, Body.Hello, Hello.endHello(b)));
    expect(hello).toMatchObject({ hello: { replayOf: 'abcdefgh', durationTicks: 61234, scapula: null } });

    const c = new Builder();
    Playback.startPlayback(c);
    Playback.addPositionTicks(c, 133);
    Playback.addSpeed(c, 0.25);
    Playback.addPlaying(c, true);
    Playback.addJump(c, 7);
    const playback = Playback.endPlayback(c);
    Telemetry.startTelemetry(c);
    Telemetry.addState(c, SessionState.replaying);
    Telemetry.addPlayback(c, playback);
    const decoded = decoder.decode(serverMessage(c, Body.Telemetry, Telemetry.endTelemetry(c)));
    expect(decoded).toMatchObject({
      telemetry: { state: 'replaying', playback: { positionTicks: 133, speed: 0.25, playing: true, jump: 7 } },
    });
  });

  it('is nothing of the kind in what is live', () => {
    expect(decoded('hello', 'hello').hello.replayOf).toBe('');
    expect(decoded('telemetry', 'telemetry').telemetry.playback).toBeNull();
  });
});
