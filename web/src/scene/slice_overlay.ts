import type { PicturePoint, SliceLayout } from '../ct/slice_layout';
import { add, dot, length, type VolumeFrame } from '../ct/volume_frame';
import type { PlanMark, PointMark } from '../state/case/view_marks';
import type { Triple } from '../wire/rest_types';

/** Marks at most this far off the slice are drawn as lying in it and can be taken hold of, mm. */
export const inSliceMm = 2;
/** Those up to here are drawn faintly. */
const nearSliceMm = 15;
/** How close to a mark a pointer takes hold of it, px. */
const gripPx = 12;
const axisLengthMm = { outside: 45, inside: 30 };
const crossHairGapPx = 9;

export interface OverlayWanted {
  frame: VolumeFrame;
  layout: SliceLayout;
  crossHair: Triple;
  points: readonly PointMark[];
  plan: PlanMark | null;
  crossHairColours: { across: string; along: string };
  widthPx: number;
  heightPx: number;
}

/** Cross-hair, placed points and the plan, over a slice. */
export function drawOverlay(onto: CanvasRenderingContext2D, wanted: OverlayWanted): void {
  drawCrossHair(onto, wanted);
  if (wanted.plan !== null) drawPlan(onto, wanted, wanted.plan);
  for (const mark of wanted.points) drawPoint(onto, wanted, mark);
}

/** The mark under a place of the picture that lies in the slice. */
export function markAt(at: PicturePoint, { frame, layout, crossHair, points }: OverlayWanted): PointMark | null {
  const near = points
    .filter((mark) => layout.offSliceMm(frame.voxelFromWorld(mark.point), crossHair) <= inSliceMm)
    .map((mark) => {
      const { x, y } = layout.pointToPicture(mark.point);
      return { mark, px: Math.hypot(x - at.x, y - at.y) };
    })
    .filter(({ px }) => px <= gripPx)
    .sort((a, b) => a.px - b.px);
  return near[0]?.mark ?? null;
}

function drawCrossHair(
  onto: CanvasRenderingContext2D,
  { layout, crossHair, crossHairColours, ...size }: OverlayWanted,
) {
  const { x, y } = layout.toPicture(crossHair);
  onto.lineWidth = 1;
  onto.globalAlpha = 0.85;
  stroke(onto, crossHairColours.across, [
    [0, y, x - crossHairGapPx, y],
    [x + crossHairGapPx, y, size.widthPx, y],
  ]);
  stroke(onto, crossHairColours.along, [
    [x, 0, x, y - crossHairGapPx],
    [x, y + crossHairGapPx, x, size.heightPx],
  ]);
  onto.globalAlpha = 1;
}

function stroke(onto: CanvasRenderingContext2D, colour: string, lines: [number, number, number, number][]): void {
  onto.strokeStyle = colour;
  onto.beginPath();
  for (const [x0, y0, x1, y1] of lines) {
    onto.moveTo(x0, y0);
    onto.lineTo(x1, y1);
  }
  onto.stroke();
}

function drawPoint(onto: CanvasRenderingContext2D, { frame, layout, crossHair }: OverlayWanted, mark: PointMark): void {
  const off = layout.offSliceMm(frame.voxelFromWorld(mark.point), crossHair);
  const at = layout.pointToPicture(mark.point);
  if (mark.ballRadiusMm > off) {
    onto.strokeStyle = '#ffd166';
    onto.lineWidth = 1.5;
    circle(onto, at, Math.sqrt(mark.ballRadiusMm ** 2 - off ** 2) * layout.look.pxPerMm);
    onto.stroke();
  }
  if (off > nearSliceMm) return;
  const inSlice = off <= inSliceMm;
  onto.globalAlpha = inSlice ? 1 : 0.45;
  circle(onto, at, mark.of.kind === 'entry' ? 7 : 5);
  onto.lineWidth = 3;
  onto.strokeStyle = '#10161a';
  onto.stroke();
  onto.lineWidth = 1.75;
  onto.strokeStyle = mark.active ? '#ffffff' : '#ffd166';
  onto.stroke();
  if (inSlice && mark.active) {
    onto.fillStyle = mark.of.kind === 'entry' ? '#2dd4a7' : '#ff8c42';
    onto.fill();
  }
  onto.font = '600 12px system-ui, sans-serif';
  onto.lineWidth = 3;
  onto.strokeStyle = '#10161a';
  onto.strokeText(mark.text, at.x + 8, at.y - 7);
  onto.fillStyle = mark.active ? '#ffffff' : '#ffd166';
  onto.fillText(mark.text, at.x + 8, at.y - 7);
  onto.globalAlpha = 1;
}

function circle(onto: CanvasRenderingContext2D, { x, y }: PicturePoint, radius: number): void {
  onto.beginPath();
  onto.arc(x, y, radius, 0, Math.PI * 2);
}

/** The axis as it is seen from in front of the slice, and the reamer at its planned depth where it meets the slice. */
function drawPlan(onto: CanvasRenderingContext2D, { layout }: OverlayWanted, plan: PlanMark): void {
  const along = (mm: number) => layout.pointToPicture(add(plan.entry, plan.direction, mm));
  onto.setLineDash(plan.kept ? [] : [6, 4]);
  onto.strokeStyle = '#2dd4a7';
  onto.lineWidth = 1.5;
  polyline(onto, [along(-axisLengthMm.outside), along(axisLengthMm.inside)]);
  onto.lineWidth = 4;
  polyline(onto, [along(0), along(plan.depthMm)]);
  const across = inPictureAcross(layout, plan);
  if (across !== null) {
    onto.lineWidth = 1.75;
    const side = (sign: 1 | -1) =>
      plan.outline.map(({ offAxisMm, behindMm }) =>
        layout.pointToPicture(add(add(plan.entry, plan.direction, plan.depthMm - behindMm), across, sign * offAxisMm)),
      );
    polyline(onto, [...side(-1).reverse(), ...side(1)]);
  }
  onto.setLineDash([]);
}

/** Unit direction within the slice and square to the axis; null where the slice cuts the axis too squarely to show it. */
function inPictureAcross(layout: SliceLayout, plan: PlanMark): Triple | null {
  const zero = layout.pointToPicture([0, 0, 0]);
  const units: Triple[] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  const px = units.map((unit) => {
    const at = layout.pointToPicture(unit);
    return { x: at.x - zero.x, y: at.y - zero.y };
  });
  const scale = layout.look.pxPerMm ** 2;
  const row = (of: 'x' | 'y'): Triple => [px[0]?.[of] ?? 0, px[1]?.[of] ?? 0, px[2]?.[of] ?? 0];
  const [right, down] = [row('x'), row('y')];
  const r = dot(plan.direction, right) / scale;
  const d = dot(plan.direction, down) / scale;
  const raw = add(add([0, 0, 0], right, -d), down, r);
  const size = length(raw);
  const inPlaneShare = Math.hypot(r, d) * layout.look.pxPerMm;
  return size < 1e-9 || inPlaneShare < 0.6 ? null : add([0, 0, 0], raw, 1 / size);
}

function polyline(onto: CanvasRenderingContext2D, points: readonly PicturePoint[]): void {
  onto.beginPath();
  points.forEach(({ x, y }, i) => (i === 0 ? onto.moveTo(x, y) : onto.lineTo(x, y)));
  onto.stroke();
}
