import { RestClient } from './rest_client';
import type { NewUser, Token, User, UserChange, ViewerLink } from './rest_types';

/** Something made with a secret that is sent this once. */
interface Issued {
  id: string;
  secret: string;
}

/** Calls of the REST interface about who may do what; `base` is the server's origin. */
export class AccessApi {
  private readonly rest: RestClient;

  constructor(base: string) {
    this.rest = new RestClient(base);
  }

  async users(): Promise<User[]> {
    return (await this.rest.json('get', '/api/v1/users', {})).users;
  }
  addUser(body: NewUser): Promise<User> {
    return this.rest.json('post', '/api/v1/users', { body });
  }
  changeUser(id: string, body: UserChange): Promise<User> {
    return this.rest.json('patch', '/api/v1/users/{id}', { path: { id }, body });
  }
  async removeUser(id: string): Promise<void> {
    await this.rest.request('delete', '/api/v1/users/{id}', { path: { id } });
  }

  /** Of one user, or of everybody where the caller may know of them. */
  async tokens(userId: string | null): Promise<Token[]> {
    const query = userId === null ? {} : { user_id: userId };
    return (await this.rest.json('get', '/api/v1/tokens', { query })).tokens;
  }
  addToken(name: string, expiresUtc: string): Promise<Issued> {
    return this.rest.json('post', '/api/v1/tokens', { body: { name, expires_utc: expiresUtc } });
  }
  async revokeToken(id: string): Promise<void> {
    await this.rest.request('delete', '/api/v1/tokens/{id}', { path: { id } });
  }

  async links(): Promise<ViewerLink[]> {
    return (await this.rest.json('get', '/api/v1/links', {})).links;
  }
  /** `session` null: all sessions. */
  addLink(name: string, session: string | null, expiresUtc: string): Promise<Issued> {
    const body = { name, expires_utc: expiresUtc, ...(session === null ? {} : { session }) };
    return this.rest.json('post', '/api/v1/links', { body });
  }
  async revokeLink(id: string): Promise<void> {
    await this.rest.request('delete', '/api/v1/links/{id}', { path: { id } });
  }
}

/** A moment that many days from now, as the server writes it. */
export function utcInDays(days: number, nowMs = Date.now()): string {
  return new Date(nowMs + days * 86_400_000).toISOString().replace(/\.\d+Z$/, 'Z');
}
