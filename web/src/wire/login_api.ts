import { request, requestJson } from './rest';

export type Role = 'operator' | 'instructor' | 'trainee' | 'viewer';

/** Who this page is for the server. */
export interface Visitor {
  /** False on a server without users, where everybody is an operator. */
  login_needed: boolean;
  /** Null: not known yet. */
  role: Role | null;
  /** Null without users, and for who came by a viewer link. */
  user: { id: string; name: string; display_name: string } | null;
  /** The one session that a viewer link is for. */
  only_session: string | null;
  csrf_token: string | null;
  expires_utc: string | null;
}

/** Calls of the REST interface that say who asks; `base` is the server's origin. */
export class LoginApi {
  constructor(private readonly base: string) {}

  whoAmI(): Promise<Visitor> {
    return requestJson(this.url(''), 'GET', { quiet: true });
  }
  logIn(name: string, password: string): Promise<Visitor> {
    return requestJson(this.url(''), 'POST', { body: { name, password }, quiet: true });
  }
  async logOut(): Promise<void> {
    await request(this.url(''), 'DELETE', { quiet: true });
  }
  useLink(secret: string): Promise<Visitor> {
    return requestJson(this.url('/link'), 'POST', { body: { secret }, quiet: true });
  }
  async changePassword(password: string, newPassword: string): Promise<void> {
    await request(this.url('/password'), 'POST', { body: { password, new_password: newPassword } });
  }

  private url(path: string): string {
    return `${this.base}/api/v1/login${path}`;
  }
}
