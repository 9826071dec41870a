import { beforeEach, describe, expect, it } from 'vitest';

import { TrialPlace } from '../../../src/state/study/feel_place';
import { ApiError } from '../../../src/wire/rest';
import type { FeelAnswer, FeelPlace } from '../../../src/wire/rest_types';

const trial = (number: number, session: string | null): FeelPlace => ({
  trial: { number, of: 2, comparison: 'density', question: 'Which plate is of denser bone?', session },
});

/** Two trials, as a server has them. */
class FakeServer {
  place = trial(1, null);
  readonly answers: FeelAnswer[] = [];
  away = false;

  feelTrial = () => (this.away ? Promise.reject(new ApiError('away', 0)) : Promise.resolve(this.place));
  answerFeelTrial = (id: string, code: string, answer: FeelAnswer) => {
    expect([id, code]).toEqual(['study', 'AB-CDE']);
    if (answer.number !== this.place.trial?.number) return Promise.reject(new ApiError('answered already', 409));
    this.answers.push(answer);
    this.place = answer.number === 1 ? trial(2, null) : { trial: null };
    return Promise.resolve(this.place);
  };
}

describe('place in a study of feel', () => {
  let server: FakeServer;
  let here: TrialPlace;
  beforeEach(async () => {
    server = new FakeServer();
    here = new TrialPlace(server, 'study', 'AB-CDE');
    await here.place.read();
  });
  const number = () => here.place.value.value?.trial?.number;

  it('takes no answer before the plates were felt', async () => {
    await here.answer('upper');
    expect(server.answers).toEqual([]);
  });

  it('goes from trial to trial until all are answered', async () => {
    for (const [i, chosen] of (['lower', 'upper'] as const).entries()) {
      server.place = trial(i + 1, 'abcd');
      await here.place.read();
      await here.answer(chosen);
    }
    expect(server.answers).toEqual([
      { number: 1, chosen: 'lower' },
      { number: 2, chosen: 'upper' },
    ]);
    expect(here.place.value.value).toEqual({ trial: null });
  });

  it('sends one answer for two presses at once', async () => {
    server.place = trial(1, 'abcd');
    await here.place.read();
    await Promise.all([here.answer('lower'), here.answer('upper')]);
    expect(server.answers).toEqual([{ number: 1, chosen: 'lower' }]);
    expect(number()).toBe(2);
  });

  it('shows the next trial where the answer had come already, and says so', async () => {
    server.place = trial(1, 'abcd');
    await here.place.read();
    server.place = trial(2, null);
    await here.answer('upper');
    expect(number()).toBe(2);
    expect(here.place.problem.value).toBe('answered already');
  });

  it('knows the next trial also when it cannot be read again', async () => {
    server.place = trial(1, 'abcd');
    await here.place.read();
    server.away = true;
    await here.answer('upper');
    expect(number()).toBe(2);
  });
});
