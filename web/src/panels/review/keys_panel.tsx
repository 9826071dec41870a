import { reviewWords } from '../../review_words';

/** All keys of the page. */
export function KeysPanel() {
  return (
    <details class="review-panel">
      <summary>{reviewWords.keys}</summary>
      <dl class="review-keys">
        {reviewWords.keyList.map(([key, deed]) => (
          <div key={key}>
            <dt>{key}</dt>
            <dd>{deed}</dd>
          </div>
        ))}
      </dl>
    </details>
  );
}
