import { useSignal } from '@preact/signals';

import { pageText } from '../../text/page_text';
import { Button } from './button';

interface Parts {
  text: string;
  /** What is copied. */
  label?: string;
  /** Stand on it in place of the usual ones. */
  words?: string;
  testId?: string;
  onCopied?: () => void;
}

/** Copies a text; says on itself whether it could. */
export function CopyButton({ text, label, words, testId, onCopied }: Parts) {
  const copied = useSignal<boolean | null>(null);
  const copy = async () => {
    copied.value = await navigator.clipboard.writeText(text).then(
      () => true,
      () => false,
    );
    if (copied.value) onCopied?.();
  };
  const { copy: usual, copied: done, notCopied } = pageText;
  const said = copied.value === null ? (words ?? usual) : copied.value ? done : notCopied;
  // What is a status names no button.
  return (
    <Button testId={testId} label={copied.value === null ? (label ?? said) : said} onClick={() => void copy()}>
      <span role="status">{said}</span>
    </Button>
  );
}
