import { useSignal } from '@preact/signals';
import { useEffect, useMemo } from 'preact/hooks';

import { caseText } from '../text/case_text';
import { planeNames } from '../ct/orientation';
import { CaseHeader } from '../panels/case/case_header';
import { SlicePanel, type ViewId } from '../panels/case/slice_panel';
import { StepsPanel } from '../panels/case/steps_panel';
import { SurfacePanel } from '../panels/case/surface_panel';
import { WindowBar } from '../panels/case/window_bar';
import { SliceView } from '../scene/slice_view';
import { SurfaceView } from '../scene/surface_view';
import { useShownName } from '../panels/common/use_shown_name';
import type { CaseController } from '../state/case/case_controller';
import { ViewMarks } from '../state/case/view_marks';
import type { Reaming } from '../state/practice_choice';
import { Button } from '../panels/common/button';

interface Parts {
  controller: CaseController;
  reaming: Reaming;
}

/** One case: its slices and surface, and the steps from the CT to the reamer. */
export function CasePage({ controller, reaming }: Parts) {
  const views = useMemo(() => new CaseViews(controller), [controller]);
  useEffect(() => () => views.dispose(), [views]);
  const enlarged = useSignal<ViewId | null>(null);
  const { store } = controller;
  const details = store.details.value;
  useShownName(details?.name || (details?.id ?? ''));
  const problem = store.loadProblem.value;
  if (problem !== null || details === null)
    return (
      <div class="page case-page-opening">
        <CaseHeader details={null} />
        <main class="case-note" data-testid="case-note">
          {problem === null ? (
            <p role="status">{caseText.loadingCase}</p>
          ) : (
            <p role="alert">
              <strong>{caseText.caseFailed}.</strong> {problem}{' '}
              <Button onClick={() => void controller.open()}>{caseText.tryAgain}</Button>
            </p>
          )}
        </main>
      </div>
    );
  const shown = (id: ViewId) => enlarged.value === null || enlarged.value === id;
  return (
    <div class="page case-page" onKeyDown={(event) => views.key(event)}>
      <CaseHeader details={details} />
      <main class={enlarged.value === null && details.ct !== null ? 'four-views' : 'one-view'}>
        {details.ct !== null &&
          planeNames
            .filter(shown)
            .map((name) => (
              <SlicePanel key={name} name={name} view={views.slices[name]} store={store} enlarged={enlarged} />
            ))}
        {(shown('surface') || details.ct === null) && (
          <SurfacePanel view={views.surface} store={store} enlarged={enlarged} />
        )}
      </main>
      {details.ct !== null && <WindowBar controller={controller} />}
      <StepsPanel controller={controller} reaming={reaming} />
    </div>
  );
}

/** The four views of one case, as long as its page is open. */
class CaseViews {
  readonly slices: Record<(typeof planeNames)[number], SliceView>;
  /** Null where the browser has no WebGL. */
  readonly surface: SurfaceView | null;

  constructor(private readonly controller: CaseController) {
    const marks = new ViewMarks(controller);
    const view = (name: (typeof planeNames)[number]) => new SliceView(controller, marks, name);
    this.slices = { axial: view('axial'), coronal: view('coronal'), sagittal: view('sagittal') };
    this.surface = surfaceView(controller, marks);
  }

  dispose(): void {
    for (const name of planeNames) this.slices[name].dispose();
    this.surface?.dispose();
  }

  /** Keys of the focused view, and of the landmarks wherever no text is written. */
  key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (target.matches('input, select, textarea')) return;
    const slice = Object.values(this.slices).find(({ canvas }) => canvas === target);
    if (slice?.key(event) === true || this.landmarkKey(event, target.matches('canvas'))) event.preventDefault();
  }

  private landmarkKey(event: KeyboardEvent, inView: boolean): boolean {
    if (event.ctrlKey || event.altKey || event.metaKey) return false;
    const { store } = this.controller;
    const armed = store.armed.value;
    const at = store.crossHairMm.value;
    if (/^[1-9]$/.test(event.key)) this.controller.chooseByNumber(Number(event.key));
    else if (event.key === 'Enter' && inView && armed !== null && at !== null) this.controller.placeArmed(at);
    else if (event.key === 'Delete' && armed?.kind === 'landmark') this.controller.place(armed.name, null);
    else if (event.key === 'Escape' && armed !== null) store.armed.value = null;
    else return false;
    return true;
  }
}

function surfaceView(controller: CaseController, marks: ViewMarks): SurfaceView | null {
  try {
    return new SurfaceView(controller, marks);
  } catch {
    return null;
  }
}
