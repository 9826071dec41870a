import { accessText } from '../../text/access_text';
import { CopyButton } from './copy_button';

/** A secret that is shown once, to be copied. */
export function SecretOnce({ label, text, testId }: { label: string; text: string; testId: string }) {
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
      <CopyButton text={text} />
    </div>
  );
}
