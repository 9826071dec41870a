import { type ReadonlySignal, signal } from '@preact/signals';

export interface ContextWatch {
  /** The browser has taken the picture away: nothing can be drawn until it gives it back. */
  lost: ReadonlySignal<boolean>;
  dispose(): void;
}

/**
 * Follows whether the browser lets a canvas be drawn with WebGL. Graphics drivers that are reset and browsers with many
 * pictures take it away, and mostly give it back. `onRestored`: everything is to be drawn anew.
 */
export function watchContext(canvas: EventTarget, onRestored: () => void): ContextWatch {
  const lost = signal(false);
  const take = (event: Event) => {
    // Else the browser would never give it back.
    event.preventDefault();
    lost.value = true;
  };
  const give = () => {
    lost.value = false;
    onRestored();
  };
  canvas.addEventListener('webglcontextlost', take);
  canvas.addEventListener('webglcontextrestored', give);
  return {
    lost,
    dispose: () => {
      canvas.removeEventListener('webglcontextlost', take);
      canvas.removeEventListener('webglcontextrestored', give);
    },
  };
}
