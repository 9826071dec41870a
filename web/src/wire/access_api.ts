import type { Role } from './login_api';
import { type Method, request, requestJson } from './rest';

export type AccountRole = Exclude<Role, 'viewer'>;
export const accountRoles: readonly AccountRole[] = ['operator', 'instructor', 'trainee'];

export interface User {
  id: string;
  /** To log in with. */
  name: string;
  /** For people. */
  display_name: string;
  role: AccountRole;
  enabled: boolean;
  created_utc: string;
}

export interface NewUser {
  name: string;
  display_name: string;
  role: AccountRole;
  password: string;
}

/** What is absent stays as it is. */
export interface UserChange {
  display_name?: string;
  role?: AccountRole;
  enabled?: boolean;
  password?: string;
}

/** What a program shows in place of a login. */
export interface Token {
  id: string;
  name: string;
  user_id: string;
  /** Less than the user's own; null: the user's own. */
  role: Role | null;
  created_utc: string;
  expires_utc: string;
  /** Null: never. */
  last_used_utc: string | null;
}

/** What lets somebody watch without an account. */
export interface ViewerLink {
  id: string;
  name: string;
  /** Null: all sessions. */
  session: string | null;
  created_utc: string;
  expires_utc: string;
  last_used_utc: string | null;
}

/** A secret is told once, when it is made. */
export type Made<T> = T & { secret: string };

/** Calls of the REST interface about who may do what; `base` is the server's origin. */
export class AccessApi {
  constructor(private readonly base: string) {}

  async users(): Promise<User[]> {
    return (await this.call<{ users: User[] }>('GET', 'users')).users;
  }
  addUser(wanted: NewUser): Promise<User> {
    return this.call('POST', 'users', wanted);
  }
  changeUser(id: string, change: UserChange): Promise<User> {
    return this.call('PATCH', `users/${encodeURIComponent(id)}`, change);
  }
  removeUser(id: string): Promise<void> {
    return this.remove(`users/${encodeURIComponent(id)}`);
  }

  /** Of one user, or of everybody where the caller may know of them. */
  async tokens(userId: string | null): Promise<Token[]> {
    const of = userId === null ? '' : `?user_id=${encodeURIComponent(userId)}`;
    return (await this.call<{ tokens: Token[] }>('GET', `tokens${of}`)).tokens;
  }
  addToken(name: string, expiresUtc: string): Promise<Made<Token>> {
    return this.call('POST', 'tokens', { name, expires_utc: expiresUtc });
  }
  revokeToken(id: string): Promise<void> {
    return this.remove(`tokens/${encodeURIComponent(id)}`);
  }

  async links(): Promise<ViewerLink[]> {
    return (await this.call<{ links: ViewerLink[] }>('GET', 'links')).links;
  }
  /** `session` null: all sessions. */
  addLink(name: string, session: string | null, expiresUtc: string): Promise<Made<ViewerLink>> {
    return this.call('POST', 'links', { name, expires_utc: expiresUtc, ...(session === null ? {} : { session }) });
  }
  revokeLink(id: string): Promise<void> {
    return this.remove(`links/${encodeURIComponent(id)}`);
  }

  private async remove(path: string): Promise<void> {
    await request(`${this.base}/api/v1/${path}`, 'DELETE');
  }
  private call<T>(method: Method, path: string, body?: object): Promise<T> {
    return requestJson(`${this.base}/api/v1/${path}`, method, { body });
  }
}

/** A moment that many days from now, as the server writes it. */
export function utcInDays(days: number, nowMs = Date.now()): string {
  return new Date(nowMs + days * 86_400_000).toISOString().replace(/\.\d+Z$/, 'Z');
}
