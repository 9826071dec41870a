import { liveText } from '../../text/live_text';

interface ToggleParts {
  id: string;
  letter: string;
  hint: string;
  on: boolean;
  onToggle: () => void;
  children: string;
}

/** One of the buttons under the picture that is on or off, also by its key. */
export function ViewToggle({ id, letter, hint, on, onToggle, children }: ToggleParts) {
  return (
    <button
      type="button"
      class={on ? 'tool-on' : ''}
      data-testid={id}
      aria-pressed={on}
      aria-keyshortcuts={letter}
      title={liveText.key(hint, letter)}
      onClick={onToggle}
    >
      {children}
    </button>
  );
}
