import { PartFileError } from '../twin/part_file';

/** Why a session cannot be computed: its file is damaged, or this browser cannot, for want of memory or of WebAssembly. */
export type Obstacle = 'file' | 'browser';

/** The second is what DecompressionStream throws. */
export const obstacleOf = (error: unknown): Obstacle =>
  error instanceof PartFileError || error instanceof TypeError ? 'file' : 'browser';
