import { useSignal } from '@preact/signals';

import { pageText } from '../../text/page_text';
import { Button } from './button';

/** Copies a text; says on itself whether it could. `label` says what is copied. */
export function CopyButton({ text, label, testId }: { text: string; label?: string; testId?: string }) {
  const copied = useSignal<boolean | null>(null);
  const copy = async () => {
    copied.value = await navigator.clipboard.writeText(text).then(
      () => true,
      () => false,
    );
  };
  const { copy: before, copied: done, notCopied } = pageText;
  return (
    <Button testId={testId} label={copied.value === null ? label : undefined} onClick={() => void copy()}>
      <span role="status">{copied.value === null ? before : copied.value ? done : notCopied}</span>
    </Button>
  );
}
