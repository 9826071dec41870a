import type { WebSocket } from 'ws';

import { SessionState } from '../../../web/src/wire/generated/stream_generated';
import { entryMm, intactBone, plannedDepthMm, sweptByCap, type Point } from './bone';
import { FakeHand } from './hand';
import { helloMessage, meshMessage, telemetryMessage, type RevisedBlock } from './messages';
import { blockDims, blockEdge, type BlockMesh, Field, meshBlock } from './surface_nets';

const stepMs = 33;
const approachMm = 12;
const approachS = 2;
const feedMmS = 0.25;
const withdrawS = 1.5;
const durationS = approachS + plannedDepthMm / feedMmS + withdrawS;

/** One session of the fake server: a cap comes, cuts to the planned depth at constant feed, and goes. */
export class FakeSession {
  state = SessionState.created;
  tick = 0;
  readonly createdUtc = new Date().toISOString();
  private readonly field = new Field(intactBone);
  private readonly blocks: RevisedBlock[];
  private readonly viewers = new Set<WebSocket>();
  /** The device that steers it; null: a script does. */
  readonly hand: FakeHand | null;
  private depthMm = 0;
  private removedMm3 = 0;
  private peakN = 0;
  private timer: ReturnType<typeof setInterval> | undefined;

  constructor(
    readonly id: string,
    readonly forceScale: number,
    private readonly serverEpoch: bigint,
    private readonly device: string,
    private readonly caseId = 'demo',
  ) {
    this.hand = device === 'browser' ? new FakeHand(id) : null;
    intact ??= wholeBone();
    this.field.values.set(intact.values);
    this.blocks = intact.meshes.map((mesh, block) => ({ block, revision: 1, mesh }));
  }

  describe(): object {
    const times = { mean_us: 184, p50_us: 170, p99_us: 391, p999_us: 700, max_us: 900 };
    const lateness = { mean_us: 4, p50_us: 3, p99_us: 9, p999_us: 80, max_us: 300 };
    const loop = { ...times, missed: 0, lateness, realtime: true, memory_locked: true, cpu: -1 };
    return {
      id: this.id,
      kind: 'session',
      case: this.caseId,
      script: 'demo',
      state: SessionState[this.state],
      created_utc: this.createdUtc,
      tick: this.tick,
      duration_s: durationS,
      force_scale: this.forceScale,
      fault: null,
      loop,
      device: { name: this.device, state: this.hand?.link ?? 'fresh', rtt_ms: this.hand === null ? null : 1.5 },
    };
  }

  metrics(): object {
    return {
      removed_volume_mm3: this.removedMm3,
      removed_volume_cortical_mm3: this.removedMm3 * 0.4,
      removed_volume_cancellous_mm3: this.removedMm3 * 0.6,
      reaming_depth_mm: this.depthMm,
      axial_thrust_mean_n: this.peakN * 0.8,
      axial_thrust_peak_n: this.peakN,
      weakened_time_s: 0,
      apparent_stiffness_n_mm: null,
      duration_s: this.tick / 1000,
      force_scale: this.forceScale,
      grid_hash: null,
      session_hash: null,
    };
  }

  start(): void {
    this.state = SessionState.running;
    const beganMs = Date.now() - this.tick;
    this.timer = setInterval(() => this.advance(Date.now() - beganMs), stepMs);
  }

  end(state: SessionState): void {
    clearInterval(this.timer);
    this.state = state;
    this.send(this.telemetry(this.tick));
  }

  join(viewer: WebSocket): void {
    const { id: sessionId, serverEpoch, forceScale } = this;
    viewer.send(helloMessage({ sessionId, serverEpoch, forceScale }));
    const shown = this.blocks.filter((b) => b.mesh.indices.length > 0);
    for (let i = 0; i < shown.length; i += 16) viewer.send(meshMessage(shown.slice(i, i + 16), this.tick, false));
    viewer.send(meshMessage([], this.tick, true));
    viewer.send(this.telemetry(this.tick));
    this.viewers.add(viewer);
    viewer.on('close', () => this.viewers.delete(viewer));
  }

  private advance(tick: number): void {
    const from = this.tick;
    this.tick = tick;
    this.hand?.advance(tick - from);
    this.rest(this.hand?.resting ?? false);
    const depth = this.apexDepthMm(tick / 1000);
    if (depth > this.depthMm) {
      this.cutTo(depth);
      this.depthMm = depth;
    }
    if (this.hand === null && tick >= durationS * 1000) this.end(SessionState.finished);
    else this.send(this.telemetry(from));
  }

