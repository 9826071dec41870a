import { RestClient } from './rest_client';
import type { Login } from './rest_types';

/** Calls of the REST interface that say who asks; `base` is the server's origin. */
export class LoginApi {
  private readonly rest: RestClient;

  constructor(base: string) {
    this.rest = new RestClient(base);
  }

  whoAmI(): Promise<Login> {
    return this.rest.json('get', '/api/v1/login', { quiet: true });
  }
  logIn(name: string, password: string): Promise<Login> {
    return this.rest.json('post', '/api/v1/login', { body: { name, password }, quiet: true });
  }
  async logOut(): Promise<void> {
    await this.rest.request('delete', '/api/v1/login', { quiet: true });
  }
  useLink(secret: string): Promise<Login> {
    return this.rest.json('post', '/api/v1/login/link', { body: { secret }, quiet: true });
  }
  async changePassword(password: string, newPassword: string): Promise<void> {
    await this.rest.request('post', '/api/v1/login/password', { body: { password, new_password: newPassword } });
  }
}
