// Answers of the REST interface as they are where a test says nothing else.
import type { Annotation, Metrics, Replay, Session } from '../../src/wire/rest_types';

const times = { mean_us: 0, p50_us: 0, p99_us: 0, p999_us: 0, max_us: 0 };

export const someSession = (changes: Partial<Session> = {}): Session => ({
  ...{ id: 'abcd', kind: 'session', case: 'demo', script: 'demo', state: 'running', held: false, keep: false },
  ...{ created_utc: '2026-01-01T00:00:00Z', tick: 0, duration_s: 0, force_scale: 1, fault: null, streamable: true },
  ...{
    score: null,
    trainee_id: null,
    trainee: null,
    study: null,
    participant: null,
    phase: null,
    title: null,
    theatre: false,
  },
  ...{ reset_of: null, attempt: 1, followed_by: null, device: someDevice('script') },
  loop: {
    ...times,
    ...{ missed: 0, lateness: times, read: times, step: times, write: times },
    ...{ realtime: false, memory_locked: false, cpu: null },
  },
  ...changes,
});

export const someDevice = (name: string): Session['device'] => ({
  ...{ name, profile: 'ideal', state: null, rtt_ms: null, received: 0, missing: 0, late: 0, refused: 0 },
});

export const someReplay = (changes: Partial<Replay> = {}): Replay => ({
  ...{ id: 'r1', kind: 'replay', replay_of: 'abcd', case: 'demo', script: 'demo', state: 'replaying', tick: 0 },
  ...{ created_utc: '2026-01-01T00:00:00Z', duration_s: 10, force_scale: 1, fault: null, warning: null },
  playback: { position_s: 0, duration_s: 10, speed: 1, playing: false },
  marks: [],
  ...changes,
});

export const someMetrics = (changes: Partial<Metrics> = {}): Metrics => ({
  ...{ removed_volume_mm3: 1, removed_volume_cortical_mm3: 1, removed_volume_cancellous_mm3: 0, reaming_depth_mm: 1 },
  ...{ axial_thrust_mean_n: 1, axial_thrust_peak_n: 1, weakened_time_s: 0, apparent_stiffness_n_mm: null },
  ...{ duration_s: 1, force_scale: 1, grid_hash: null, session_hash: '0123456789abcdef' },
  ...changes,
});

export const someAnnotation = (at_s: number, words: string): Annotation => ({
  ...{ utc: '2026-01-01T00:00:00Z', at_s, words, author: '', place_mm: null },
});
