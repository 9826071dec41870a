import { StreamDecoder } from '../wire/decode';
import type { StreamMessage, ToolMesh } from '../wire/messages';
import type { Triple } from '../wire/pose';
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

interface Parts {
  twin: TwinModule;
  /** Of the causes. */
  causes: readonly Uint8Array[];
  /** The first is the hello. */
  messages: readonly TimedMessage[];
}

/** Shows a recording as a server's replay does, by the same messages; its bone comes from the twin. */
export class FileReplay {
  private readonly decoder = new StreamDecoder();
  private readonly bone: BoneAt;
  private readonly twin: TwinModule;
  private readonly playback: FilePlayback;
  private readonly telemetry: readonly TimedMessage[];
  private readonly tools: readonly { atTicks: number; tool: ToolMesh }[];
  private readonly spacingMm: Triple;
  private tool: ToolMesh;
  private shownMs = -Infinity;
  private shown = '';

  /** Says hello and shows the bone before the first tick. Throws where the messages cannot be read. */
  constructor(
    { twin, causes, messages }: Parts,
    private readonly send: (message: StreamMessage) => void,
  ) {
    const [first, ...others] = messages;
    const hello = first === undefined ? null : this.decoder.decode(first.bytes);
    if (hello?.kind !== 'hello') throw new Error('the file does not begin with a hello');
    const kinds = others.map((message) => ({ message, decoded: this.decoder.decode(message.bytes) }));
    this.telemetry = kinds.flatMap(({ message, decoded }) => (decoded.kind === 'telemetry' ? [message] : []));
    const changes = kinds.flatMap(({ message: { atTicks }, decoded }) =>
      decoded.kind === 'tool' ? [{ atTicks, tool: decoded.tool }] : [],
    );
    this.tool = hello.hello.tool;
    this.tools = [{ atTicks: 0, tool: copyOf(this.tool) }, ...changes];
    this.spacingMm = hello.hello.voxelSpacingMm;
    this.playback = new FilePlayback(hello.hello.durationTicks);
    this.twin = twin;
    this.bone = new BoneAt(twin, causes);
    this.tool = this.tools[0]?.tool ?? this.tool;
    send(hello);
    this.sendBone(true);
    this.sendMoment(0);
  }

  /** Whether the bone could be computed so far. */
  get agrees(): boolean {
    return this.bone.agrees;
  }

  change(change: PlaybackChange): void {
    this.playback.change(change);
  }

  /** Lets time pass, and shows what has come of it; true when there is more to compute. */
  advance(ms: number, nowMs: number): boolean {
    this.playback.advance(ms);
    const { positionTicks, playing, speed, jump } = this.playback.now;
    const there = this.bone.goTowards(positionTicks, sliceMs);
    const state = [positionTicks, playing, speed, jump].join();
    const sinceMs = nowMs - this.shownMs;
    if (there ? state === this.shown && sinceMs < heartbeatMs : sinceMs < showEveryMs) return !there;
    this.sendTool(positionTicks);
    this.sendBone(false);
    this.sendMoment(there ? positionTicks : this.bone.ticks);
    this.shown = there ? state : '';
    this.shownMs = nowMs;
    return !there;
  }

  private sendBone(first: boolean): void {
    const blocks = [...this.twin.changedBlocks()].map((block) => this.twin.surfaceOf(block, this.spacingMm));
    if (first || blocks.length > 0) this.send({ kind: 'mesh', mesh: { blocks, keyComplete: first } });
  }

  private sendTool(ticks: number): void {
    const now = lastAt(this.tools, ticks)?.tool;
    if (now === undefined || now === this.tool) return;
    this.tool = now;
    this.send({ kind: 'tool', tool: copyOf(now) });
  }

  private sendMoment(ticks: number): void {
    const message = lastAt(this.telemetry, ticks);
    if (message === undefined) return;
    const decoded = this.decoder.decode(message.bytes);
    if (decoded.kind !== 'telemetry') return;
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
