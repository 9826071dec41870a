import type { PlaybackChange } from '../wire/rest_types';
import type { Playback } from '../wire/messages';

/** Longer pauses are those of a computer that slept: nobody watched. */
const maxStepMs = 250;

/** Where a recording stands and how it moves on, as a server's replay does (session/replay/playhead.hpp). */
export class FilePlayback {
  private at = 0;
  private speed = 1;
  private playing = false;
  private jumps = 0;

  constructor(private readonly durationTicks: number) {}

  change({ playing, speed, position_s: positionS }: PlaybackChange): void {
    if (speed !== undefined && speed > 0) this.speed = speed;
    if (positionS !== undefined) this.jumpTo(Math.round(positionS * 1000));
    if (playing === true && this.at >= this.durationTicks && positionS === undefined) this.jumpTo(0);
    if (playing !== undefined) this.playing = playing;
    if (speed === 0) this.playing = false;
  }

  /** Lets time pass; at the end it rests. */
  advance(ms: number): void {
    if (!this.playing) return;
    this.at = Math.min(this.at + Math.min(ms, maxStepMs) * this.speed, this.durationTicks);
    if (this.at >= this.durationTicks) this.playing = false;
  }

  /** It cannot go on from there. */
  restAt(ticks: number): void {
    this.at = ticks;
    this.playing = false;
  }

  get now(): Playback {
    return { positionTicks: Math.floor(this.at), speed: this.speed, playing: this.playing, jump: this.jumps };
  }

  private jumpTo(ticks: number): void {
    this.at = Math.min(Math.max(ticks, 0), this.durationTicks);
    ++this.jumps;
  }
}
