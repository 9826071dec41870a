import { beforeEach, describe, expect, it } from 'vitest';

import { FileReplay, type FileReplayParts } from '../../src/review_file/file_replay';
import type { Outcome } from '../../src/twin/twin_module';
import type { BlockSurface, Hello, StreamMessage, Telemetry, ToolMesh } from '../../src/wire/messages';

const toolOf = (name: string): ToolMesh => ({ name, positionsMm: new Float32Array(3), indices: new Uint32Array(3) });
const hello = { durationTicks: 5000, voxelSpacingMm: [1, 1, 1], tool: toolOf('first') } as unknown as Hello;

/** 250 ticks from there on, as proto/causes.md lays them out. */
function ticks(first: number): Uint8Array {
  const part = new Uint8Array(17);
  part[0] = 3;
  const view = new DataView(part.buffer);
  view.setUint32(1, first, true);
  view.setUint32(5, 250, true);
  return part;
}
const causes = [Uint8Array.of(1), Uint8Array.of(2), ...Array.from({ length: 20 }, (_, i) => ticks(i * 250))];

/** Says which bone it is by the tick of the blocks. */
class CountingTwin {
  ticks = 0;
  /** The bone that was last asked for. */
  private shown = -1;
  private readonly kept: number[] = [];
  constructor(private readonly differsAt = Infinity) {}
  take(part: Uint8Array): Outcome {
    if (part[0] === 3) this.ticks += 250;
    return this.ticks > this.differsAt ? 'differs' : 'agrees';
  }
  keepSnapshot(): number {
    const known = this.kept.indexOf(this.ticks);
    return known >= 0 ? known : this.kept.push(this.ticks) - 1;
  }
  goTo(snapshot: number): boolean {
    this.ticks = this.kept[snapshot] ?? 0;
    return true;
  }
  changedBlocks(): Uint32Array<ArrayBuffer> {
    const changed = this.shown !== this.ticks;
    this.shown = this.ticks;
    return changed ? Uint32Array.of(7) : new Uint32Array();
  }
  surfaceOf(block: number): BlockSurface {
    return { block, tick: this.ticks } as BlockSurface;
  }
}

let sent: StreamMessage[] = [];
let nowMs = 0;

function opened(twin = new CountingTwin()): FileReplay {
  const timed = (atTicks: number, word: string) => ({ atTicks, bytes: new TextEncoder().encode(word) });
  const parts: FileReplayParts = {
    hello,
    decoder: {
      decode(bytes) {
        const word = new TextDecoder().decode(bytes);
        if (word.startsWith('t')) return { kind: 'tool', tool: toolOf(word) };
        return { kind: 'telemetry', telemetry: { tick: Number(word), playback: null } as Telemetry };
      },
    },
    twin,
    causes,
    telemetry: Array.from({ length: 251 }, (_, i) => timed(20 * i, String(20 * i))),
    tools: [timed(3001, 'tool two')],
  };
  return new FileReplay(parts, (message) => sent.push(message));
}

/** Turns of 20 ms, until nothing is on its way. */
function turns(replay: FileReplay, count = 1): void {
  for (let i = 0; i < count || replay.reached === null; ++i) replay.advance(20, (nowMs += 20));
}

const last = <K extends StreamMessage['kind']>(kind: K) =>
  sent.filter((message): message is Extract<StreamMessage, { kind: K }> => message.kind === kind).at(-1);
const position = () => last('telemetry')?.telemetry.playback?.positionTicks;
const boneTick = () => last('mesh')?.mesh.blocks[0]?.tick;

describe('The replay of a review file', () => {
  beforeEach(() => {
    sent = [];
    nowMs = 0;
  });

  it('begins with the whole bone before the first tick', () => {
    opened();
    expect(sent.map(({ kind }) => kind)).toEqual(['mesh', 'telemetry']);
    expect(last('mesh')?.mesh.keyComplete).toBe(true);
    expect([position(), boneTick()]).toEqual([0, 0]);
  });

  it('shows bone, reamer and figures of the moment that is sought, forwards and backwards', () => {
    const replay = opened();
    replay.change({ position_s: 3.63 });
    expect(replay.reached).toBeNull();
    turns(replay);
    expect(replay.reached).toBe(1);
    expect([position(), boneTick(), last('telemetry')?.telemetry.tick]).toEqual([3630, 3500, 3620]);
    expect(last('tool')?.tool.name).toBe('tool two');
    replay.change({ position_s: 0.5 });
    turns(replay);
    expect([position(), boneTick()]).toEqual([500, 500]);
    expect(last('tool')?.tool.name, 'the hello’s').toBe('first');
  });

  it('plays to the end, where it rests and says so again and again', () => {
    const replay = opened();
    replay.change({ playing: true, speed: 4 });
    turns(replay, 100);
    expect([position(), boneTick()]).toEqual([5000, 5000]);
    expect(last('telemetry')?.telemetry.playback?.playing).toBe(false);
    sent = [];
    turns(replay, 100);
    expect(sent.length).toBeGreaterThanOrEqual(3);
    expect(sent.every(({ kind }) => kind === 'telemetry')).toBe(true);
  });

  it('computes ahead while it rests, and shows nothing of it', () => {
    const twin = new CountingTwin();
    const replay = opened(twin);
    turns(replay, 10);
    expect(twin.ticks).toBe(5000);
    expect([position(), boneTick()]).toEqual([0, 0]);
  });

  it('goes no further than the recording agrees with itself', () => {
    const replay = opened(new CountingTwin(4000));
    replay.change({ position_s: 5 });
    turns(replay, 3);
    expect(replay.stuck).toBe(true);
    expect([position(), boneTick()]).toEqual([2500, 2500]);
    replay.change({ playing: true });
    turns(replay, 20);
    expect(position()).toBe(2500);
  });
});
