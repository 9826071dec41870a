import type { Signal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';

import { caseText } from '../../text/case_text';
import type { SurfaceView } from '../../scene/surface_view';
import type { CaseStore, SurfaceState } from '../../state/case/case_store';
import { appText } from '../../text/app_text';
import { type ViewId, ViewHead } from './slice_panel';

interface Parts {
  /** Null where the browser has no WebGL. */
  view: SurfaceView | null;
  store: CaseStore;
  enlarged: Signal<ViewId | null>;
}

const looks = [
  ['side', caseText.viewSide],
  ['front', caseText.viewFront],
  ['glenoid', caseText.viewGlenoid],
] as const;

/** The bone's surface with its set views, and the numbers of the placed landmarks beside them. */
export function SurfacePanel({ view, store, enlarged }: Parts) {
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (view === null) return undefined;
    const { canvas } = view;
    canvas.setAttribute('role', 'application');
    canvas.setAttribute('aria-label', caseText.surfaceLabel);
    canvas.dataset.testid = 'surface-canvas';
    place.current?.prepend(canvas);
    return () => canvas.remove();
  }, [view]);
  const state = store.surface.value;
  const at = store.crossHairMm.value;
  const lost = view?.lost.value ?? false;
  const note = view === null ? caseText.surfaceNoWebGl : lost ? appText.pictureLost : noteOf(state);
  return (
    <section class="view" aria-label={caseText.surface}>
      <ViewHead id="surface" title={caseText.surface} enlarged={store.details.value?.ct ? enlarged : null}>
        {view !== null &&
          looks.map(([name, label]) => (
            <button
              type="button"
              key={name}
              class="view-look"
              data-testid={`look-${name}`}
              disabled={state.kind !== 'shown' || (name === 'glenoid' && view.glenoid() === null)}
              onClick={() => view.look(name)}
            >
              {label}
            </button>
          ))}
      </ViewHead>
      <div
        class={lost ? 'view-canvas stage picture-lost' : 'view-canvas stage'}
        ref={place}
        data-testid="surface"
        data-state={state.kind}
      >
        {view?.labels.value.map(({ x, y, text, active }) => (
          <span
            key={text}
            class={active ? 'point-label active' : 'point-label'}
            style={{ left: `${x}px`, top: `${y}px` }}
            aria-hidden="true"
          >
            {text}
          </span>
        ))}
        {at !== null && (
          <p class="cross-hair-place" data-testid="cross-hair-place">
            {caseText.place(at, store.crossHairHu.value)}
          </p>
        )}
        {note !== null && (
          <p class="view-note" role="status">
            {note}
          </p>
        )}
      </div>
    </section>
  );
}

function noteOf(state: SurfaceState): string | null {
  switch (state.kind) {
    case 'none':
      return caseText.surfaceNone;
    case 'loading':
      return caseText.surfaceLoading;
    case 'failed':
      return caseText.surfaceFailed(state.message);
    case 'shown':
      return null;
  }
}
