import { PartFileError } from '../twin/part_file';
import type { StreamDecoder } from '../wire/decode';
import type { Hello, StreamMessage, ToolMesh } from '../wire/messages';
import type { PlaybackChange } from '../wire/rest_types';
import type { Telemetry } from '../wire/telemetry';
import type { TwinModule } from '../twin/twin_module';
import { BoneAt } from './bone_at';
import { FilePlayback } from './file_playback';
import type { TimedMessage } from './review_parts';

/** One turn computes bone for about so long, ms. */
const sliceMs = 25;
/** What is on its way to a moment is shown so often, ms. */
const showEveryMs = 100;
/** A recording that rests says so this often, ms: silence is a broken link. */
const heartbeatMs = 500;

export interface FileReplayParts {
  hello: Hello;
  /** That has decoded the hello. */
  decoder: Pick<StreamDecoder, 'decode'>;
  twin: Pick<TwinModule, 'take' | 'keepSnapshot' | 'goTo' | 'changedBlocks' | 'surfaceOf'>;
  /** Of the causes. */
  causes: readonly Uint8Array[];
  telemetry: readonly TimedMessage[];
  /** Other reamers than the hello's. */
  tools: readonly TimedMessage[];
}

/** Shows a recording as a server's replay does, by the same messages after the hello; its bone comes from the twin. */
export class FileReplay {
  private readonly bone: BoneAt;
  private readonly playback: FilePlayback;
  private readonly tools: readonly { atTicks: number; tool: ToolMesh }[];
  private tool: ToolMesh | undefined;
  private shownMs = -Infinity;
  /** The state of what is shown; empty while it is on its way. */
  private shown = '';
  private changes = 0;

  /** Shows the bone before the first tick. Throws where parts cannot be read. */
  constructor(
    private readonly parts: FileReplayParts,
    private readonly send: (message: StreamMessage) => void,
  ) {
    const { hello, decoder, twin, causes, tools } = parts;
    const changes = tools.flatMap(({ atTicks, bytes }) => {
      const decoded = decoder.decode(bytes);
      return decoded.kind === 'tool' ? [{ atTicks, tool: decoded.tool }] : [];
    });
    this.tools = [{ atTicks: 0, tool: copyOf(hello.tool) }, ...changes];
    this.tool = this.tools[0]?.tool;
    this.playback = new FilePlayback(hello.durationTicks);
    this.bone = new BoneAt(twin, causes);
    this.sendBone(true);
    this.sendMoment(0, -Infinity);
  }

  /** Whether a part of the recording contradicts itself, so that nothing is shown from there on. */
  get stuck(): boolean {
    return this.bone.limitTicks !== Infinity;
  }

  /** How many changes have been asked for, if what they led to is shown; else null. */
  get reached(): number | null {
    return this.shown === '' ? null : this.changes;
  }

  change(change: PlaybackChange): void {
    ++this.changes;
    this.shown = '';
    this.playback.change(change);
  }

  /** Lets time pass, and shows what has come of it; true when there is more to compute. */
  advance(ms: number, nowMs: number): boolean {
    // The clock waits for the bone, so that nothing is passed over.
    if (this.shown !== '') this.playback.advance(ms);
    if (this.playback.now.positionTicks > this.bone.limitTicks) this.playback.restAt(this.bone.limitTicks);
    const { positionTicks } = this.playback.now;
    const sinceMs = nowMs - this.shownMs;
    if (this.shown === this.state) {
      // It rests, and what is shown is of here, wherever the bone is then.
      if (sinceMs >= heartbeatMs) this.sendMoment(positionTicks, nowMs);
      return this.bone.lookAhead(sliceMs);
    }
    const there = this.bone.goTowards(positionTicks, sliceMs);
    if (!there && sinceMs < showEveryMs) {
      this.shown = '';
      return true;
    }
    const ticks = there ? Math.min(positionTicks, this.bone.limitTicks) : this.bone.ticks;
    this.sendTool(ticks);
    this.sendBone(false);
    this.sendMoment(ticks, nowMs);
    this.shown = there ? this.state : '';
    return !there;
  }

  private get state(): string {
    const { positionTicks, playing, speed, jump } = this.playback.now;
    return [positionTicks, playing, speed, jump].join();
  }

  private sendBone(first: boolean): void {
    const { twin, hello } = this.parts;
    const blocks = [...twin.changedBlocks()].map((block) => twin.surfaceOf(block, hello.voxelSpacingMm));
    if (first || blocks.length > 0) this.send({ kind: 'mesh', mesh: { blocks, keyComplete: first } });
  }

  private sendTool(ticks: number): void {
    const now = lastAt(this.tools, ticks)?.tool;
    if (now === undefined || now === this.tool) return;
    this.tool = now;
    this.send({ kind: 'tool', tool: copyOf(now) });
  }

  private sendMoment(ticks: number, nowMs: number): void {
    this.shownMs = nowMs;
    const message = lastAt(this.parts.telemetry, ticks);
    const decoded = message === undefined ? null : this.parts.decoder.decode(message.bytes);
    if (decoded?.kind !== 'telemetry') throw new PartFileError(`the file says nothing of tick ${ticks}`);
    const telemetry: Telemetry = { ...decoded.telemetry, playback: { ...this.playback.now, positionTicks: ticks } };
    this.send({ kind: 'telemetry', telemetry });
  }
}

/** The last that holds when so many ticks have passed; they are in order. */
export function lastAt<T extends { atTicks: number }>(all: readonly T[], ticks: number): T | undefined {
  let low = 0;
  let high = all.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((all[middle]?.atTicks ?? Infinity) <= ticks) low = middle + 1;
    else high = middle;
  }
  return all[low - 1];
}

/** What is sent goes to another thread. */
const copyOf = (tool: ToolMesh): ToolMesh => ({
  ...tool,
  positionsMm: tool.positionsMm.slice(),
  indices: tool.indices.slice(),
});
