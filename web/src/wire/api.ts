import type { SessionState } from './messages';
import { request, requestJson } from './rest';

export { ApiError } from './rest';

/** A session as REST describes it. */
export interface Session {
  id: string;
  case: string;
  script: string;
  state: SessionState;
  created_utc: string;
  tick: number;
  duration_s: number;
  force_scale: number;
  fault: string | null;
  loop?: Partial<LoopHealth>;
  device?: DeviceHealth;
  /** False for sessions of earlier runs of the server, which are only in their folders; absent means true. */
  streamable?: boolean;
  /** Who trains, for people: a name, or a participant's code where the name is not for this user. */
  trainee?: string | null;
  /** What people call it. */
  title?: string | null;
  study?: string | null;
  participant?: string | null;
  /** 2 after the first reset, and so on. */
  attempt?: number;
  reset_of?: string | null;
  /** Nothing but the bone is shown to who reams; servers of earlier versions do not tell. */
  theatre?: boolean;
  /** Paused by the server's word, so that it goes on by that too. */
  held?: boolean;
}

/** Times of one kind since the session began, us. */
export interface Timing {
  p50_us: number;
  p99_us: number;
  p999_us: number;
  max_us: number;
}

/** How the haptic loop has kept its time; servers of earlier versions tell less. */
export interface LoopHealth extends Timing {
  mean_us: number;
  /** Ticks that began more than a millisecond late. */
  missed: number;
  /** Of the ticks' beginnings. */
  lateness: Timing;
  realtime: boolean;
}

/** How the session's device is doing. */
export interface DeviceHealth {
  /** script, network, browser, ... */
  name: string;
  /** fresh, held, fading or lost; null before the first tick. */
  state: string | null;
  rtt_ms: number | null;
}

/** A recording that is shown on the server for all who watch it. */
export interface Replay {
  id: string;
  /** The session that was recorded. */
  replay_of: string;
  playback: { position_s: number; duration_s: number; speed: number; playing: boolean };
  /** What of the recording is damaged, as far as the server has read it. */
  warning: string | null;
  /** Moments worth finding, in order of time. */
  marks: Mark[];
}

export interface Mark {
  at_s: number;
  /** "annotation", "reamer", "resume", "damaged" or the name of an event. */
  kind: string;
  words: string;
}

/** What is absent stays as it is. */
export interface PlaybackChange {
  playing?: boolean;
  speed?: number;
  position_s?: number;
}

/** The figures of a session that the page shows; more are sent. */
export interface Metrics {
  removed_volume_mm3: number;
  removed_volume_cortical_mm3: number;
  removed_volume_cancellous_mm3: number;
  reaming_depth_mm: number;
  axial_thrust_mean_n: number;
  axial_thrust_peak_n: number;
  duration_s: number;
  /** How far pegs would reach through the outer cortex; servers of earlier versions do not tell. */
  vault_breach_mm?: number | null;
}

/** Calls of the REST interface under `base` (the page's own server by default). */
export class Api {
  constructor(private readonly base: string) {}

  async sessions(): Promise<Session[]> {
    return (await this.call<{ sessions: Session[] }>('GET', 'sessions')).sessions;
  }
  createDemo(): Promise<Session> {
    return this.call('POST', 'sessions', { case: 'demo', script: 'demo', device: 'script' });
  }
  /** A session on a case that waits for a hand in a browser. */
  createPractice(caseId: string, theatre: boolean): Promise<Session> {
    return this.call('POST', 'sessions', { case: caseId, device: 'browser', ...(theatre ? { theatre } : {}) });
  }
  /** A session of a study; participant null: the user. */
  createInStudy(study: string, participant: string | null, caseId: string): Promise<Session> {
    return this.call('POST', 'sessions', { study, case: caseId, ...(participant === null ? {} : { participant }) });
  }
  /** Throws, in the server's words, while it still prepares for sessions. */
  async ready(): Promise<void> {
    await request(`${this.base}/readyz`, 'GET');
  }
  session(id: string): Promise<Session> {
    return this.call('GET', `sessions/${encodeURIComponent(id)}`);
  }
  start(id: string): Promise<Session> {
    return this.call('POST', `sessions/${encodeURIComponent(id)}/start`);
  }
  stop(id: string): Promise<Session> {
    return this.call('POST', `sessions/${encodeURIComponent(id)}/stop`);
  }
  pause(id: string): Promise<Session> {
    return this.call('POST', `sessions/${encodeURIComponent(id)}/pause`);
  }
  /** Another session of the same kind on intact bone; the one before ends. */
  reset(id: string): Promise<Session> {
    return this.call('POST', `sessions/${encodeURIComponent(id)}/reset`);
  }
  openReplay(sessionId: string): Promise<Replay> {
    return this.call('POST', `sessions/${encodeURIComponent(sessionId)}/replay`);
  }
  replay(id: string): Promise<Replay> {
    return this.call('GET', `sessions/${encodeURIComponent(id)}`);
  }
  changePlayback(id: string, change: PlaybackChange): Promise<Replay> {
    return this.call('POST', `sessions/${encodeURIComponent(id)}/playback`, change);
  }
  metrics(id: string): Promise<Metrics> {
    return this.call('GET', `sessions/${encodeURIComponent(id)}/metrics`);
  }
  streamUrl(id: string): string {
    return this.socketUrl(id, 'stream');
  }
  deviceUrl(id: string): string {
    return this.socketUrl(id, 'device');
  }

  private socketUrl(id: string, what: string): string {
    return `${this.base.replace(/^http/, 'ws')}/api/v1/sessions/${encodeURIComponent(id)}/${what}`;
  }

  private call<T>(method: 'GET' | 'POST', path: string, body?: object): Promise<T> {
    return requestJson(`${this.base}/api/v1/${path}`, method, { body });
  }
}
