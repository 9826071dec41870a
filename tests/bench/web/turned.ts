/** How a page drew while its camera turned. */
export interface Turned {
  pictures: number;
  /** Until the last of them was complete. */
  seconds: number;
}
