import { reviewText } from '../../text/review_text';

/** All keys of the page. */
export function KeysPanel() {
  return (
    <details class="review-panel">
      <summary>{reviewText.keys}</summary>
      <dl class="review-keys">
        {reviewText.keyList.map(([key, action]) => (
          <div key={key}>
            <dt>{key}</dt>
            <dd>{action}</dd>
          </div>
        ))}
      </dl>
    </details>
  );
}
