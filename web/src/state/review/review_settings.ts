import { signal } from '@preact/signals';

import { ViewSettings } from '../view_settings';
import type { ScaleName } from './deviation_scale';

/** What is chosen for all sessions that are reviewed beside each other. */
export class ReviewSettings {
  readonly view = new ViewSettings();
  readonly reamerShown = signal(true);
  readonly scale = signal<ScaleName>('report');
  /** Places that are pointed at are measured. */
  readonly measuring = signal(false);
  readonly slicesOpen = signal(false);
  /** The session that keys are for, by its place. */
  readonly active = signal(0);
}
