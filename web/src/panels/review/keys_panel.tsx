import { reviewText } from '../../text/review_text';

/** CT slices, and the second of two sessions. */
const keysWithServerOnly: readonly string[] = ['T', 'Q'];

/** All keys of the page; `served`: also those of what only a server has. */
export function KeysPanel({ served = true }: { served?: boolean }) {
  return (
    <details class="review-panel">
      <summary>{reviewText.keys}</summary>
      <dl class="review-keys">
        {reviewText.keyList
          .filter(([key]) => served || !keysWithServerOnly.includes(key))
          .map(([key, action]) => (
            <div key={key}>
              <dt>{key}</dt>
              <dd>{action}</dd>
            </div>
          ))}
      </dl>
    </details>
  );
}
