import { reviewText } from '../../text/review_text';

/** All keys of the page; `served`: also those of what only a server has. */
export function KeysPanel({ served = true }: { served?: boolean }) {
  return (
    <details class="review-panel">
      <summary>{reviewText.keys}</summary>
      <dl class="review-keys">
        {reviewText.keyList
          .filter(([key]) => served || !reviewText.keysOfServed.includes(key))
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