  /** The state in which it can be stopped. */
  restingState(): SessionState {
    return this.state === SessionState.paused ? SessionState.paused : SessionState.running;
  }

  private rest(resting: boolean): void {
    this.state = resting ? SessionState.paused : SessionState.running;
  }

  /** How far the apex is past the entry, mm. */
  private apexDepthMm(seconds: number): number {
    if (this.hand !== null) return this.hand.depthMm;
    if (seconds < approachS) return -approachMm * (1 - seconds / approachS);
    const cutting = (seconds - approachS) * feedMmS;
    if (cutting <= plannedDepthMm) return cutting;
    return plannedDepthMm - (approachMm * (seconds - approachS - plannedDepthMm / feedMmS)) / withdrawS;
  }

  private thrustN(tick: number): number {
    if (this.hand !== null) return this.hand.thrustN;
    const depth = this.apexDepthMm(tick / 1000);
    if (depth <= 0 || tick / 1000 > approachS + plannedDepthMm / feedMmS) return 0;
    return 58 * (1 - Math.exp(-depth * 4)) + 2.5 * Math.sin(tick * 0.05) + 1.5 * Math.sin(tick * 0.31);
  }

  private telemetry(fromTick: number): Uint8Array {
    const ticks = Array.from({ length: Math.max(this.tick - fromTick, 0) }, (_, i) => fromTick + i);
    const thrustN = ticks.map((tick) => this.thrustN(tick));
    this.peakN = Math.max(this.peakN, ...thrustN);
    const [, besideY, besideZ] = this.hand?.sidewaysMm ?? [0, 0, 0];
    const apexMm: Point = [entryMm[0] - this.apexDepthMm(this.tick / 1000), entryMm[1] + besideY, entryMm[2] + besideZ];
    return telemetryMessage({
      firstTick: fromTick,
      thrustN,
      handForceN: thrustN.map((n) => n / this.forceScale),
      feedMmS: thrustN.map((n) => (n > 0 ? feedMmS : 0)),
      densityGCc: thrustN.map((n) => (n > 0 ? 0.62 : 0)),
      tick: this.tick,
      apexMm,
      spindleOn: this.state === SessionState.running && (this.hand?.spindleOn ?? true),
      state: this.state,
      depthMm: this.depthMm,
      removedMm3: this.removedMm3,
    });
  }

  private cutTo(depthMm: number): void {
    const dirty = new Set<number>();
    for (let z = 40; z < 120; ++z)
      for (let y = 40; y < 120; ++y)
        for (let x = 70; x < 110; ++x) {
          const at = Field.at(x, y, z);
          const before = this.field.values[at] ?? 0;
          const after = Math.max(before, -sweptByCap([(x + 0.5) / 2, (y + 0.5) / 2, (z + 0.5) / 2], depthMm));
          if (after - before < 1e-4 || before > 1) continue;
          this.field.values[at] = after;
          if (before < 0 && after >= 0) this.removedMm3 += 0.125;
          for (let corner = 0; corner < 8; ++corner)
            dirty.add(blockOf(x + (corner & 1), y + ((corner >> 1) & 1), z + (corner >> 2)));
        }
    const changed = [...dirty].map((block) => {
      const shown = this.blocks[block];
      if (shown === undefined) throw new Error(`no block ${block}`);
      shown.revision += 1;
      shown.mesh = meshBlock(this.field, block);
      return shown;
    });
    if (changed.length > 0) this.send(meshMessage(changed, this.tick, false));
  }

  private send(message: Uint8Array): void {
    for (const viewer of this.viewers) viewer.send(message);
  }
}

/** The bone that every session begins with, made when it is first needed. */
let intact: { values: Float32Array; meshes: BlockMesh[] } | undefined;

function wholeBone(): { values: Float32Array; meshes: BlockMesh[] } {
  const field = new Field(intactBone);
  field.fill();
  const count = blockDims[0] * blockDims[1] * blockDims[2];
  return { values: field.values, meshes: Array.from({ length: count }, (_, block) => meshBlock(field, block)) };
}

function blockOf(x: number, y: number, z: number): number {
  const [bx, by, bz] = [x, y, z].map((v) => Math.floor(v / blockEdge)) as Point;
  return bx + blockDims[0] * (by + blockDims[1] * bz);
}
