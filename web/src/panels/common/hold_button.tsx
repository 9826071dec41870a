import type { ComponentChildren } from 'preact';
import { useEffect } from 'preact/hooks';

interface HoldButton {
  class: string;
  id: string;
  /** Called with true while it is held by pointer or key, and with false when that ends in whatever way. */
  onHold: (held: boolean) => void;
  /** The pointer has gone up; not called for keys. */
  onPointerDone: () => void;
  children: ComponentChildren;
}

/** A button that acts only while it is held. */
export function HoldButton({ class: look, id, onHold, onPointerDone, children }: HoldButton) {
  useEffect(() => () => onHold(false), []);
  const release = () => onHold(false);
  const isPress = (event: KeyboardEvent) => event.key === ' ' || event.key === 'Enter';
  return (
    <button
      type="button"
      class={look}
      data-testid={id}
      onPointerDown={(event) => {
        if (event.button === 0) onHold(true);
      }}
      onPointerUp={() => {
        release();
        onPointerDone();
      }}
      onPointerCancel={release}
      onPointerLeave={release}
      onBlur={release}
      onContextMenu={(event) => event.preventDefault()}
      onKeyDown={(event) => {
        if (isPress(event)) onHold(true);
      }}
      onKeyUp={(event) => {
        if (isPress(event)) release();
      }}
    >
      {children}
    </button>
  );
}
