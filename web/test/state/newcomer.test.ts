import { describe, expect, it } from 'vitest';

import { hasReamed } from '../../src/state/newcomer';
import type { Session } from '../../src/wire/rest_types';

const session = (device: string, trainee: string | null, state = 'stopped') =>
  ({ device: { name: device }, trainee_id: trainee, state }) as Session;

describe('hasReamed', () => {
  const tom = { userId: 'tom', teach: false };
  const olga = { userId: 'olga', teach: true };
  const anybody = { userId: null, teach: true };

  it('counts sessions of one’s own hand only', () => {
    expect(hasReamed([], tom)).toBe(false);
    expect(hasReamed([session('script', 'tom')], tom)).toBe(false);
    expect(hasReamed([session('browser', 'ann')], tom)).toBe(false);
    expect(hasReamed([session('browser', 'tom', 'created')], tom)).toBe(false);
    expect(hasReamed([session('script', null), session('browser', 'tom')], tom)).toBe(true);
    expect(hasReamed([session('network', 'tom', 'running')], tom)).toBe(true);
  });

  it('counts sessions of nobody for staff, and all where there are no users', () => {
    expect(hasReamed([session('browser', null)], tom)).toBe(false);
    expect(hasReamed([session('browser', null)], olga)).toBe(true);
    expect(hasReamed([session('browser', 'tom')], olga)).toBe(false);
    expect(hasReamed([session('browser', null)], anybody)).toBe(true);
  });
});
