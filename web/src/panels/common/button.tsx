import type { ComponentChildren } from 'preact';

interface Parts {
  /** Beside others, for what the form is for, or for what cannot be undone. */
  look?: 'plain' | 'main' | 'warn';
  /** Sends its form. */
  submit?: boolean;
  testId?: string;
  /** Where its words alone do not say what it is about. */
  label?: string;
  title?: string;
  disabled?: boolean;
  pressed?: boolean;
  onClick?: () => void;
  children: ComponentChildren;
}

export function Button({ look = 'plain', submit, testId, label, title, disabled, pressed, onClick, children }: Parts) {
  return (
    <button
      type={submit === true ? 'submit' : 'button'}
      class={`${look}-button`}
      data-testid={testId}
      aria-label={label}
      aria-pressed={pressed}
      {...{ title, disabled, onClick }}
    >
      {children}
    </button>
  );
}
