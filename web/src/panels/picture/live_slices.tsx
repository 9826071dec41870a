import '../../styles/live_slices.css';

import { useEffect, useMemo, useRef } from 'preact/hooks';

import { type PlaneName, planeNames } from '../../ct/orientation';
import { liveText } from '../../text/live_text';
import { LiveSlices } from '../../scene/live_slices';
import type { LiveCase } from '../../state/live_case';
import type { Store } from '../../state/store';

/** The CT beside the live picture, through the tip of the reamer; loaded when it is first opened. */
export function LiveSlicesPanel({ store, liveCase }: { store: Store; liveCase: LiveCase }) {
  const ct = liveCase.ct.value;
  const caseId = store.hello.value?.caseId ?? '';
  const slices = useMemo(() => (ct === null ? null : new LiveSlices(store, ct, caseId)), [store, ct, caseId]);
  useEffect(() => () => slices?.dispose(), [slices]);
  return (
    <section
      class="live-slices"
      aria-label={liveText.slices}
      aria-busy={slices?.pending.value ?? false}
      data-testid="live-slices"
    >
      {slices === null ? (
        <p class="soft slices-none">{liveCase.known.value ? liveText.noCt : liveText.ctLoading}</p>
      ) : (
        planeNames.map((name) => <Slice key={name} slices={slices} name={name} />)
      )}
      {slices !== null && slices.problem.value !== null && (
        <p class="slices-problem" role="status">
          {slices.problem.value}
        </p>
      )}
    </section>
  );
}

function Slice({ slices, name }: { slices: LiveSlices; name: PlaneName }) {
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const canvas = slices.canvas(name);
    if (canvas === undefined) return;
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', liveText.sliceLabel(liveText.section[name]));
    canvas.dataset.testid = `live-slice-${name}`;
    place.current?.prepend(canvas);
    return () => canvas.remove();
  }, [slices, name]);
  const { left, right, top, bottom } = slices.planes[name].letters;
  return (
    <div class="live-slice" ref={place}>
      <p class="slice-name">{liveText.section[name]}</p>
      <span class="slice-letter slice-left">{left}</span>
      <span class="slice-letter slice-right">{right}</span>
      <span class="slice-letter slice-top">{top}</span>
      <span class="slice-letter slice-bottom">{bottom}</span>
    </div>
  );
}
