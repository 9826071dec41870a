import { useSignal } from '@preact/signals';

import { accessText } from '../../text/access_text';
import { Button } from './button';

/** A secret that is shown once, to be copied. */
export function SecretOnce({ label, text, testId }: { label: string; text: string; testId: string }) {
  const copied = useSignal<boolean | null>(null);
  const copy = async () => {
    copied.value = await navigator.clipboard.writeText(text).then(
      () => true,
      () => false,
    );
  };
  return (
    <div class="secret" role="status">
      <p>{accessText.secretOnce}</p>
      <input
        type="text"
        readOnly
        aria-label={label}
        data-testid={testId}
        value={text}
        onFocus={(event) => event.currentTarget.select()}
      />
      <Button onClick={() => void copy()}>
        {copied.value === null ? accessText.copy : copied.value ? accessText.copied : accessText.notCopied}
      </Button>
    </div>
  );
}
