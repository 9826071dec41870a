import { isDamage } from '../twin/part_file';

/** Why a session cannot be computed: its file is damaged, or this browser cannot, for want of memory or of WebAssembly. */
export type Obstacle = 'file' | 'browser';

export const obstacleOf = (error: unknown): Obstacle => (isDamage(error) ? 'file' : 'browser');
