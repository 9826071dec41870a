import { RestClient } from './rest_client';
import type {
  FeelAnswer,
  FeelPlace,
  FeelReport,
  GivenAnswers,
  NewParticipant,
  NewStudy,
  Participant,
  Person,
  QueuedRating,
  Rater,
  Replay,
  SampleInput,
  SampleSize,
  Study,
  ValidityReport,
} from './rest_types';

export type ExportTable = 'sessions' | 'answers' | 'groups' | 'ratings';

/** Files of the validity report: its numbers, and what R computes them from. */
export type ValidityFile = 'numbers' | 'sessions' | 'ratings' | 'script';

/** Calls of the REST interface about studies; `base` is the server's origin. */
export class StudyApi {
  private readonly rest: RestClient;

  constructor(base: string) {
    this.rest = new RestClient(base);
  }

  async studies(): Promise<Study[]> {
    return (await this.rest.json('get', '/api/v1/studies', {})).studies;
  }
  study(id: string): Promise<Study> {
    return this.rest.json('get', '/api/v1/studies/{id}', { path: { id } });
  }
  make(body: NewStudy): Promise<Study> {
    return this.rest.json('post', '/api/v1/studies', { body });
  }
  async remove(id: string): Promise<void> {
    await this.rest.request('delete', '/api/v1/studies/{id}', { path: { id } });
  }
  close(id: string): Promise<Study> {
    return this.rest.json('post', '/api/v1/studies/{id}/close', { path: { id } });
  }
  reopen(id: string): Promise<Study> {
    return this.rest.json('post', '/api/v1/studies/{id}/reopen', { path: { id } });
  }
  unblind(id: string): Promise<Study> {
    return this.rest.json('post', '/api/v1/studies/{id}/unblind', { path: { id } });
  }

  /** The user takes part in the study with that code. */
  join(joinCode: string, about: Pick<NewParticipant, 'experience' | 'procedures_done'>): Promise<{ study: string }> {
    return this.rest.json('post', '/api/v1/studies/join', { body: { join_code: joinCode, ...about } });
  }
  async participants(id: string): Promise<Participant[]> {
    return (await this.rest.json('get', '/api/v1/studies/{id}/participants', { path: { id } })).participants;
  }
  participant(id: string, code: string): Promise<Participant> {
    return this.rest.json('get', '/api/v1/studies/{id}/participants/{code}', { path: { id, code } });
  }
  enrol(id: string, body: NewParticipant): Promise<Participant> {
    return this.rest.json('post', '/api/v1/studies/{id}/participants', { path: { id }, body });
  }
  async withdraw(id: string, code: string): Promise<void> {
    await this.rest.request('delete', '/api/v1/studies/{id}/participants/{code}', { path: { id, code } });
  }
  answer(id: string, code: string, body: GivenAnswers): Promise<Participant> {
    return this.rest.json('put', '/api/v1/studies/{id}/participants/{code}/answers', { path: { id, code }, body });
  }
  async persons(id: string): Promise<Person[]> {
    return (await this.rest.json('get', '/api/v1/studies/{id}/persons', { path: { id } })).persons;
  }

  async raters(id: string): Promise<Rater[]> {
    return (await this.rest.json('get', '/api/v1/studies/{id}/raters', { path: { id } })).raters;
  }
  addRater(id: string, userId: string): Promise<Rater> {
    return this.rest.json('post', '/api/v1/studies/{id}/raters', { path: { id }, body: { user_id: userId } });
  }
  async removeRater(id: string, label: string): Promise<void> {
    await this.rest.request('delete', '/api/v1/studies/{id}/raters/{label}', { path: { id, label } });
  }
  /** What the user rates. */
  async ratingQueue(id: string): Promise<QueuedRating[]> {
    return (await this.rest.json('get', '/api/v1/studies/{id}/rating-queue', { path: { id } })).queue;
  }
  rate(id: string, key: string, body: GivenAnswers): Promise<QueuedRating> {
    return this.rest.json('put', '/api/v1/studies/{id}/rating-queue/{key}', { path: { id, key }, body });
  }
  replayForRating(id: string, key: string): Promise<Replay> {
    return this.rest.json('post', '/api/v1/studies/{id}/rating-queue/{key}/replay', { path: { id, key } });
  }

  async validity(id: string): Promise<ValidityReport> {
    return (
      await this.rest.request('get', '/api/v1/studies/{id}/validity', { path: { id } })
    ).json() as Promise<ValidityReport>;
  }
  async validityFile(id: string, form: ValidityFile): Promise<Blob> {
    return (await this.rest.request('get', '/api/v1/studies/{id}/validity', { path: { id }, query: { form } })).blob();
  }

  /** The trial of a study of feel that a participant does next. */
  feelTrial(id: string, code: string): Promise<FeelPlace> {
    return this.rest.json('get', '/api/v1/studies/{id}/participants/{code}/feel-trial', { path: { id, code } });
  }
  /** The trial after it. */
  answerFeelTrial(id: string, code: string, body: FeelAnswer): Promise<FeelPlace> {
    return this.rest.json('put', '/api/v1/studies/{id}/participants/{code}/feel-trial', { path: { id, code }, body });
  }
  async feelReport(id: string): Promise<FeelReport> {
    return (
      await this.rest.request('get', '/api/v1/studies/{id}/feel', { path: { id } })
    ).json() as Promise<FeelReport>;
  }
  /** Every answer of a study of feel, as CSV. */
  async feelAnswers(id: string): Promise<Blob> {
    const query = { form: 'answers' } as const;
    return (await this.rest.request('get', '/api/v1/studies/{id}/feel', { path: { id }, query })).blob();
  }
  sampleSize(query: SampleInput): Promise<SampleSize> {
    return this.rest.json('get', '/api/v1/sample-size', { query });
  }

  /** A table for statistics, or all of them as JSON. */
  async export(id: string, what: ExportTable | 'json'): Promise<Blob> {
    const query = what === 'json' ? ({ format: 'json' } as const) : ({ format: 'csv', table: what } as const);
    return (await this.rest.request('get', '/api/v1/studies/{id}/export', { path: { id }, query })).blob();
  }
  async codebook(id: string): Promise<Blob> {
    return (await this.rest.request('get', '/api/v1/studies/{id}/codebook', { path: { id } })).blob();
  }
}
