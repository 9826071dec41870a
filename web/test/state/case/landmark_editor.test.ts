import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { LandmarkEditor } from '../../../src/state/case/landmark_editor';
import { landmarksOf, nextMissing, placedFrom, sameLandmarks, withPoint } from '../../../src/state/case/landmark_names';
import type { Case, Landmarks, Measures } from '../../../src/wire/rest_types';
import { ApiError } from '../../../src/wire/rest';

class FakeLandmarks {
  onServer: Landmarks | null = null;
  down = false;
  puts: Landmarks[] = [];
  left: Landmarks | null = null;
  measured = 0;

  private answer<T>(value: () => T): Promise<T> {
    return this.down ? Promise.reject(new ApiError('no answer', 0)) : Promise.resolve().then(value);
  }
  case = () => this.answer(() => ({ landmarks: this.onServer }) as Case);
  putLandmarks = (_id: string, landmarks: Landmarks) =>
    this.answer(() => {
      this.puts.push(landmarks);
      this.onServer = landmarks;
      return { landmarks } as Case;
    });
  measures = () => this.answer(() => ({ version_3d_deg: ++this.measured }) as Measures);
  putLandmarksOnLeaving = (_id: string, landmarks: Landmarks) => {
    this.left = landmarks;
  };
}

let api: FakeLandmarks;
let controller: LandmarkEditor;
const settle = () => vi.advanceTimersByTimeAsync(1000);
const place = (y: number) => controller.change(withPoint(controller.landmarks.value, 'glenoid_centre_mm', [0, y, 0]));

beforeEach(async () => {
  vi.useFakeTimers();
  api = new FakeLandmarks();
  controller = new LandmarkEditor(api, 'c', () => undefined);
  controller.take(null);
  await settle();
});
afterEach(() => vi.useRealTimers());

describe('LandmarkEditor', () => {
  it('saves once after a burst of changes, and measures what was saved', async () => {
    for (let y = 0; y < 10; ++y) place(y);
    expect(controller.save.value.kind).toBe('unsaved');
    expect(controller.measured.value).toBe(false);
    expect(controller.hasSaved.value).toBe(false);
    await settle();
    expect(controller.hasSaved.value).toBe(true);
    expect(api.puts).toEqual([{ glenoid_centre_mm: [0, 9, 0] }]);
    expect(controller.save.value.kind).toBe('saved');
    expect(controller.measured.value).toBe(true);
    expect(controller.measures.value?.version_3d_deg).toBe(api.measured);
  });

  it('says that it could not save, keeps what was placed, and saves it later', async () => {
    api.down = true;
    place(1);
    await settle();
    expect(controller.save.value).toEqual({ kind: 'failed', message: 'no answer' });
    expect(controller.measured.value).toBe(false);
    api.down = false;
    await controller.saveNow();
    expect(controller.save.value.kind).toBe('saved');
    expect(api.onServer).toEqual({ glenoid_centre_mm: [0, 1, 0] });
  });

  it('overwrites nothing that somebody else changed, until it is told to', async () => {
    place(1);
    await settle();
    api.onServer = { trigonum_mm: [7, 7, 7] };
    place(2);
    await settle();
    expect(controller.save.value.kind).toBe('conflict');
    expect(api.onServer).toEqual({ trigonum_mm: [7, 7, 7] });
    place(3);
    await settle();
    expect(controller.save.value.kind).toBe('conflict');
    await controller.keepMine();
    expect(api.onServer).toEqual({ glenoid_centre_mm: [0, 3, 0] });
  });

  it('takes what somebody else placed when asked to', async () => {
    api.onServer = { trigonum_mm: [7, 7, 7] };
    place(2);
    await settle();
    controller.takeTheirs();
    await settle();
    expect(controller.landmarks.value).toEqual({ trigonum_mm: [7, 7, 7] });
    expect(controller.measured.value).toBe(true);
  });

  it('sends what is unsaved when the page is left, and nothing when all is saved', async () => {
    controller.leave();
    expect(api.left).toBeNull();
    place(4);
    controller.leave();
    expect(api.left).toEqual({ glenoid_centre_mm: [0, 4, 0] });
    await settle();
    expect(api.puts).toEqual([]);
  });

  it('saves as ever when the page stays that was about to go', async () => {
    place(4);
    controller.sendAhead();
    api.onServer = { glenoid_centre_mm: [0, 4, 0] };
    place(5);
    await vi.advanceTimersByTimeAsync(350);
    await settle();
    expect(controller.save.value.kind).toBe('saved');
    expect(api.onServer).toEqual({ glenoid_centre_mm: [0, 5, 0] });
  });

  it('saves what was changed while a save was on its way', async () => {
    place(1);
    await vi.advanceTimersByTimeAsync(350);
    place(2);
    await settle();
    await settle();
    expect(api.onServer).toEqual({ glenoid_centre_mm: [0, 2, 0] });
    expect(controller.save.value.kind).toBe('saved');
  });
});

describe('landmarks', () => {
  it('are the same as the server has them, whatever the order of keys', () => {
    expect(sameLandmarks({ walch: 'B2', trigonum_mm: [1, 2, 3] }, { trigonum_mm: [1, 2, 3], walch: 'B2' })).toBe(true);
    expect(sameLandmarks({ trigonum_mm: [1, 2, 3] }, { trigonum_mm: [1, 2, 4] })).toBe(false);
    expect(sameLandmarks(null, {})).toBe(true);
  });

  it('have a biconcave face only once all its points are placed', () => {
    let placed = withPoint({}, 'biconcavity_0', [0, 0, 0]);
    placed = withPoint(placed, 'biconcavity_1', [1, 0, 0]);
    expect(landmarksOf(placed)).toEqual({});
    placed = withPoint(placed, 'biconcavity_2', [2, 0, 0]);
    const points = {
      biconcavity_mm: [
        [0, 0, 0],
        [1, 0, 0],
        [2, 0, 0],
      ],
    };
    expect(landmarksOf(placed)).toEqual(points);
    expect(landmarksOf(placedFrom(points as Landmarks))).toEqual(points);
  });

  it('are placed one after the other, those of a biconcave face only once begun', () => {
    let placed = {};
    const order: string[] = [];
    for (let next = nextMissing(placed, null); next !== null; next = nextMissing(placed, next)) {
      order.push(next);
      placed = withPoint(placed, next, [0, 0, 0]);
    }
    expect(order).toHaveLength(8);
    expect(order.some((name) => name.startsWith('biconcavity'))).toBe(false);
    placed = withPoint(placed, 'biconcavity_0', [0, 0, 0]);
    expect(nextMissing(placed, 'biconcavity_0')).toBe('biconcavity_1');
  });
});
