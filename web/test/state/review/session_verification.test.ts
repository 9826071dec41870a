import { describe, expect, it } from 'vitest';

import {
  SessionVerification,
  type VerificationSources,
  type VerificationState,
} from '../../../src/state/review/session_verification';
import { ApiError } from '../../../src/wire/rest';

function verificationWith(sources: Partial<VerificationSources>) {
  const verification = new SessionVerification({
    causes: async (onProgress) => {
      onProgress(0.5);
      return Promise.resolve('/api/v1/jobs/j/result');
    },
    verify: (_causes, onTicks) => {
      onTicks(250);
      return Promise.resolve({ outcome: 'agrees', ticks: 500, recordedTicks: 500 });
    },
    ...sources,
  });
  const seen: VerificationState['kind'][] = [];
  verification.state.subscribe(({ kind }) => {
    if (seen.at(-1) !== kind) seen.push(kind);
  });
  return { verification, seen };
}

describe('The verification of a session', () => {
  it('is prepared by the server and computed here', async () => {
    const { verification, seen } = verificationWith({});
    await verification.run();
    expect(seen).toEqual(['idle', 'preparing', 'computing', 'done']);
    expect(verification.state.value).toEqual({
      kind: 'done',
      verification: { outcome: 'agrees', ticks: 500, recordedTicks: 500 },
    });
  });

  it('says why the server made no file', async () => {
    const causes = () => Promise.reject(new ApiError('bone was removed by decay', 409));
    const { verification } = verificationWith({ causes });
    await verification.run();
    expect(verification.state.value).toEqual({ kind: 'refused', reason: 'bone was removed by decay' });
  });

  it.each(['browser', 'connection'] as const)('says that the %s did not allow it', async (obstacle) => {
    const { verification } = verificationWith({ verify: () => Promise.resolve(obstacle) });
    await verification.run();
    expect(verification.state.value).toEqual({ kind: 'impossible', obstacle });
  });

  it('runs once at a time, and again afterwards', async () => {
    let made = 0;
    const { verification } = verificationWith({ causes: () => Promise.resolve(`/result/${++made}`) });
    await Promise.all([verification.run(), verification.run()]);
    expect(made).toBe(1);
    await verification.run();
    expect(made).toBe(2);
  });

  it('is given up with its page, and says nothing more', async () => {
    let given: AbortSignal | undefined;
    const { verification, seen } = verificationWith({
      verify: (_causes, _onTicks, signal) => {
        given = signal;
        verification.dispose();
        return Promise.reject(new DOMException('given up', 'AbortError'));
      },
    });
    await verification.run();
    expect(given?.aborted).toBe(true);
    expect(seen).toEqual(['idle', 'preparing', 'computing']);
  });

  it('does not begin to compute for a page that was left while the file was made', async () => {
    let computed = 0;
    const { verification } = verificationWith({
      causes: () => {
        verification.dispose();
        return Promise.resolve('/result');
      },
      verify: () => Promise.resolve(++computed > 0 ? 'browser' : 'connection'),
    });
    await verification.run();
    expect(computed).toBe(0);
  });
});
