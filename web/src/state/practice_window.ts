import type { Practice, PracticeWindow } from './practice';

/** The browser's own window. */
export function browserWindow(): PracticeWindow {
  return {
    attended: () => !document.hidden && document.hasFocus(),
    gamepad: () => {
      const pads = navigator.getGamepads().filter((pad) => pad !== null);
      return pads.find((pad) => pad.mapping === 'standard') ?? pads[0] ?? null;
    },
    nowMs: () => performance.now(),
    remembered: window.sessionStorage,
  };
}

/** A page that is hidden, left or loses the keys has no hand at the tool. */
export function letGoWhenLeft(practice: Practice): void {
  document.addEventListener('visibilitychange', () => {
    if (document.hidden) practice.letGo();
  });
  window.addEventListener('blur', () => practice.letGo());
  window.addEventListener('pagehide', () => practice.letGo());
}
