import { useEffect, useRef, useState } from 'preact/hooks';

import { dashboardText } from '../../text/dashboard_text';
import { type CurvePoint, drawnAtMost } from '../../state/dashboard/curve';
import { fixed } from '../../text/format';
import { OutcomeSign } from './outcome_mark';

const height = 150;
const left = 46;
const right = 14;
const top = 12;
const bottom = 24;

interface Parts {
  title: string;
  points: readonly CurvePoint[];
  value: (point: CurvePoint) => number | null;
  scale: { low: number; high: number };
  /** Lines across, with what they say; null: their value. */
  lines: readonly { at: number; name: string | null }[];
  decimals: number;
}

/** Values over sessions, each with the sign of its outcome, so that they are told apart without colours. */
export function CurveChart({ title, points, value, scale, lines, decimals }: Parts) {
  const place = useRef<HTMLDivElement>(null);
  const width = useWidth(place);
  const drawn = points.slice(-drawnAtMost);
  const first = points.length - drawn.length + 1;
  const step = drawn.length > 1 ? (width - left - right) / (drawn.length - 1) : 0;
  const x = (i: number) => (drawn.length > 1 ? left + i * step : (left + width - right) / 2);
  const y = (at: number) => top + ((scale.high - at) / (scale.high - scale.low)) * (height - top - bottom);
  const shown = drawn.flatMap((point, i) => {
    const at = value(point);
    return at === null ? [] : [{ point, at, x: x(i), y: y(at), number: first + i }];
  });
  const last = shown.at(-1);
  const every = Math.max(1, Math.ceil(drawn.length / 8));
  return (
    <figure class="curve">
      <figcaption>{title}</figcaption>
      <div ref={place}>
        <svg
          width={width}
          height={height}
          role="img"
          aria-label={dashboardText.chartLabel(title, points.length, fixed(last?.at, decimals))}
        >
          {lines.map((line) => (
            <g key={line.at} class="curve-line">
              <line x1={left} x2={width - right} y1={y(line.at)} y2={y(line.at)} class={line.name ? 'limit' : ''} />
              <text x={left - 8} y={y(line.at) + 4} text-anchor="end">
                {fixed(line.at, decimals)}
              </text>
              {line.name !== null && (
                <text x={width - right} y={y(line.at) - 5} text-anchor="end">
                  {line.name}
                </text>
              )}
            </g>
          ))}
          {drawn.map(
            (_, i) =>
              i % every === 0 && (
                <text key={i} x={x(i)} y={height - 6} text-anchor="middle">
                  {first + i}
                </text>
              ),
          )}
          <polyline points={shown.map((one) => `${one.x},${one.y}`).join(' ')} class="curve-line" />
          {shown.map((one) => (
            <g
              key={one.point.session}
              transform={`translate(${one.x} ${one.y})`}
              class={`outcome-${one.point.outcome ?? 'none'}`}
            >
              <circle r="8" class="curve-ground" />
              <OutcomeSign outcome={one.point.outcome} />
            </g>
          ))}
        </svg>
      </div>
    </figure>
  );
}

function useWidth(place: { current: HTMLElement | null }): number {
  const [width, setWidth] = useState(480);
  useEffect(() => {
    const element = place.current;
    if (element === null) return;
    const observer = new ResizeObserver(() => setWidth(Math.max(200, element.clientWidth)));
    observer.observe(element);
    return () => observer.disconnect();
  }, [place]);
  return width;
}
