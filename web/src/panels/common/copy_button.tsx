import { useSignal } from '@preact/signals';

import { pageText } from '../../text/page_text';
import { Button } from './button';

/** Copies a text; says on itself whether it could. `label` says what is copied, `words` stand on it in place of the usual ones. */
export function CopyButton({
  text,
  label,
  words,
  testId,
}: {
  text: string;
  label?: string;
  words?: string;
  testId?: string;
}) {
  const copied = useSignal<boolean | null>(null);
  const copy = async () => {
    copied.value = await navigator.clipboard.writeText(text).then(
      () => true,
      () => false,
    );
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
