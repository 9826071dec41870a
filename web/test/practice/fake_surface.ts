import { Vector3 } from 'three';

import type { PlanFrame } from '../../src/practice/plan_frame';
import type { SteeredView } from '../../src/practice/pointer_hand';

type Listener = (event: never) => void;

/** The picture's element without a browser: 400 by 400 pixels at the window's corner. */
export class FakeSurface {
  private readonly listeners = new Map<string, Listener[]>();
  captured: number[] = [];

  addEventListener = (type: string, listener: unknown): void => {
    this.listeners.set(type, [...(this.listeners.get(type) ?? []), listener as Listener]);
  };
  setPointerCapture = (id: number): void => {
    this.captured.push(id);
  };
  getBoundingClientRect = () => ({ left: 0, top: 0, right: 400, bottom: 400, width: 400, height: 400 }) as DOMRect;

  /** Gives the event to whoever listens; whether its default was prevented. */
  fire(type: string, event: object): boolean {
    let prevented = false;
    const whole = {
      pointerType: 'mouse',
      pointerId: 1,
      button: 0,
      buttons: 0,
      clientX: 200,
      clientY: 200,
      preventDefault: () => (prevented = true),
      ...event,
    };
    for (const listener of this.listeners.get(type) ?? []) listener(whole as never);
    return prevented;
  }
}

/** Looks along the planned axis from 200 mm before the entry: 10 pixels a mm, the entry at (200, 200). */
export class FakeView implements SteeredView {
  turned: [number, number][] = [];
  zoomed: number[] = [];

  constructor(private readonly plan: PlanFrame) {}

  rayAt = (clientX: number, clientY: number) => {
    const { entry, axis } = this.plan;
    const { right, up } = this.directions();
    const origin = entry.clone().addScaledVector(axis, -200);
    const looked = entry
      .clone()
      .addScaledVector(right, (clientX - 200) / 10)
      .addScaledVector(up, (200 - clientY) / 10);
    return { origin, direction: looked.sub(origin).normalize() };
  };
  screenAxes = (plan: PlanFrame) => {
    const { right, up } = this.directions();
    return { right: plan.beside(right), up: plan.beside(up) };
  };
  turnBy = (rightPx: number, downPx: number) => void this.turned.push([rightPx, downPx]);
  zoomBy = (factor: number) => void this.zoomed.push(factor);

  private directions(): { right: Vector3; up: Vector3 } {
    return { right: this.plan.anterior.clone(), up: this.plan.superior.clone() };
  }
}
