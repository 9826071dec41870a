import type { PlaybackChange } from '../wire/rest_types';
import type { Scrubber } from './scrubber';

/** What plays a recording. */
export interface Player {
  /** Goes to moments of it. */
  readonly scrubber: Scrubber;
  /** Plays, rests or changes the speed; problems are shown elsewhere. */
  play(change: PlaybackChange): Promise<void>;
}
