import { useEffect, useRef } from 'preact/hooks';

import { reviewText } from '../../text/review_text';
import type { ReviewSession } from '../../state/review/review_session';
import { excessN, shareOf, thrustLine } from '../../state/review/timeline';

/** The chart reaches at least this far, so that gentle sessions look gentle. */
const reachesN = 100;

/** The thrust over the whole session, above its timeline. */
export function ThrustChart({ session }: { session: ReviewSession }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const trace = session.trace.value;
  const durationS = session.durationS.value;
  const positionS = session.positionS.value;
  const mostN = trace === null ? reachesN : Math.max(reachesN, Math.ceil(Math.max(...trace.thrustN) / 20) * 20);
  useEffect(() => {
    const element = canvas.current;
    if (element === null || trace === null) return;
    const draw = () => {
      const onto = fitted(element);
      if (onto === null) return;
      const { clientWidth: width, clientHeight: height } = element;
      const colour = (name: string) => getComputedStyle(element).getPropertyValue(name).trim();
      const line = thrustLine(trace, durationS, width, height - 1, mostN);
      onto.fillStyle = colour('--force-fill');
      onto.strokeStyle = colour('--force');
      onto.beginPath();
      onto.moveTo(0, height);
      for (const { x, y } of line) onto.lineTo(x, y);
      onto.lineTo(line.at(-1)?.x ?? 0, height);
      onto.fill();
      onto.beginPath();
      for (const { x, y } of line) onto.lineTo(x, y);
      onto.stroke();
      const limit = height - (excessN / mostN) * height;
      onto.strokeStyle = colour('--warn');
      onto.setLineDash([4, 4]);
      onto.beginPath();
      onto.moveTo(0, limit);
      onto.lineTo(width, limit);
      onto.stroke();
    };
    draw();
    const scheme = window.matchMedia('(prefers-color-scheme: dark)');
    const resizes = new ResizeObserver(draw);
    resizes.observe(element);
    scheme.addEventListener('change', draw);
    return () => {
      resizes.disconnect();
      scheme.removeEventListener('change', draw);
    };
  }, [trace, durationS, mostN]);
  const problem = !session.mayReadTrace ? reviewText.noTraceForViewers : session.traceProblem.value;
  if (trace === null)
    return problem === null ? null : (
      <p class="thrust-none soft" data-testid="no-trace">
        {session.mayReadTrace ? reviewText.noTrace(problem) : problem}
      </p>
    );
  return (
    <div class="thrust-chart">
      <canvas ref={canvas} role="img" aria-label={reviewText.thrustChart(String(mostN))} data-testid="thrust-chart" />
      <span class="thrust-now" style={{ left: `${(shareOf(positionS, durationS) * 100).toFixed(2)}%` }} />
    </div>
  );
}

function fitted(canvas: HTMLCanvasElement): CanvasRenderingContext2D | null {
  const ratio = Math.min(window.devicePixelRatio, 2);
  canvas.width = Math.round(canvas.clientWidth * ratio);
  canvas.height = Math.round(canvas.clientHeight * ratio);
  const onto = canvas.getContext('2d');
  onto?.setTransform(ratio, 0, 0, ratio, 0, 0);
  return onto;
}
