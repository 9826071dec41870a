import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { Identity } from '../../src/state/identity';
import type { LoginApi } from '../../src/wire/login_api';
import { ApiError, credentials } from '../../src/wire/rest';
import { appText } from '../../src/text/app_text';
import type { Login } from '../../src/wire/rest_types';

const visitor = (role: Login['role'], name: string | null = null, csrf: string | null = 'proof'): Login => ({
  login_needed: true,
  role,
  user: name === null ? null : { id: `id-${name}`, name, display_name: '' },
  only_session: null,
  csrf_token: role === null ? null : csrf,
  expires_utc: null,
});
const open: Login = { ...visitor('operator'), login_needed: false, csrf_token: null };

/** The server's side of logging in. */
class FakeLogin {
  present: Login = visitor(null);
  down = false;
  requests: string[] = [];
  refusal: ApiError | null = null;

  private answer(what: string, next: Login): Promise<Login> {
    this.requests.push(what);
    if (this.down) return Promise.reject(new ApiError('no answer', 0));
    if (this.refusal !== null) return Promise.reject(this.refusal);
    this.present = next;
    return Promise.resolve(next);
  }
  whoAmI = () => (this.down ? Promise.reject(new ApiError('no answer', 0)) : Promise.resolve(this.present));
  logIn = (name: string) => this.answer(`login ${name}`, visitor('trainee', name));
  useLink = (secret: string) => this.answer(`link ${secret}`, visitor('viewer'));
  logOut = () => this.answer('logout', visitor(null)).then(() => undefined);
}

describe('Identity', () => {
  let login: FakeLogin;
  let others: number;
  let identity: Identity;

  beforeEach(() => {
    vi.useFakeTimers();
    login = new FakeLogin();
    others = 0;
    credentials.csrfToken = null;
    identity = new Identity(login as unknown as LoginApi, () => ++others);
  });
  afterEach(() => vi.useRealTimers());

  it('lets everybody in where there are no users', async () => {
    login.present = open;
    await identity.find(null);
    expect(identity.phase.value).toBe('known');
    expect(identity.may.value.operate).toBe(true);
    expect(identity.hasUsers.value).toBe(false);
  });

  it('waits for a server that does not answer, and says so', async () => {
    login.down = true;
    const found = identity.find(null);
    await vi.advanceTimersByTimeAsync(0);
    expect(identity.phase.value).toBe('checking');
    expect(identity.problem.value).toBe('no answer');
    login.down = false;
    await vi.advanceTimersByTimeAsync(2000);
    await found;
    expect(identity.phase.value).toBe('unknown');
    expect(identity.problem.value).toBeNull();
  });

  it('asks for name and password, and takes the proof for changes', async () => {
    await identity.find(null);
    expect(identity.phase.value).toBe('unknown');
    expect(identity.may.value.ream).toBe(false);
    await identity.logIn('tom', 'secret');
    expect(identity.phase.value).toBe('known');
    expect(identity.name.value).toBe('tom');
    expect(identity.may.value).toMatchObject({ ream: true, teach: false, editCases: false });
    expect(credentials.csrfToken).toBe('proof');
    expect(others).toBe(0);
  });

  it('says what was wrong, and until when to wait', async () => {
    await identity.find(null);
    login.refusal = new ApiError('name or password is wrong', 401);
    await identity.logIn('tom', 'wrong');
    expect(identity.phase.value).toBe('unknown');
    expect(identity.problem.value).toBe('name or password is wrong');
    expect(identity.notBeforeMs.value).toBeNull();
    login.refusal = new ApiError('too many failed logins', 429, 8);
    await identity.logIn('tom', 'wrong');
    expect(identity.notBeforeMs.value).toBe(Date.now() + 8000);
    login.refusal = null;
    await identity.logIn('tom', 'right');
    expect(identity.problem.value).toBeNull();
    expect(identity.notBeforeMs.value).toBeNull();
  });

  it('comes in by a viewer link to look only, unless somebody is logged in already', async () => {
    await identity.find('secret');
    expect(login.requests).toEqual(['link secret']);
    expect(identity.may.value).toMatchObject({ ream: false, readCases: false, takePart: false });
    login.present = visitor('instructor', 'ines');
    login.requests = [];
    const other = new Identity(login as unknown as LoginApi, () => undefined);
    await other.find('secret');
    expect(login.requests).toEqual([]);
    expect(other.may.value.teach).toBe(true);
  });

  it('says in words that a link does not work', async () => {
    login.refusal = new ApiError('the link has ended', 401);
    await identity.find('secret');
    expect(identity.phase.value).toBe('unknown');
    expect(identity.problem.value).toBe(`${appText.linkRefusedText} The link has ended.`);
  });

  it('lets go of who it was when the login ends, and says why', async () => {
    await identity.find(null);
    await identity.logIn('tom', 'secret');
    credentials.onRefused?.();
    expect(identity.phase.value).toBe('unknown');
    expect(identity.problem.value).toBe(appText.loginEnded);
    expect(identity.visitor.value).toBeNull();
    expect(credentials.csrfToken).toBeNull();
    await identity.logIn('tom', 'secret');
    expect(others).toBe(0);
    await identity.logOut();
    expect(identity.problem.value).toBe(appText.loggedOut);
    await identity.logIn('ben', 'secret');
    expect(others).toBe(1);
  });

  it('has other words for a viewer, and for a server that gets its first user', async () => {
    await identity.find('secret');
    credentials.onRefused?.();
    expect(identity.problem.value).toBe(appText.linkEnded);
    login.present = open;
    const operator = new Identity(login as unknown as LoginApi, () => undefined);
    await operator.find(null);
    credentials.onRefused?.();
    expect(operator.problem.value).toBe(appText.loginNeededNow);
  });

  it('takes up the proof of a login that another window has made, and notices another user', async () => {
    await identity.find(null);
    await identity.logIn('tom', 'secret');
    login.present = visitor('trainee', 'tom', 'newer');
    expect(await credentials.renew?.()).toBe(true);
    expect(credentials.csrfToken).toBe('newer');
    expect(await credentials.renew?.()).toBe(false);
    login.present = visitor('operator', 'olga');
    expect(await credentials.renew?.()).toBe(false);
    expect(others).toBe(1);
  });
});
