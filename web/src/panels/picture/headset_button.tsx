import { liveText } from '../../text/live_text';
import type { Headset } from '../../scene/headset';

/** Puts the picture into a headset, where this computer has one. */
export function HeadsetButton({ headset, putOn }: { headset: Headset; putOn: () => void }) {
  if (!headset.available.value) return null;
  const worn = headset.worn.value;
  return (
    <>
      <button
        type="button"
        class={worn ? 'tool-on' : ''}
        data-testid="headset"
        aria-pressed={worn}
        title={liveText.headsetHint}
        onClick={() => (worn ? void headset.takeOff() : putOn())}
      >
        {worn ? liveText.headsetOff : liveText.headset}
      </button>
      {headset.problem.value !== null && (
        <p class="headset-problem" role="alert" data-testid="headset-problem">
          {liveText.headsetRefused(headset.problem.value)}
        </p>
      )}
    </>
  );
}
