import { useSignal } from '@preact/signals';

import { useFocusAfter } from './focus_after';
import { Button } from './button';

interface Parts {
  /** On the button that asks. */
  label: string;
  /** For screen readers, where the label does not say of what. */
  describe?: string;
  question: string;
  yes: string;
  no: string;
  testId: string;
  disabled?: boolean;
  onYes: () => void;
}

/** A button for what cannot be undone: it asks first. */
export function ConfirmButton({ label, describe, question, yes, no, testId, disabled, onYes }: Parts) {
  const confirming = useSignal(false);
  const button = useFocusAfter<HTMLButtonElement>(confirming.value);
  if (!confirming.value)
    return (
      <button
        type="button"
        class="plain-button"
        data-testid={testId}
        aria-label={describe}
        disabled={disabled}
        ref={button}
        onClick={() => (confirming.value = true)}
      >
        {label}
      </button>
    );
  return (
    <span
      class="confirm"
      role="alert"
      onKeyDown={(event) => {
        if (event.key === 'Escape') confirming.value = false;
      }}
    >
      {question}
      <button
        type="button"
        class="warn-button"
        data-testid={`confirm-${testId}`}
        disabled={disabled}
        ref={button}
        onClick={() => {
          confirming.value = false;
          onYes();
        }}
      >
        {yes}
      </button>
      <Button onClick={() => (confirming.value = false)}>{no}</Button>
    </span>
  );
}
