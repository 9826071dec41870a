import { type CallOptions, type Method, request, requestJson } from './rest';
import type { Answers, ExportTable, NewParticipant, NewStudy, Participant, Person, Study } from './study_types';

/** Calls of the REST interface about studies; `base` is the server's origin. */
export class StudyApi {
  constructor(private readonly base: string) {}

  async studies(): Promise<Study[]> {
    return (await this.call<{ studies: Study[] }>('GET', '')).studies;
  }
  study(id: string): Promise<Study> {
    return this.call('GET', this.path(id));
  }
  make(wanted: NewStudy): Promise<Study> {
    return this.call('POST', '', { body: wanted });
  }
  async remove(id: string): Promise<void> {
    await request(this.url(this.path(id)), 'DELETE');
  }
  close(id: string): Promise<Study> {
    return this.call('POST', `${this.path(id)}/close`);
  }
  reopen(id: string): Promise<Study> {
    return this.call('POST', `${this.path(id)}/reopen`);
  }
  unblind(id: string): Promise<Study> {
    return this.call('POST', `${this.path(id)}/unblind`);
  }

  /** The user takes part in the study with that code. */
  join(joinCode: string, about: Pick<NewParticipant, 'experience' | 'procedures_done'>): Promise<{ study: string }> {
    return this.call('POST', '/join', { body: { join_code: joinCode, ...about } });
  }
  async participants(id: string): Promise<Participant[]> {
    return (await this.call<{ participants: Participant[] }>('GET', `${this.path(id)}/participants`)).participants;
  }
  participant(id: string, code: string): Promise<Participant> {
    return this.call('GET', `${this.path(id)}/participants/${code}`);
  }
  enrol(id: string, wanted: NewParticipant): Promise<Participant> {
    return this.call('POST', `${this.path(id)}/participants`, { body: wanted });
  }
  async withdraw(id: string, code: string): Promise<void> {
    await request(this.url(`${this.path(id)}/participants/${code}`), 'DELETE');
  }
  answer(id: string, code: string, answers: Answers): Promise<Participant> {
    return this.call('PUT', `${this.path(id)}/participants/${code}/answers`, { body: answers });
  }
  async persons(id: string): Promise<Person[]> {
    return (await this.call<{ persons: Person[] }>('GET', `${this.path(id)}/persons`)).persons;
  }

  /** A table for statistics, or all of them as JSON. */
  async export(id: string, what: ExportTable | 'json'): Promise<Blob> {
    const query = what === 'json' ? 'format=json' : `format=csv&table=${what}`;
    return (await request(this.url(`${this.path(id)}/export?${query}`), 'GET')).blob();
  }
  async codebook(id: string): Promise<Blob> {
    return (await request(this.url(`${this.path(id)}/codebook`), 'GET')).blob();
  }

  private path(id: string): string {
    return `/${encodeURIComponent(id)}`;
  }
  private url(path: string): string {
    return `${this.base}/api/v1/studies${path}`;
  }
  private call<T>(method: Method, path: string, options: CallOptions = {}): Promise<T> {
    return requestJson(this.url(path), method, options);
  }
}
