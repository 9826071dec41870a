import { describe, expect, it } from 'vitest';

import { alarmsOf, type Reading } from '../../../src/state/dashboard/tile_alarms';
import { someMetrics, someSession } from '../../wire/some_answers';

const normalMetrics = someMetrics({ axial_thrust_excess_n_s: 2, vault_breach_mm: 0 });
const loop = { ...someSession().loop, missed: 5 };
const session = someSession({ tick: 10_000, loop });
const kinds = (reading: Partial<Reading>) =>
  alarmsOf({ session, soFar: normalMetrics, before: normalMetrics, plannedDepthMm: 2, ...reading }).map(
    ({ kind, level }) => `${kind} ${level}`,
  );

describe('alarmsOf', () => {
  it('finds nothing where nothing is wrong or nothing is known', () => {
    expect(kinds({})).toEqual([]);
    expect(kinds({ soFar: null, before: null, plannedDepthMm: null })).toEqual([]);
    expect(kinds({ before: null })).toEqual([]);
  });

  it('tells thrust only while its excess grows', () => {
    expect(kinds({ soFar: { ...normalMetrics, axial_thrust_excess_n_s: 2.5 } })).toEqual(['thrust bad']);
  });

  it('tells depth past the plan, worse from a millimetre on', () => {
    expect(kinds({ soFar: { ...normalMetrics, reaming_depth_mm: 2.4 } })).toEqual(['depth warn']);
    expect(kinds({ soFar: { ...normalMetrics, reaming_depth_mm: 3.4 } })).toEqual(['depth bad']);
    expect(kinds({ soFar: { ...normalMetrics, reaming_depth_mm: 3.4 }, plannedDepthMm: null })).toEqual([]);
  });

  it('tells what is bad before what is not', () => {
    expect(
      kinds({
        session: { ...session, loop: { ...loop, missed: 50 }, fault: 'the device is lost' },
        soFar: { ...normalMetrics, vault_breach_mm: 0.4 },
      }),
    ).toEqual(['fault bad', 'vault bad', 'slow warn']);
  });

  it('tells a lost device once, in the words of the live page', () => {
    const device = { ...session.device, state: 'lost' as const };
    const fault = 'The device stopped answering.';
    expect(
      alarmsOf({ session: { ...session, device, fault }, soFar: null, before: null, plannedDepthMm: null }),
    ).toEqual([{ kind: 'lost', level: 'bad', value: null, message: fault }]);
  });
});
